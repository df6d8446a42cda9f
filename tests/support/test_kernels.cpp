#include "support/test_kernels.h"

#include <fstream>
#include <map>
#include <sstream>
#include <stdexcept>

namespace quasilux {

Device& testDevice(unsigned workGroupSize) {
    static std::map<unsigned, Device> devices;
    return devices.try_emplace(workGroupSize, 0, workGroupSize).first->second;
}

Program testProgram(const std::string& file, const std::string& options) {
    return testProgram(testDevice(), file, options);
}

Program testProgram(Device& device, const std::string& file, const std::string& options) {
    const std::string path = std::string(QUASILUX_SOURCE_DIR) + "/tests/kernels/" + file;
    std::ifstream stream(path);
    if (!stream) throw std::runtime_error("cannot read " + path);
    std::ostringstream text;
    text << stream.rdbuf();
    return Program(device, file, options, {{file, text.str()}});
}

} // namespace quasilux
