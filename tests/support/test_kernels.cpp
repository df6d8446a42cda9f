#include "support/test_kernels.h"

#include <fstream>
#include <sstream>
#include <stdexcept>

namespace quasilux {

Device& testDevice() {
    static Device device(0);
    return device;
}

Program testProgram(const std::string& file, const std::string& options) {
    const std::string path = std::string(QUASILUX_SOURCE_DIR) + "/tests/kernels/" + file;
    std::ifstream stream(path);
    if (!stream) throw std::runtime_error("cannot read " + path);
    std::ostringstream text;
    text << stream.rdbuf();
    return Program(testDevice(), file, options, {{file, text.str()}});
}

} // namespace quasilux
