#include "scene/goniograms/file_numbers.h"

#include "scene/xml/numbers.h"

#include <algorithm>
#include <fmt/format.h>

namespace quasilux {

std::vector<std::string_view> splitLines(std::string_view text) {
    std::vector<std::string_view> lines;
    while (!text.empty()) {
        const size_t end = std::min(text.find_first_of("\r\n"), text.size());
        lines.push_back(text.substr(0, end));
        const bool isPair = text.substr(end, 2) == "\r\n";
        text.remove_prefix(std::min(end + (isPair ? 2 : 1), text.size()));
    }
    return lines;
}

double NumberReader::numberFrom(const std::string& what, double lowest) {
    const double value = number(what);
    if (value < lowest) fail(fmt::format("{}: {}; expected at least {}.", what, value, lowest));
    return value;
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

void FileNumbers::finish(const std::string& what) const {
    if (next_ == pieces_.size()) return;
    throw InputError(
        SourceLocation{path_, pieces_[next_].line, 0},
        fmt::format("'{}' follows the last {}; expected the end of the file. The numbers of angles may be wrong.",
                    pieces_[next_].text.substr(0, 40), what));
}

} // namespace quasilux
