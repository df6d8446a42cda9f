// Edit distance between names.
#include "util/nearest.h"

#include <algorithm>
#include <cctype>
#include <cstdint>

namespace quasilux {

namespace {

constexpr size_t longestName = 200;

char lower(char letter) { return static_cast<char>(std::tolower(static_cast<unsigned char>(letter))); }

/// Insertions, deletions, replacements and swaps of neighbours (optimal string alignment), without regard to case.
size_t editDistance(const std::string& a, const std::string& b) {
    std::vector<std::vector<size_t>> edits(a.size() + 1, std::vector<size_t>(b.size() + 1));
    for (size_t i = 0; i <= a.size(); ++i) {
        for (size_t j = 0; j <= b.size(); ++j) {
            if (i == 0 || j == 0) {
                edits[i][j] = i + j;
                continue;
            }
            const size_t replaced = edits[i - 1][j - 1] + (lower(a[i - 1]) == lower(b[j - 1]) ? 0 : 1);
            edits[i][j] = std::min({replaced, edits[i - 1][j] + 1, edits[i][j - 1] + 1});
            if (i > 1 && j > 1 && lower(a[i - 1]) == lower(b[j - 2]) && lower(a[i - 2]) == lower(b[j - 1]))
                edits[i][j] = std::min(edits[i][j], edits[i - 2][j - 2] + 1);
        }
    }
    return edits[a.size()][b.size()];
}

} // namespace

std::string nearestName(const std::string& word, const std::vector<std::string>& known) {
    std::string best;
    size_t bestDistance = SIZE_MAX;
    for (const auto& name : known) {
        // Names that differ so much in length cannot be near, and long ones would take hours to compare.
        const size_t longer = std::max(word.size(), name.size()), shorter = std::min(word.size(), name.size());
        if (longer > longestName || 3 * (longer - shorter) > std::max<size_t>(name.size(), 3)) continue;
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
