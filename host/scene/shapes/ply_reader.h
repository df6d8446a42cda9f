// Header and values of PLY files, without their meaning.
#pragma once

#include "util/error.h"

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace quasilux {

enum class PlyType { int8, uint8, int16, uint16, int32, uint32, float32, float64 };

struct PlyProperty {
    std::string name;
    PlyType type = PlyType::float32;
    bool isList = false;
    PlyType countType = PlyType::uint8; ///< of a list
};

struct PlyElement {
    std::string name;
    uint64_t count = 0;
    std::vector<PlyProperty> properties;
};

/// Reads values in the order of the file. Errors name the line (ascii) or the number of the element (binary).
class PlyReader {
public:
    /// Reads the header. Throws InputError at file:line.
    PlyReader(std::string path, std::string content);

    const std::vector<PlyElement>& elements() const { return elements_; }

    /// The next values belong to row `number`, counted from 0, of `element`.
    void beginRow(const PlyElement& element, uint64_t number);
    /// One value, or those of a list.
    void readProperty(const PlyProperty& property, std::vector<double>& values);
    /// Throws InputError if anything but white space follows.
    void expectEnd();

    [[noreturn]] void failRow(const std::string& message) const;
    [[noreturn]] void failFile(const std::string& message) const;

private:
    enum class Format { ascii, littleEndian, bigEndian };

    void readHeader();
    void readHeaderLine(const std::vector<std::string_view>& words);
    void readPropertyLine(const std::vector<std::string_view>& words);
    std::string_view nextLine();
    [[noreturn]] void failLine(const std::string& message) const;
    double readValue(PlyType type);
    double readAsciiValue();
    template <typename T>
    double readBinaryValue();

    std::string path_, content_;
    size_t position_ = 0;
    int line_ = 0;
    Format format_ = Format::ascii;
    bool formatKnown_ = false;
    std::vector<PlyElement> elements_;
    const PlyElement* element_ = nullptr;
    uint64_t row_ = 0;
};

} // namespace quasilux
