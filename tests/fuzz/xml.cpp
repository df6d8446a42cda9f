// A scene that is not trusted, with what it includes: after a line "=== NAME" follows the file of that name.
#include "fuzz/input_files.h"
#include "fuzz/targets.h"

#include "scene/scene.h"

#include <algorithm>
#include <vector>

namespace quasilux::fuzz {

namespace {

constexpr std::string_view separator = "\n=== ";

bool isPlain(std::string_view name) {
    return !name.empty() && name.size() < 16 &&
           std::all_of(name.begin(), name.end(), [](unsigned char c) { return std::isalnum(c) || c == '.'; }) &&
           name.front() != '.';
}

} // namespace

void readXml(std::string_view input) {
    std::vector<std::string> files;
    std::string_view scene = input.substr(0, input.find(separator));
    for (size_t at = input.find(separator); at != std::string_view::npos;) {
        const size_t begin = at + separator.size(), end = std::min(input.find('\n', begin), input.size());
        at = input.find(separator, end);
        const std::string_view name = input.substr(begin, end - begin);
        if (!isPlain(name)) continue;
        files.push_back(write(std::string(name), input.substr(end, at == std::string_view::npos ? at : at - end)));
    }
    expectInputErrors([&] { loadScene(write("scene.xml", scene), {}, choiceOf(input)); });
    for (const std::string& file : files) std::filesystem::remove(file);
}

} // namespace quasilux::fuzz
