#include "scene/goniograms/ies_edition.h"

#include "scene/goniograms/file_numbers.h"

#include <algorithm>
#include <cmath>

namespace quasilux {

namespace {

constexpr std::pair<std::string_view, IesEdition> editionHeaders[] = {{"IESNA91", IesEdition::of1991},
                                                                      {"IESNA:LM-63-1995", IesEdition::of1995},
                                                                      {"IESNA:LM-63-2002", IesEdition::of2002},
                                                                      {"IES:LM-63-2019", IesEdition::of2019}};
constexpr std::string_view editionFormats[] = {"IES LM-63-1986", "IES LM-63-1991", "IES LM-63-1995", "IES LM-63-2002",
                                               "IES LM-63-2019"};

bool isDigit(char c) { return c >= '0' && c <= '9'; }

/// Of the digits after "63-", or else at its end, of two or four: "IESNA:LM-63-02" and "IESNA95", too.
std::optional<int> yearOf(std::string_view line) {
    const size_t name = line.find("63-");
    size_t first = name == std::string_view::npos ? line.size() : name + 3, end = first;
    if (name == std::string_view::npos)
        while (first > 0 && isDigit(line[first - 1])) --first;
    else
        while (end < line.size() && isDigit(line[end])) ++end;
    if (end - first != 2 && end - first != 4) return {};
    int year = 0;
    for (const char digit : line.substr(first, end - first)) year = 10 * year + (digit - '0');
    if (end - first == 2) year += year < 80 ? 2000 : 1900;
    return year;
}

std::optional<IesEdition> editionOfYear(int year) {
    if (year == 1986) return IesEdition::of1986;
    if (year == 1991) return IesEdition::of1991;
    if (year == 1995) return IesEdition::of1995;
    if (year == 2002) return IesEdition::of2002;
    if (year == 2019) return IesEdition::of2019;
    return {};
}

/// The rows of LM-63-1995 that the edition of 2002 gives another meaning, or none, after I. Ashdown, "Parsing the IESNA
/// LM-63 photometric data file" (1998), where (width, length, height) are (-d, 0, -d) a sphere, (0, l, -d) and (w, 0,
/// -d) cylinders that lie, (-w, l, h) and (w, -l, h) ellipses, and with -h ellipsoids. False for all others: circles,
/// upright cylinders and boxes are the same in both tables.
bool setShapeUntil1995(LuminousShape& shape, double width, double length, double height) {
    using Kind = LuminousShape::Kind;
    if (width * length < 0) { // one of them is negative: an ellipse
        shape.kind = height < 0 ? Kind::ellipsoid : Kind::uprightRod;
        return true;
    }
    if (height >= 0 || (width == 0) == (length == 0)) return false;
    if (width < 0) {
        shape.kind = Kind::ellipsoid;
        shape.sizeC0 = shape.sizeC90;
    } else if (length > 0) {
        shape.kind = Kind::rodAlongC0;
        shape.sizeC90 = shape.height;
    } else if (width > 0) {
        shape.kind = Kind::rodAlongC90;
        shape.sizeC0 = shape.height;
    } else {
        return false; // (0, -l, -h) is in neither
    }
    return true;
}

} // namespace

std::optional<IesFirstLine> readIesFirstLine(std::string_view line) {
    std::string text(line);
    text.erase(std::remove_if(text.begin(), text.end(), [](char c) { return c == ' ' || c == '\t'; }), text.end());
    for (const auto& [name, edition] : editionHeaders)
        if (isWord(text, name)) return IesFirstLine{edition, true};
    const auto begins = [&](std::string_view word) {
        return isWord(std::string_view(text).substr(0, word.size()), word);
    };
    if (!begins("IES:") && !begins("IESNA") && !begins("IESLM-63")) return IesFirstLine{}; // the last without its colon
    const std::optional<int> year = yearOf(text);
    const std::optional<IesEdition> edition = year ? editionOfYear(*year) : std::nullopt;
    if (!edition) return {};
    return IesFirstLine{*edition, false};
}

std::string formatOf(IesEdition edition) { return std::string(editionFormats[static_cast<size_t>(edition)]); }

LuminousShape shapeOfLm63(IesEdition edition, double width, double length, double height, double metres) {
    using Kind = LuminousShape::Kind;
    LuminousShape shape;
    shape.sizeC0 = std::abs(length) * metres;
    shape.sizeC90 = std::abs(width) * metres;
    shape.height = std::abs(height) * metres;
    const bool isRound = width < 0 || length < 0;
    if (edition < IesEdition::of2002 && setShapeUntil1995(shape, width, length, height)) return shape;
    if (height < 0 && isRound) { // rounded also upright: an ellipsoid, or a cylinder that lies
        shape.kind = width >= 0 ? Kind::rodAlongC90 : length >= 0 ? Kind::rodAlongC0 : Kind::ellipsoid;
    } else if (isRound && !(width > 0) && !(length > 0)) {
        shape.kind = Kind::uprightRod;
        // Until 1995 one diameter says it.
        if (length == 0) shape.sizeC0 = shape.sizeC90;
        if (width == 0) shape.sizeC90 = shape.sizeC0;
    } else {
        shape.kind = width == 0 && length == 0 && height == 0 ? Kind::point : Kind::box;
    }
    return shape;
}

} // namespace quasilux
