#include "scene/goniograms/ies_file.h"

#include "scene/goniograms/file_numbers.h"
#include "scene/goniograms/sphere_grid.h"
#include "scene/xml/xml_document.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fmt/format.h>
#include <optional>

namespace quasilux {

namespace {

constexpr unsigned mostAnglesOfIes = 3601; // every tenth of a degree all the way round
constexpr unsigned mostLamps = 100000, mostTilts = 1000;
constexpr double metresPerFoot = 0.3048;

enum class Edition { of1986, of1991, of1995, of2002, of2019 };
constexpr std::pair<std::string_view, Edition> editionHeaders[] = {{"IESNA91", Edition::of1991},
                                                                   {"IESNA:LM-63-1995", Edition::of1995},
                                                                   {"IESNA:LM-63-2002", Edition::of2002},
                                                                   {"IES:LM-63-2019", Edition::of2019}};
constexpr std::string_view editionFormats[] = {"IES LM-63-1986", "IES LM-63-1991", "IES LM-63-1995", "IES LM-63-2002",
                                               "IES LM-63-2019"};

/// Without regard to case, which files have either way.
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

/// What width (along C90), length (along C0) and height stand for, signs included, in units of `metres`.
LuminousShape shapeOfLm63(Edition edition, double width, double length, double height, double metres) {
    using Kind = LuminousShape::Kind;
    LuminousShape shape;
    shape.sizeC0 = std::abs(length) * metres;
    shape.sizeC90 = std::abs(width) * metres;
    shape.height = std::abs(height) * metres;
    const bool isRound = width < 0 || length < 0;
    if (edition < Edition::of2002 && setShapeUntil1995(shape, width, length, height)) return shape;
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

/// Beam angles of candela as the file lists them: `horizontal` half planes, or for type B what lies across.
struct IesAngles {
    std::vector<double> vertical, horizontal;
};

class IesReader {
public:
    IesReader(const std::string& path, const std::string& content, const FileCheck& mayRead)
        : mayRead_(mayRead), lines_(splitLines(content)) {
        out_.path = path;
    }

    Goniogram read() {
        readHeader();
        const size_t tiltLine = findTilt();
        const std::string_view tilt = withoutBlanks(tiltOf(lines_[tiltLine]).value());
        FileNumbers numbers(out_.path, lines_, tiltLine + 1);
        if (isWord(tilt, "INCLUDE"))
            readTilt(numbers);
        else if (!isWord(tilt, "NONE"))
            readTiltFile(std::string(tilt), lineAt(tiltLine));
        readData(numbers);
        return std::move(out_);
    }

private:
    SourceLocation lineAt(size_t index) const { return {out_.path, static_cast<int>(index) + 1, 0}; }

    void readHeader() {
        const std::string_view first = lines_.empty() ? std::string_view{} : withoutBlanks(lines_[0]);
        for (const auto& [name, edition] : editionHeaders)
            if (isWord(first, name)) edition_ = edition;
        // The edition of 1986 begins with any line.
        if (edition_ == Edition::of1986 && (isWord(first.substr(0, 4), "IES:") || isWord(first.substr(0, 5), "IESNA")))
            throw InputError(lineAt(0), fmt::format("'{}' is no known edition; expected IESNA91, IESNA:LM-63-1995, "
                                                    "IESNA:LM-63-2002, IES:LM-63-2019 or, of 1986, none.",
                                                    first.substr(0, 60)));
        out_.format = editionFormats[static_cast<size_t>(edition_)];
    }

    /// What follows TILT=, around whose sign files have blanks.
    static std::optional<std::string_view> tiltOf(std::string_view line) {
        const size_t sign = line.find('=');
        if (sign == std::string_view::npos || !isWord(withoutBlanks(line.substr(0, sign)), "TILT")) return {};
        return line.substr(sign + 1);
    }

    /// Index of the line, after those of keywords.
    size_t findTilt() {
        for (size_t k = 0; k < lines_.size(); ++k) {
            const std::string_view line = withoutBlanks(lines_[k]);
            if (tiltOf(line)) return k;
            if (isWord(line.substr(0, 11), "[LUMINAIRE]")) out_.luminaire = withoutBlanks(line.substr(11));
        }
        throw InputError(SourceLocation{out_.path, static_cast<int>(lines_.size()), 0},
                         "the file has no line TILT=NONE, TILT=INCLUDE or TILT= with the name of a file; it is no IES "
                         "LM-63 file, or is cut off.");
    }

    void readTilt(FileNumbers& numbers) {
        numbers.integer("lamp to luminaire geometry", 1, 3);
        const unsigned count = numbers.integer("number of tilt angles", 1, mostTilts);
        out_.tilt.degrees = numbers.increasing("tilt angles", count, -360, 360);
        for (unsigned k = 0; k < count; ++k) out_.tilt.factors.push_back(numbers.numberFrom("tilt factor", 0));
    }

    void readTiltFile(const std::string& name, const SourceLocation& where) {
        if (name.empty()) throw InputError(where, "TILT= says nothing; expected NONE, INCLUDE or the name of a file.");
        const std::string path = (std::filesystem::path(out_.path).parent_path() / name).string();
        if (mayRead_) mayRead_(path, where);
        const std::string content = readFile(path, where, "tilt");
        FileNumbers numbers(path, splitLines(content), 0);
        readTilt(numbers);
        numbers.finish("tilt factor");
    }

    void readData(FileNumbers& numbers) {
        LampSet lamps;
        lamps.lamps = numbers.integer("number of lamps", 1, mostLamps);
        const double lumensPerLamp = numbers.number("lumens per lamp");
        out_.absolute = lumensPerLamp == -1;
        if (!(lumensPerLamp > 0) && !out_.absolute)
            numbers.fail(fmt::format("lumens per lamp: {}; expected a number above 0, or -1 for absolute photometry.",
                                     lumensPerLamp));
        double factor = numbers.positive("candela multiplier");
        const unsigned verticalCount = numbers.integer("number of vertical angles", 2, mostAnglesOfIes);
        const unsigned horizontalCount = numbers.integer("number of horizontal angles", 1, mostAnglesOfIes);
        const unsigned type = numbers.integer("photometric type (1 = C, 2 = B, 3 = A)", 1, 3);
        const double metres = numbers.integer("units type (1 = feet, 2 = metres)", 1, 2) == 1 ? metresPerFoot : 1;
        const double width = numbers.number("width"), length = numbers.number("length"),
                     height = numbers.number("height");
        out_.shape = shapeOfLm63(edition_, width, length, height, metres);
        factor *= numbers.positive("ballast factor");
        factor *= readThirdFactor(numbers);
        lamps.watts = numbers.numberFrom("input watts", 0);
        lamps.lumens = out_.absolute ? 0 : lamps.lamps * lumensPerLamp;
        out_.lampSets = {lamps};
        readIntensities(numbers, type, verticalCount, horizontalCount, factor);
    }

    /// What follows the ballast factor; 1 where the edition has it for something else.
    double readThirdFactor(FileNumbers& numbers) {
        const double third = numbers.positive(edition_ < Edition::of2002    ? "ballast-lamp photometric factor"
                                              : edition_ == Edition::of2002 ? "number for future use"
                                                                            : "file generation type");
        if (edition_ == Edition::of2002 && third != 1)
            out_.warnings.push_back(fmt::format("{}: the number for future use is {}; it is no factor since 2002 and "
                                                "is left out.",
                                                numbers.where().text(), third));
        // A file whose first line is damaged is taken for one of 1986.
        if (edition_ == Edition::of1986 && third != 1)
            out_.warnings.push_back(fmt::format("{}: the first line names no edition, so that the file is one of 1986 "
                                                "and intensities are multiplied by its ballast-lamp photometric "
                                                "factor, {}.",
                                                numbers.where().text(), third));
        return edition_ < Edition::of2002 ? third : 1;
    }

    void readIntensities(FileNumbers& numbers, unsigned type, unsigned verticalCount, unsigned horizontalCount,
                         double factor) {
        const size_t expected = size_t(verticalCount) + horizontalCount + size_t(verticalCount) * horizontalCount;
        if (numbers.left() != expected)
            numbers.fail(fmt::format("{} vertical and {} horizontal angles need {} numbers after this one: the angles, "
                                     "and a candela value for each pair; the file has {}.",
                                     verticalCount, horizontalCount, expected, numbers.left()));
        const double least = type == 1 ? 0 : -90;
        IesAngles angles;
        angles.vertical = numbers.increasing("vertical angles", verticalCount, least, type == 1 ? 180 : 90);
        if (type == 1) checkVertical(numbers, angles.vertical);
        angles.horizontal = numbers.increasing("horizontal angles", horizontalCount, least, type == 1 ? 360 : 90);
        if (type == 1) checkHorizontal(numbers, angles.horizontal);
        if (type != 1 && horizontalCount < 2)
            numbers.fail("horizontal angles: one; expected at least two in photometry of type A or B.");
        std::vector<HalfPlane> planes;
        for (const double angle : angles.horizontal) {
            planes.push_back({angle, {}});
            for (unsigned k = 0; k < verticalCount; ++k)
                planes.back().candela.push_back(factor * numbers.numberFrom("candela value", 0));
        }
        numbers.finish("candela value");
        if (type == 1) {
            if (lacksEnd(angles.horizontal)) // setSphere closes the circle
                out_.warnings.push_back(fmt::format("{}: horizontal angles end at {}, without 360; intensities there "
                                                    "are taken to be those at 0.",
                                                    numbers.where().text(), angles.horizontal.back()));
            setTypeC(angles, std::move(planes));
        } else
            setTypeAOrB(type == 3, angles, planes);
        if (!(out_.largest() > 0)) numbers.fail("every candela value is 0; a luminaire emits light.");
    }

    static void checkVertical(const FileNumbers& numbers, const std::vector<double>& angles) {
        if ((angles.front() != 0 && angles.front() != 90) || (angles.back() != 90 && angles.back() != 180))
            numbers.fail(fmt::format("vertical angles from {} to {}; expected 0 to 90, 90 to 180, or 0 to 180 in "
                                     "photometry of type C.",
                                     angles.front(), angles.back()));
    }

    static void checkHorizontal(const FileNumbers& numbers, const std::vector<double>& angles) {
        const double first = angles.front(), last = angles.back();
        const bool isKnown =
            (first == 0 && (last == 0 || last == 90 || last == 180 || last == 360 || lacksEnd(angles))) ||
            (first == 90 && last == 270);
        if (!isKnown)
            numbers.fail(
                fmt::format("horizontal angles from {} to {}; expected 0 alone, 0 to 90, 0 to 180, 0 to 360, or "
                            "90 to 270 in photometry of type C.",
                            first, last));
    }

    /// Angles all the way round but for the last, 360: it is no further on than others are apart.
    static bool lacksEnd(const std::vector<double>& angles) {
        if (angles.front() != 0 || angles.back() <= 270 || angles.back() == 360) return false;
        double widest = 0;
        for (size_t k = 1; k < angles.size(); ++k) widest = std::max(widest, angles[k] - angles[k - 1]);
        return 360 - angles.back() <= widest * (1 + 1e-6);
    }

    void setTypeC(const IesAngles& angles, std::vector<HalfPlane> planes) {
        const double first = planes.front().azimuth, last = planes.back().azimuth;
        if (first == 90 || last == 90) mirrorPlanes(planes, 90); // also of a quadrant
        if (last == 90 || last == 180) mirrorPlanes(planes, 0);
        out_.axes = axesOfTypeC();
        setSphere(out_, angles.vertical, std::move(planes), true);
    }

    // Type A: half planes about a vertical pole, by horizontal angle. Type B: about a horizontal one, by vertical
    // angle. In a luminaire that looks along its axis +z, +y is up and +x to its left, so horizontal angles run towards
    // -x.
    void setTypeAOrB(bool isTypeA, IesAngles angles, std::vector<HalfPlane> planes) {
        if (angles.horizontal.front() == 0) mirrorHorizontally(angles, planes);
        const std::vector<double>&polar = isTypeA ? angles.vertical : angles.horizontal,
              &azimuth = isTypeA ? angles.horizontal : angles.vertical;
        const size_t rows = polar.size();
        std::vector<double> fromPole(rows);
        for (size_t k = 0; k < rows; ++k) fromPole[k] = 90 - polar[rows - 1 - k];
        std::vector<HalfPlane> half;
        for (size_t column = 0; column < azimuth.size(); ++column) {
            half.push_back({azimuth[column] + 180, {}});
            for (size_t k = 0; k < rows; ++k) {
                const size_t row = rows - 1 - k;
                half.back().candela.push_back(isTypeA ? planes[column].candela[row] : planes[row].candela[column]);
            }
        }
        out_.isOfAxis = false;
        out_.axes =
            isTypeA ? glm::dmat3({0, 0, -1}, {1, 0, 0}, {0, 1, 0}) : glm::dmat3({0, 0, -1}, {0, -1, 0}, {-1, 0, 0});
        setSphere(out_, fromPole, std::move(half), false);
    }

    static void mirrorHorizontally(IesAngles& angles, std::vector<HalfPlane>& planes) {
        for (size_t k = 1, count = planes.size(); k < count; ++k) {
            angles.horizontal.push_back(-angles.horizontal[k]);
            planes.push_back({-planes[k].azimuth, planes[k].candela});
        }
        std::sort(angles.horizontal.begin(), angles.horizontal.end());
        std::sort(planes.begin(), planes.end(),
                  [](const HalfPlane& a, const HalfPlane& b) { return a.azimuth < b.azimuth; });
    }

    const FileCheck& mayRead_;
    std::vector<std::string_view> lines_;
    Edition edition_ = Edition::of1986;
    Goniogram out_;
};

} // namespace

Goniogram readIes(const std::string& path, const std::string& content, const FileCheck& mayRead) {
    return IesReader(path, content, mayRead).read();
}

} // namespace quasilux
