#include "util/nearest.h"

#include <algorithm>
#include <cctype>
#include <numeric>

namespace quasilux {

namespace {

char lower(char letter) { return static_cast<char>(std::tolower(static_cast<unsigned char>(letter))); }

/// Levenshtein distance without regard to case, one row at a time.
size_t editDistance(const std::string& a, const std::string& b) {
    std::vector<size_t> row(b.size() + 1);
    std::iota(row.begin(), row.end(), size_t{0});
    for (size_t i = 0; i < a.size(); ++i) {
        size_t diagonal = row[0];
        row[0] = i + 1;
        for (size_t j = 0; j < b.size(); ++j) {
            const size_t replaced = diagonal + (lower(a[i]) == lower(b[j]) ? 0 : 1);
            diagonal = row[j + 1];
            row[j + 1] = std::min({replaced, row[j] + 1, diagonal + 1});
        }
    }
    return row.back();
}

} // namespace

std::string nearestName(const std::string& word, const std::vector<std::string>& known) {
    std::string best;
    size_t bestDistance = SIZE_MAX;
    for (const auto& name : known) {
        const size_t distance = editDistance(word, name);
        if (distance < bestDistance && 3 * distance <= std::max<size_t>(name.size(), 3)) {
            bestDistance = distance;
            best = name;
        }
    }
    return best;
}

std::string expectedNames(const std::string& word, const std::vector<std::string>& known) {
    std::string text = "expected ";
    for (size_t i = 0; i < known.size(); ++i) {
        if (i > 0) text += i + 1 == known.size() ? " or " : ", ";
        text += known[i];
    }
    const std::string near = nearestName(word, known);
    return near.empty() ? text : text + ", did you mean '" + near + "'?";
}

} // namespace quasilux
