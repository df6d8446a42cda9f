#include "cli/drawing_file.h"

#include "compare/error_picture.h"
#include "output/atomic_file.h"
#include "util/error.h"
#include "util/file_ending.h"

#include <cmath>
#include <fmt/format.h>

namespace quasilux {

void checkDrawingPath(const std::string& path, const std::string& option) {
    const std::string extension = fileEnding(path);
    if (extension != ".svg" && extension != ".png")
        throw InputError(fmt::format("{} {}: expected a name that ends in .png or .svg", option, path));
    checkOutputPath(path, option, extension);
}

void writeDrawing(const std::string& path, const Drawing& drawing) {
    if (fileEnding(path) == ".svg") return writeText(path, svgOf(drawing));
    const auto bytes = pngBytes(pixelsOf(drawing), static_cast<unsigned>(std::ceil(drawing.width)),
                                static_cast<unsigned>(std::ceil(drawing.height)));
    writeText(path, std::string(bytes.begin(), bytes.end()));
}

} // namespace quasilux
