// Header and values of PLY files.
#include "scene/shapes/ply_reader.h"

#include "scene/xml/names.h"
#include "scene/xml/numbers.h"

#include <algorithm>
#include <cstring>
#include <fmt/format.h>
#include <limits>

namespace quasilux {

namespace {

struct TypeName {
    std::string_view name, otherName;
    PlyType type;
};
constexpr TypeName typeNames[] = {
    {"char", "int8", PlyType::int8},        {"uchar", "uint8", PlyType::uint8},
    {"short", "int16", PlyType::int16},     {"ushort", "uint16", PlyType::uint16},
    {"int", "int32", PlyType::int32},       {"uint", "uint32", PlyType::uint32},
    {"float", "float32", PlyType::float32}, {"double", "float64", PlyType::float64},
};

PlyType parseType(std::string_view name, const SourceLocation& where) {
    Names known;
    for (const TypeName& entry : typeNames) {
        if (name == entry.name || name == entry.otherName) return entry.type;
        known.push_back(entry.name);
    }
    throw InputError(where, fmt::format("unknown type '{}'.{}", name, knownNames(name, known)));
}

} // namespace

PlyReader::PlyReader(std::string path, std::string content) : path_(std::move(path)), content_(std::move(content)) {
    readHeader();
}

void PlyReader::failLine(const std::string& message) const {
    throw InputError(SourceLocation{path_, line_, 0}, message);
}

void PlyReader::failFile(const std::string& message) const { throw InputError(SourceLocation{path_, 0, 0}, message); }

void PlyReader::failRow(const std::string& message) const {
    const std::string row = fmt::format("{} {}: {}", element_->name, row_, message);
    if (format_ == Format::ascii) failLine(row);
    failFile(row);
}

std::string_view PlyReader::nextLine() {
    if (position_ >= content_.size()) failLine("the header does not end; expected end_header.");
    ++line_;
    const size_t end = std::min(content_.find('\n', position_), content_.size());
    const std::string_view line = std::string_view(content_).substr(position_, end - position_);
    position_ = std::min(end + 1, content_.size());
    return line;
}

void PlyReader::readHeader() {
    const std::vector<std::string_view> magic = splitList(nextLine());
    if (magic.size() != 1 || magic[0] != "ply") failLine("this is not a PLY file; its first line must be 'ply'.");
    while (true) {
        const std::vector<std::string_view> words = splitList(nextLine());
        if (words.empty() || words[0] == "comment" || words[0] == "obj_info") continue;
        if (words[0] == "end_header") break;
        readHeaderLine(words);
    }
    if (!formatKnown_) failLine("the header has no line 'format'.");
    if (format_ == Format::ascii) ++line_; // values start on the next line
}

void PlyReader::readHeaderLine(const std::vector<std::string_view>& words) {
    if (words[0] == "format" && words.size() == 3) {
        const Names formats = {"ascii", "binary_little_endian", "binary_big_endian"};
        const auto found = std::find(formats.begin(), formats.end(), words[1]);
        if (found == formats.end())
            failLine(fmt::format("unknown format '{}'.{}", words[1], knownNames(words[1], formats)));
        format_ = static_cast<Format>(found - formats.begin());
        formatKnown_ = true;
    } else if (words[0] == "element" && words.size() == 3) {
        const uint64_t maximum = std::numeric_limits<uint32_t>::max() - 1;
        elements_.push_back(
            {std::string(words[1]), parseUnsigned(words[2], 0, maximum, {path_, line_, 0}, "element count"), {}});
    } else if (words[0] == "property" && !elements_.empty()) {
        readPropertyLine(words);
    } else {
        failLine(fmt::format("malformed header line '{}'; expected format, element, property, comment or end_header.",
                             fmt::join(words, " ")));
    }
}

void PlyReader::readPropertyLine(const std::vector<std::string_view>& words) {
    const SourceLocation where{path_, line_, 0};
    PlyProperty property;
    property.isList = words.size() == 5 && words[1] == "list";
    if (!property.isList && words.size() != 3)
        failLine("malformed property; expected 'property TYPE NAME' or 'property list TYPE TYPE NAME'.");
    if (property.isList) property.countType = parseType(words[2], where);
    property.type = parseType(words[words.size() - 2], where);
    property.name = words.back();
    elements_.back().properties.push_back(property);
}

void PlyReader::beginRow(const PlyElement& element, uint64_t number) {
    element_ = &element;
    row_ = number;
    if (element.properties.empty()) failRow("the element has no properties.");
}

void PlyReader::readProperty(const PlyProperty& property, std::vector<double>& values) {
    values.clear();
    if (!property.isList) {
        values.push_back(readValue(property.type));
        return;
    }
    const double count = readValue(property.countType);
    if (!(count >= 0) || count != static_cast<double>(static_cast<uint32_t>(std::min(count, 4e9))))
        failRow(fmt::format("a list of {} values.", count));
    if (count > static_cast<double>(content_.size() - position_))
        failRow(fmt::format("a list of {} values is longer than the file.", count));
    const auto length = static_cast<uint32_t>(count);
    for (uint32_t i = 0; i < length; ++i) values.push_back(readValue(property.type));
}

double PlyReader::readAsciiValue() {
    while (position_ < content_.size() && std::strchr(" \t\r\n", content_[position_])) {
        if (content_[position_] == '\n') ++line_;
        ++position_;
    }
    if (position_ >= content_.size()) failRow("the file ends too early; the header promises more.");
    const size_t end = std::min(content_.find_first_of(" \t\r\n", position_), content_.size());
    const std::string_view word = std::string_view(content_).substr(position_, end - position_);
    position_ = end;
    return parseNumber(word, {path_, line_, 0}, fmt::format("{} {}", element_->name, row_));
}

template <typename T>
double PlyReader::readBinaryValue() {
    if (content_.size() - position_ < sizeof(T)) failRow("the file ends too early; the header promises more.");
    unsigned char bytes[sizeof(T)];
    std::memcpy(bytes, content_.data() + position_, sizeof(T));
    position_ += sizeof(T);
    const uint16_t one = 1;
    unsigned char firstByte = 0;
    std::memcpy(&firstByte, &one, 1);
    if ((format_ == Format::littleEndian) != (firstByte == 1)) std::reverse(bytes, bytes + sizeof(T));
    T value;
    std::memcpy(&value, bytes, sizeof(T));
    return static_cast<double>(value);
}

double PlyReader::readValue(PlyType type) {
    if (format_ == Format::ascii) return readAsciiValue();
    switch (type) {
    case PlyType::int8:
        return readBinaryValue<int8_t>();
    case PlyType::uint8:
        return readBinaryValue<uint8_t>();
    case PlyType::int16:
        return readBinaryValue<int16_t>();
    case PlyType::uint16:
        return readBinaryValue<uint16_t>();
    case PlyType::int32:
        return readBinaryValue<int32_t>();
    case PlyType::uint32:
        return readBinaryValue<uint32_t>();
    case PlyType::float32:
        return readBinaryValue<float>();
    case PlyType::float64:
        return readBinaryValue<double>();
    }
    failRow("unknown type.");
}

void PlyReader::expectEnd() {
    if (content_.find_first_not_of(std::string_view(" \t\r\n\0", 5), position_) != std::string::npos)
        failFile("data follow the last element; the header promises less than the file holds.");
}

} // namespace quasilux
