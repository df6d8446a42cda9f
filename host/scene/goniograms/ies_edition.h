// Editions of IES LM-63: which one a file is of, and what its signs of width, length and height mean.
#pragma once

#include "scene/goniograms/goniogram.h"

#include <optional>
#include <string>
#include <string_view>

namespace quasilux {

enum class IesEdition { of1986, of1991, of1995, of2002, of2019 };

struct IesFirstLine {
    IesEdition edition = IesEdition::of1986; ///< whose files begin with any line
    bool isExact = true;                     ///< it is as the edition has it, whatever its case and blanks
};

/// Nothing where it names an edition that is not known.
std::optional<IesFirstLine> readIesFirstLine(std::string_view line);

/// "IES LM-63-2002".
std::string formatOf(IesEdition edition);

/// What width (along C90), length (along C0) and height stand for, signs included, in units of `metres`.
LuminousShape shapeOfLm63(IesEdition edition, double width, double length, double height, double metres);

} // namespace quasilux
