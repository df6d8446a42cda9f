#include "images/radiance_header.h"

#include <algorithm>
#include <charconv>
#include <limits>
#include <utility>

namespace quasilux {

namespace {

std::string_view takeLine(std::string_view& content) {
    const size_t end = std::min(content.find('\n'), content.size());
    std::string_view line = content.substr(0, end);
    content.remove_prefix(std::min(end + 1, content.size()));
    if (line.ends_with('\r')) line.remove_suffix(1);
    return line;
}

double numberOf(std::string_view text) {
    text.remove_prefix(std::min(text.find_first_not_of(" \t+"), text.size()));
    double value = 0;
    const bool isNumber = std::from_chars(text.data(), text.data() + text.size(), value).ec == std::errc();
    return isNumber ? value : std::numeric_limits<double>::quiet_NaN();
}

} // namespace

RadianceHeader radianceHeader(std::string_view content) {
    constexpr std::string_view exposure = "EXPOSURE=";
    RadianceHeader header;
    for (std::string_view line = takeLine(content); !line.empty(); line = takeLine(content))
        if (line.starts_with(exposure)) header.exposure *= numberOf(line.substr(exposure.size()));
    const std::string_view resolution = takeLine(content); // such as "-Y 480 +X 640", the rows' axis first
    header.byColumns = resolution.find('X') < resolution.find('Y');
    header.fromRight = resolution.find("-X") != std::string_view::npos;
    header.fromBottom = resolution.find("+Y") != std::string_view::npos;
    return header;
}

void turnUpright(const RadianceHeader& header, unsigned& width, unsigned& height, std::vector<float>& values) {
    if (!header.byColumns && !header.fromBottom && !header.fromRight) return;
    const std::vector<float> stored = std::move(values);
    const size_t channels = stored.size() / (size_t{width} * height), perRow = width;
    if (header.byColumns) std::swap(width, height);
    values.clear();
    values.reserve(stored.size());
    for (size_t y = 0; y < height; ++y)
        for (size_t x = 0; x < width; ++x) {
            const size_t i = header.fromRight ? width - 1 - x : x, j = header.fromBottom ? height - 1 - y : y;
            const float* const pixel = &stored[channels * (header.byColumns ? i * perRow + j : j * perRow + i)];
            values.insert(values.end(), pixel, pixel + channels);
        }
}

} // namespace quasilux
