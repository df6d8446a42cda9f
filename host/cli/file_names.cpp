#include "cli/file_names.h"

#include "util/error.h"
#include "util/nearest.h"

#include <algorithm>
#include <array>
#include <ctime>
#include <filesystem>
#include <fmt/format.h>
#include <vector>

namespace quasilux {

namespace fs = std::filesystem;

namespace {

const std::vector<std::string> nameWords{"scene", "sensor", "date", "seed", "passes"};

std::string placeOf(const std::string& word) { return '{' + word + '}'; }

std::string today() {
    const std::time_t now = std::time(nullptr);
    std::tm day{};
    localtime_r(&now, &day);
    std::array<char, 16> text{};
    return {text.data(), std::strftime(text.data(), text.size(), "%Y-%m-%d", &day)};
}

} // namespace

void checkNamePattern(const std::string& pattern, const std::string& option, NameNeeded when) {
    for (size_t open = pattern.find('{'); open != std::string::npos; open = pattern.find('{', open + 1)) {
        const size_t close = pattern.find('}', open);
        if (close == std::string::npos)
            throw InputError(fmt::format("{} {}: '{{' without '}}', expected a word between them, such as {{scene}}",
                                         option, pattern));
        const std::string word = pattern.substr(open + 1, close - open - 1);
        if (std::find(nameWords.begin(), nameWords.end(), word) == nameWords.end())
            throw InputError(
                fmt::format("{} {}: unknown {}, {}", option, pattern, placeOf(word), expectedNames(word, nameWords)));
        if (word != "seed" && word != "passes") continue;
        if (when == NameNeeded::beforeLoading)
            throw InputError(
                fmt::format("{} {}: {} is known too late for this name, leave it out", option, pattern, placeOf(word)));
        if (pattern.find('/', close) != std::string::npos)
            throw InputError(fmt::format("{} {}: {} is known too late to be part of a folder's name, write it into the "
                                         "file's",
                                         option, pattern, placeOf(word)));
    }
}

bool hasPlace(const std::string& pattern, const std::string& word) {
    return pattern.find(placeOf(word)) != std::string::npos;
}

std::string fillName(std::string pattern, const NameParts& known) {
    for (auto [word, value] : known) {
        std::replace(value.begin(), value.end(), '/', '_');
        const std::string place = placeOf(word);
        for (size_t at = pattern.find(place); at != std::string::npos; at = pattern.find(place, at + value.size()))
            pattern.replace(at, place.size(), value);
    }
    return pattern;
}

NameParts namePartsOf(const std::string& scene) {
    return {{"scene", fs::path(scene).stem().string()}, {"date", today()}};
}

NameParts namePartsOf(unsigned long long seed, unsigned long long passes) {
    return {{"seed", std::to_string(seed)}, {"passes", std::to_string(passes)}};
}

std::string inFolder(const std::string& folder, const std::string& name) {
    const bool stays = folder.empty() || name.empty() || fs::path(name).has_parent_path();
    if (stays) return name;
    std::error_code unknown;
    if (!fs::is_directory(folder, unknown))
        throw InputError(
            fmt::format("--folder {0} (or QUASILUX_OUTPUT): folder {0} does not exist, create it first", folder));
    return (fs::path(folder) / name).string();
}

} // namespace quasilux
