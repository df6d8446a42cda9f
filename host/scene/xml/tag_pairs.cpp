// Reads no more of XML than where tags begin and end.
#include "scene/xml/tag_pairs.h"

#include <vector>

namespace quasilux {
namespace {

constexpr size_t none = std::string_view::npos;
constexpr std::string_view blanks = " \t\r\n";

/// Where the comment, instruction or declaration at `at` ends, or `at` for a tag; `none` where it has no end.
size_t endOfOther(std::string_view text, size_t at) {
    constexpr std::string_view others[][2] = {{"<!--", "-->"}, {"<![CDATA[", "]]>"}, {"<?", "?>"}, {"<!", ">"}};
    for (const auto& [begin, end] : others) {
        if (text.compare(at, begin.size(), begin) != 0) continue;
        const size_t found = text.find(end, at + begin.size());
        return found == none ? none : found + end.size();
    }
    return at;
}

/// The '>' of the tag whose inside begins at `at`, past all values of attributes; `none` where it has none.
size_t endOfTag(std::string_view text, size_t at) {
    for (at = text.find_first_of("<>\"'", at); at != none; at = text.find_first_of("<>\"'", at + 1)) {
        if (text[at] == '>') return at;
        if (text[at] == '<') return none;
        at = text.find(text[at], at + 1);
        if (at == none) return none;
    }
    return none;
}

} // namespace

std::optional<TagMismatch> findTagMismatch(std::string_view text) {
    struct Open {
        std::string_view name;
        size_t at;
    };
    std::vector<Open> open;
    for (size_t at = text.find('<'); at != none; at = text.find('<', at)) {
        const size_t next = endOfOther(text, at);
        if (next == none) return std::nullopt;
        if (next != at) {
            at = next;
            continue;
        }
        const bool isEnd = text.compare(at, 2, "</") == 0;
        const size_t begin = at + (isEnd ? 2 : 1), end = endOfTag(text, begin);
        if (end == none) return std::nullopt;
        const std::string_view inside = text.substr(begin, end - begin);
        const std::string_view name = inside.substr(0, inside.find_first_of(isEnd ? blanks : " \t\r\n/"));
        if (isEnd) {
            if (open.empty()) return TagMismatch{{}, name, 0, at};
            if (open.back().name != name) return TagMismatch{open.back().name, name, open.back().at, at};
            open.pop_back();
        } else if (inside.empty() || inside.back() != '/') {
            open.push_back({name, at});
        }
        at = end;
    }
    if (open.empty()) return std::nullopt;
    return TagMismatch{open.back().name, {}, open.back().at, text.size()};
}

} // namespace quasilux
