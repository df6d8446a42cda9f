// Numbers from text, strictly: the whole text, finite, in range.
#pragma once

#include "util/error.h"

#include <cstdint>
#include <string_view>
#include <vector>

namespace quasilux {

/// Non-empty pieces between commas and white space.
std::vector<std::string_view> splitList(std::string_view text);

/// A finite number. Throws InputError that says which `what` could not be read.
double parseNumber(std::string_view text, const SourceLocation& where, std::string_view what);

/// As many finite numbers as there are pieces in `text`.
std::vector<double> parseNumbers(std::string_view text, const SourceLocation& where, std::string_view what);

/// An integer of at most 64 bits.
int64_t parseInteger(std::string_view text, const SourceLocation& where, std::string_view what);

/// An integer from `lowest` to `highest`.
uint64_t parseUnsigned(std::string_view text, uint64_t lowest, uint64_t highest, const SourceLocation& where,
                       std::string_view what);

} // namespace quasilux
