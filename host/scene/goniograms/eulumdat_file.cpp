#include "scene/goniograms/eulumdat_file.h"

#include "scene/goniograms/file_numbers.h"
#include "scene/goniograms/sphere_grid.h"
#include "scene/xml/numbers.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>

namespace quasilux {

namespace {

constexpr unsigned mostPlanes = 721, mostGammas = 1801, mostLampSets = 20;
constexpr double metresPerMillimetre = 1e-3;

enum EulumdatSymmetry : unsigned { asymmetric, aboutAxis, aboutC0, aboutC90, aboutBoth };

/// One value a line, in a fixed order.
class EulumdatLines : public NumberReader {
public:
    EulumdatLines(const std::string& path, const std::string& content) : path_(path), lines_(splitLines(content)) {}

    std::string_view text(const std::string& what) {
        if (next_ == lines_.size())
            throw InputError(where(),
                             fmt::format("the file ends where a line is expected: {}. It may be cut off; get it "
                                         "again.",
                                         what));
        return lines_[next_++];
    }

    double number(const std::string& what) override {
        std::string line(text(what));
        std::replace(line.begin(), line.end(), ',', '.'); // decimal commas: no line has two numbers
        return parseNumber(line, where(), what);
    }

    /// Where the line is blank, as programs leave what they do not know, it is `unknown`.
    double numberOr(double unknown, const std::string& what) {
        if (next_ == lines_.size() || !isBlank(lines_[next_])) return numberFrom(what, 0);
        ++next_;
        return unknown;
    }
    /// A number that nothing depends on; the line may be blank.
    void skipNumber(const std::string& what) {
        if (next_ < lines_.size() && isBlank(lines_[next_]))
            ++next_;
        else
            number(what);
    }

    unsigned integer(const std::string& what, unsigned lowest, unsigned highest) {
        const double value = number(what);
        if (!(value >= lowest && value <= highest && value == std::floor(value)))
            fail(fmt::format("{}: {}; expected an integer from {} to {}.", what, value, lowest, highest));
        return static_cast<unsigned>(value);
    }

    std::vector<double> increasing(const std::string& what, unsigned count, double highest) {
        std::vector<double> values;
        for (unsigned k = 0; k < count; ++k) {
            const double value = numberFrom(fmt::format("{}, number {} of {}", what, k + 1, count), 0);
            if (value > highest) fail(fmt::format("{}: {}; expected at most {} degrees.", what, value, highest));
            addLarger(values, value, what);
        }
        return values;
    }

    /// Lines up to the first that is no number, or blank.
    size_t numbersLeft() const {
        const auto from = lines_.begin() + static_cast<std::ptrdiff_t>(next_);
        const auto end = std::find_if(from, lines_.end(), [](std::string_view line) { return !beginsNumber(line); });
        return static_cast<size_t>(end - from);
    }
    size_t left() const { return lines_.size() - next_; }

    void finish(std::vector<std::string>& warnings) {
        rejectNegative("luminous intensity", warnings);
        while (next_ < lines_.size() && isBlank(lines_[next_])) ++next_;
        if (next_ == lines_.size()) return;
        const SourceLocation place{path_, static_cast<int>(next_) + 1, 0};
        if (beginsNumber(lines_[next_]))
            throw InputError(place, "a line follows the last intensity; expected the end of the file. The numbers of "
                                    "angles may be wrong.");
        warnings.push_back(place.text() + ": text follows the last intensity and is left out.");
    }

    /// Of the line that was read last.
    SourceLocation where() const override { return {path_, static_cast<int>(next_), 0}; }

private:
    // Old systems mark the end of a text by Ctrl-Z.
    static bool isBlank(std::string_view line) { return line.find_first_not_of(" \t\x1a") == std::string_view::npos; }
    static bool beginsNumber(std::string_view line) {
        const size_t first = line.find_first_not_of(" \t");
        return first != std::string_view::npos && beginsAsNumber(line.substr(first));
    }

    std::string path_;
    std::vector<std::string_view> lines_;
    size_t next_ = 0;
};

struct EulumdatCounts {
    unsigned symmetry, planes, angles;

    /// Half planes whose intensities the file lists.
    unsigned listed() const {
        switch (symmetry) {
        case aboutAxis:
            return 1;
        case aboutC0:
        case aboutC90:
            return planes / 2 + 1;
        case aboutBoth:
            return planes / 4 + 1;
        default:
            return planes;
        }
    }
};

EulumdatCounts readEulumdatCounts(EulumdatLines& lines) {
    lines.text("company");
    lines.skipNumber("type indicator Ityp");
    EulumdatCounts counts{};
    counts.symmetry = lines.integer("symmetry indicator Isym", 0, 4);
    counts.planes = lines.integer("number of C-planes Mc", 1, mostPlanes);
    const unsigned parts = counts.symmetry == aboutBoth                                ? 4
                           : counts.symmetry == aboutC0 || counts.symmetry == aboutC90 ? 2
                                                                                       : 1;
    // From C270 on, a quarter of the planes must come before C0.
    const unsigned divisor = counts.symmetry == aboutC90 ? 4 : parts;
    if (counts.planes % divisor != 0)
        lines.fail(fmt::format("number of C-planes Mc: {}; expected a multiple of {} with symmetry {}.", counts.planes,
                               divisor, counts.symmetry));
    lines.skipNumber("distance between C-planes Dc");
    counts.angles = lines.integer("number of angles Ng", 2, mostGammas);
    lines.skipNumber("distance between angles Dg");
    return counts;
}

LuminousShape readLuminousArea(EulumdatLines& lines) {
    for (const char* what : {"length of the luminaire", "width of the luminaire", "height of the luminaire"})
        lines.skipNumber(what);
    LuminousShape shape;
    shape.sizeC90 = metresPerMillimetre * lines.numberOr(0, "length or diameter of the luminous area");
    shape.sizeC0 = metresPerMillimetre * lines.numberOr(0, "width of the luminous area");
    for (const char* what :
         {"luminous height, C0", "luminous height, C90", "luminous height, C180", "luminous height, C270"})
        shape.height += metresPerMillimetre / 4 * lines.numberOr(0, what);
    using Kind = LuminousShape::Kind;
    if (shape.sizeC90 > 0 && shape.sizeC0 == 0) {
        shape.kind = Kind::uprightRod;
        shape.sizeC0 = shape.sizeC90;
    } else if (shape.sizeC0 > 0 || shape.height > 0)
        shape.kind = Kind::box;
    return shape;
}

LampSet readLampSet(EulumdatLines& lines, bool& isAbsolute) {
    LampSet set;
    set.lamps = lines.number("number of lamps");
    if (set.lamps == 0 || set.lamps != std::floor(set.lamps) || std::abs(set.lamps) > 1e6)
        lines.fail(fmt::format("number of lamps: {}; expected an integer above 0, or below it for absolute photometry.",
                               set.lamps));
    isAbsolute = set.lamps < 0;
    set.lamps = std::abs(set.lamps);
    set.name = lines.text("type of lamps");
    set.lumens = lines.numberFrom("total luminous flux of lamps", 0);
    if (set.lumens == 0) lines.fail("total luminous flux of lamps: 0; expected lumens above 0.");
    lines.text("colour of the light");
    lines.text("colour rendering");
    set.watts = lines.numberOr(0, "wattage including ballast");
    return set;
}

void readLampSets(EulumdatLines& lines, Goniogram& goniogram) {
    const unsigned count = lines.integer("number of sets of lamps", 1, mostLampSets);
    for (unsigned k = 0; k < count; ++k) {
        bool isAbsolute = false;
        goniogram.lampSets.push_back(readLampSet(lines, isAbsolute));
        if (k == goniogram.lampSet) goniogram.absolute = isAbsolute;
    }
}

void expectAt(const EulumdatLines& lines, double found, double expected) {
    if (std::abs(found - expected) > 1e-3)
        lines.fail(fmt::format("C-angles: {} where the symmetry needs {}.", found, expected));
}

/// The file lists the azimuths of all planes, but intensities only from plane `first` on, and those of C270 before C0.
std::vector<HalfPlane> listedPlanes(EulumdatLines& lines, const EulumdatCounts& counts) {
    const std::vector<double> all = lines.increasing("C-angles", counts.planes, 360);
    expectAt(lines, all[0], 0);
    const unsigned first = counts.symmetry == aboutC90 ? 3 * counts.planes / 4 : 0;
    std::vector<HalfPlane> planes;
    for (unsigned k = 0; k < counts.listed(); ++k) planes.push_back({all[(first + k) % counts.planes], {}});
    if (counts.symmetry == aboutC0) expectAt(lines, planes.back().azimuth, 180);
    if (counts.symmetry == aboutBoth || counts.symmetry == aboutC90) expectAt(lines, planes.back().azimuth, 90);
    if (counts.symmetry == aboutC90) expectAt(lines, planes.front().azimuth, 270);
    return planes;
}

void mirrorAll(std::vector<HalfPlane>& planes, unsigned symmetry) {
    if (symmetry == aboutC90 || symmetry == aboutBoth) mirrorPlanes(planes, 90);
    if (symmetry == aboutC0 || symmetry == aboutBoth) mirrorPlanes(planes, 0);
}

/// Some files list all planes in spite of their symmetry: then it says nothing that they do not.
void noticeAllPlanes(const EulumdatLines& lines, EulumdatCounts& counts, Goniogram& goniogram) {
    const size_t angles = size_t(counts.planes) + counts.angles;
    if (counts.listed() == counts.planes || lines.numbersLeft() != angles + size_t(counts.planes) * counts.angles)
        return;
    goniogram.warnings.push_back(
        fmt::format("{}: the file has symmetry {} and intensities of {} planes, but lists those "
                    "of all {}, which are taken.",
                    lines.where().text(), counts.symmetry, counts.listed(), counts.planes));
    counts.symmetry = asymmetric;
}

void readIntensities(EulumdatLines& lines, EulumdatCounts counts, double candelaPerUnit, Goniogram& goniogram) {
    noticeAllPlanes(lines, counts, goniogram);
    std::vector<HalfPlane> planes = listedPlanes(lines, counts);
    const std::vector<double> polar = lines.increasing("gamma angles", counts.angles, 180);
    const size_t expected = size_t(counts.listed()) * counts.angles;
    if (lines.left() < expected)
        lines.fail(
            fmt::format("{} planes of {} angles need {} intensities after this line; the file has {} lines more. It "
                        "may be cut off; get it again.",
                        counts.listed(), counts.angles, expected, lines.left()));
    for (HalfPlane& plane : planes)
        for (unsigned k = 0; k < counts.angles; ++k)
            plane.candela.push_back(candelaPerUnit * lines.intensity("luminous intensity"));
    lines.finish(goniogram.warnings);
    mirrorAll(planes, counts.symmetry);
    goniogram.axes = axesOfTypeC();
    setSphere(goniogram, polar, std::move(planes), true);
    if (!(goniogram.largest() > 0)) lines.fail("every luminous intensity is 0; a luminaire emits light.");
}

} // namespace

Goniogram readEulumdat(const std::string& path, const std::string& content, const SourceLocation& where,
                       size_t lampSet) {
    EulumdatLines lines(path, content);
    Goniogram goniogram;
    goniogram.path = path;
    goniogram.format = "EULUMDAT";
    goniogram.lampSet = lampSet - 1;
    const EulumdatCounts counts = readEulumdatCounts(lines);
    lines.text("number of the report");
    goniogram.luminaire = lines.text("name of the luminaire");
    for (const char* what : {"number of the luminaire", "name of the file", "date"}) lines.text(what);
    goniogram.shape = readLuminousArea(lines);
    lines.skipNumber("downward flux fraction DFF");
    goniogram.statedRatio = lines.numberOr(0, "light output ratio LORL");
    constexpr double unknown = -1;
    double factor = lines.numberOr(unknown, "conversion factor for luminous intensities");
    if (factor == unknown) {
        factor = 1;
        goniogram.warnings.push_back(lines.where().text() +
                                     ": the conversion factor for luminous intensities is blank and taken for 1.");
    }
    if (factor == 0) lines.fail("conversion factor for luminous intensities: 0; expected a number above 0.");
    if (const double tilt = lines.numberOr(0, "tilt of the luminaire during measurement"); tilt != 0)
        goniogram.warnings.push_back(fmt::format(
            "{}: the luminaire was tilted by {} degrees while it was measured, which is left out; turn it by "
            "to_world where its C planes are meant without that tilt.",
            lines.where().text(), tilt));
    readLampSets(lines, goniogram);
    if (lampSet < 1 || lampSet > goniogram.lampSets.size())
        throw InputError(where, fmt::format("there is no set of lamps number {} in '{}'; expected 1 to {}.", lampSet,
                                            path, goniogram.lampSets.size()));
    for (double& ratio : goniogram.directRatios) ratio = lines.numberOr(0, "direct ratio DR");
    const double candelaPerUnit = factor * goniogram.lampSets[goniogram.lampSet].lumens / 1000; // given as cd/klm
    readIntensities(lines, counts, candelaPerUnit, goniogram);
    return goniogram;
}

} // namespace quasilux
