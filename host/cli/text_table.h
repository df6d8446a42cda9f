// Text in columns, and numbers for people.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace quasilux {

/// Left-aligned columns, two blanks between.
class TextTable {
public:
    explicit TextTable(std::vector<std::string> headings) : rows_{std::move(headings)} {}
    /// As many cells as there are headings.
    void add(std::vector<std::string> cells) { rows_.push_back(std::move(cells)); }
    std::string text(const std::string& indent = "") const;

private:
    std::vector<std::vector<std::string>> rows_;
};

/// The first row is the headings.
std::string tableText(const std::vector<std::vector<std::string>>& rows);

/// "512 B", "1.5 MiB".
std::string bytesText(uint64_t bytes);

} // namespace quasilux
