#include "scene/goniograms/file_numbers.h"

#include "scene/xml/numbers.h"

#include <algorithm>
#include <fmt/format.h>

namespace quasilux {

std::vector<std::string_view> splitLines(std::string_view text) {
    // Editors begin UTF-8 by a byte order mark, which is no part of the first line.
    constexpr std::string_view mark = "\xef\xbb\xbf";
    if (text.substr(0, mark.size()) == mark) text.remove_prefix(mark.size());
    std::vector<std::string_view> lines;
    while (!text.empty()) {
        const size_t end = std::min(text.find_first_of("\r\n"), text.size());
        lines.push_back(text.substr(0, end));
        const bool isPair = text.substr(end, 2) == "\r\n";
        text.remove_prefix(std::min(end + (isPair ? 2 : 1), text.size()));
    }
    return lines;
}

bool isWord(std::string_view text, std::string_view word) {
    const auto lower = [](char c) { return c >= 'A' && c <= 'Z' ? c - 'A' + 'a' : int(c); };
    return std::equal(text.begin(), text.end(), word.begin(), word.end(),
                      [&](char a, char b) { return lower(a) == lower(b); });
}

std::string_view withoutBlanks(std::string_view text) {
    const size_t first = text.find_first_not_of(" \t");
    return first == std::string_view::npos ? std::string_view{}
                                           : text.substr(first, text.find_last_not_of(" \t") - first + 1);
}

/// Whether it begins like one; what it is worth, parseNumber says.
bool beginsAsNumber(std::string_view text) { return text.find_first_of("0123456789") == text.find_first_not_of("+-."); }

double NumberReader::numberFrom(const std::string& what, double lowest) {
    const double value = number(what);
    if (value < lowest) fail(fmt::format("{}: {}; expected at least {}.", what, value, lowest));
    return value;
}

double NumberReader::intensity(const std::string& what) {
    const double value = number(what);
    largest_ = std::max(largest_, value);
    if (value < least_) {
        least_ = value;
        whereLeast_ = where();
    }
    return std::max(value, 0.0);
}

void NumberReader::rejectNegative(const std::string& what, std::vector<std::string>& warnings) const {
    constexpr double noise = 1e-3;
    if (least_ == 0) return;
    if (!(-least_ <= noise * largest_))
        throw InputError(whereLeast_, fmt::format("{}: {}; expected at least 0.", what, least_));
    warnings.push_back(fmt::format("{}: {}: {}; expected at least 0, to which what is negative is set.",
                                   whereLeast_.text(), what, least_));
}

void NumberReader::addLarger(std::vector<double>& values, double value, const std::string& what) const {
    if (!values.empty() && !(value > values.back()))
        fail(fmt::format("{}: {} follows {}; expected each to be larger than the one before.", what, value,
                         values.back()));
    values.push_back(value);
}

FileNumbers::FileNumbers(std::string path, const std::vector<std::string_view>& lines, size_t first)
    : path_(std::move(path)), lastLine_(static_cast<int>(lines.size())) {
    for (size_t k = first; k < lines.size(); ++k)
        for (const std::string_view piece : splitList(lines[k])) pieces_.push_back({piece, static_cast<int>(k) + 1});
    // Old systems mark the end of a text by Ctrl-Z.
    if (!pieces_.empty() && pieces_.back().text == "\x1a") pieces_.pop_back();
}

SourceLocation FileNumbers::where() const {
    if (pieces_.empty()) return {path_, lastLine_, 0};
    return {path_, pieces_[next_ > 0 ? next_ - 1 : 0].line, 0};
}

const FileNumbers::Piece& FileNumbers::take(const std::string& what) {
    if (next_ == pieces_.size())
        throw InputError(
            SourceLocation{path_, lastLine_, 0},
            fmt::format("the file ends where a number is expected: {}. It may be cut off; get it again.", what));
    return pieces_[next_++];
}

double FileNumbers::number(const std::string& what) {
    const Piece& piece = take(what);
    return parseNumber(piece.text, where(), what);
}

double FileNumbers::positive(const std::string& what) {
    const double value = number(what);
    if (!(value > 0)) fail(fmt::format("{}: {}; expected a number above 0.", what, value));
    return value;
}

unsigned FileNumbers::integer(const std::string& what, unsigned lowest, unsigned highest) {
    const Piece& piece = take(what);
    // Some programs write all numbers with decimals: "1.0".
    const size_t point = piece.text.find('.');
    const bool isWhole = point != std::string_view::npos && point > 0 &&
                         piece.text.find_first_not_of('0', point + 1) == std::string_view::npos;
    const std::string_view digits = isWhole ? piece.text.substr(0, point) : piece.text;
    return static_cast<unsigned>(parseUnsigned(digits, lowest, highest, where(), what));
}

std::vector<double> FileNumbers::increasing(const std::string& what, unsigned count, double lowest, double highest) {
    std::vector<double> values;
    for (unsigned k = 0; k < count; ++k) {
        const double value = number(fmt::format("{}, number {} of {}", what, k + 1, count));
        if (!(value >= lowest && value <= highest))
            fail(fmt::format("{}: {}; expected degrees from {} to {}.", what, value, lowest, highest));
        addLarger(values, value, what);
    }
    return values;
}

bool FileNumbers::isText(size_t further) const {
    return next_ + further < pieces_.size() && !beginsAsNumber(pieces_[next_ + further].text);
}

void FileNumbers::expectNumbers(const std::string& what) const {
    for (size_t k = next_; k < pieces_.size(); ++k) parseNumber(pieces_[k].text, {path_, pieces_[k].line, 0}, what);
}

void FileNumbers::finish(const std::string& what, std::vector<std::string>& warnings) const {
    rejectNegative(what, warnings);
    if (next_ == pieces_.size()) return;
    const auto& [text, line] = pieces_[next_];
    const SourceLocation place{path_, line, 0};
    if (beginsAsNumber(text))
        throw InputError(place, fmt::format("'{}' follows the last {}; expected the end of the file. The numbers of "
                                            "angles may be wrong.",
                                            text.substr(0, 40), what));
    warnings.push_back(fmt::format("{}: '{}' and what follows is left out; the last {} stands before it.", place.text(),
                                   asMessage(std::string(text.substr(0, 40))), what));
}

} // namespace quasilux
