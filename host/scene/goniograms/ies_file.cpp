#include "scene/goniograms/ies_file.h"

#include "scene/goniograms/file_numbers.h"
#include "scene/goniograms/ies_edition.h"
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

    void warn(const std::string& where, const std::string& message) { out_.warnings.push_back(where + ": " + message); }

    void readHeader() {
        size_t line = 0;
        while (line + 1 < lines_.size() && withoutBlanks(lines_[line]).empty()) ++line;
        const std::string_view first = lines_.empty() ? std::string_view{} : withoutBlanks(lines_[line]);
        const std::optional<IesFirstLine> found = readIesFirstLine(first);
        if (!found)
            throw InputError(lineAt(line), fmt::format("'{}' is no known edition; expected IESNA91, IESNA:LM-63-1995, "
                                                       "IESNA:LM-63-2002, IES:LM-63-2019 or, of 1986, none.",
                                                       first.substr(0, 60)));
        edition_ = found->edition;
        out_.format = formatOf(edition_);
        namesEdition_ = edition_ != IesEdition::of1986 || !found->isExact;
        if (!found->isExact)
            warn(lineAt(line).text(), fmt::format("'{}' is taken for {}.", first.substr(0, 60), out_.format));
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
            keepName(line);
        }
        throw InputError(SourceLocation{out_.path, static_cast<int>(lines_.size()), 0},
                         "the file has no line TILT=NONE, TILT=INCLUDE or TILT= with the name of a file; it is no IES "
                         "LM-63 file, or is cut off.");
    }

    /// Of several lines the first; a catalogue number where nothing else is said.
    void keepName(std::string_view line) {
        const bool isName = isWord(line.substr(0, 11), "[LUMINAIRE]");
        if (!isName && !isWord(line.substr(0, 8), "[LUMCAT]")) return;
        const std::string_view name = withoutBlanks(line.substr(isName ? 11 : 8));
        if (name.empty() || (hasName_ || (!isName && !out_.luminaire.empty()))) return;
        out_.luminaire = name;
        hasName_ = isName;
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
        if (!std::filesystem::exists(path))
            throw InputError(where,
                             fmt::format("cannot read the tilt file '{}': there is no such file. Get it from who "
                                         "made this one, or, where the luminaire is not tilted, write TILT=NONE.",
                                         path));
        const std::string content = readFile(path, where, "tilt");
        FileNumbers numbers(path, splitLines(content), 0);
        readTilt(numbers);
        numbers.finish("tilt factor", out_.warnings);
    }

    void readData(FileNumbers& numbers) {
        LampSet lamps;
        lamps.lamps = numbers.integer("number of lamps", 1, mostLamps);
        const double lumensPerLamp = numbers.number("lumens per lamp");
        out_.absolute = !(lumensPerLamp > 0);
        if (out_.absolute && lumensPerLamp != -1)
            warn(numbers.where().text(),
                 fmt::format("lumens per lamp: {}; expected a number above 0, or -1 for absolute "
                             "photometry, as which it is taken.",
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
        if (edition_ >= IesEdition::of2002) {
            const bool isOf2002 = edition_ == IesEdition::of2002;
            const double third = numbers.number(isOf2002 ? "number for future use" : "file generation type");
            if (isOf2002 && third != 1)
                warn(numbers.where().text(), fmt::format("the number for future use is {}; it is no factor since 2002 "
                                                         "and is left out.",
                                                         third));
            return 1;
        }
        const double third = numbers.positive("ballast-lamp photometric factor");
        // A file whose first line is damaged is taken for one of 1986.
        if (!namesEdition_ && third != 1)
            warn(numbers.where().text(), fmt::format("the first line names no edition, so that the file is one of 1986 "
                                                     "and intensities are multiplied by its ballast-lamp photometric "
                                                     "factor, {}.",
                                                     third));
        return third;
    }

    void readIntensities(FileNumbers& numbers, unsigned type, unsigned verticalCount, unsigned horizontalCount,
                         double factor) {
        expectCount(numbers, verticalCount, horizontalCount);
        const double least = type == 1 ? 0 : -90;
        IesAngles angles;
        angles.vertical = numbers.increasing("vertical angles", verticalCount, least, type == 1 ? 180 : 90);
        type == 1 ? checkVertical(numbers, angles.vertical) : checkVerticalOfAOrB(numbers, angles.vertical);
        angles.horizontal = numbers.increasing("horizontal angles", horizontalCount, least, type == 1 ? 360 : 90);
        type == 1 ? checkHorizontal(numbers, angles.horizontal) : checkHorizontalOfAOrB(numbers, angles.horizontal);
        std::vector<HalfPlane> planes;
        for (const double angle : angles.horizontal) {
            planes.push_back({angle, {}});
            for (unsigned k = 0; k < verticalCount; ++k)
                planes.back().candela.push_back(factor * numbers.intensity("candela value"));
        }
        numbers.finish("candela value", out_.warnings);
        if (type == 1)
            setTypeC(angles, std::move(planes));
        else
            setTypeAOrB(type == 3, angles, planes);
        if (!(out_.largest() > 0)) numbers.fail("every candela value is 0; a luminaire emits light.");
    }

    /// A wrong count has a message of its own. Text may follow: ERCO's files end with END.
    static void expectCount(FileNumbers& numbers, unsigned verticalCount, unsigned horizontalCount) {
        const size_t expected = size_t(verticalCount) + horizontalCount + size_t(verticalCount) * horizontalCount;
        if (numbers.left() == expected || numbers.isText(expected)) return;
        numbers.expectNumbers("angle or candela value");
        numbers.fail(fmt::format("{} vertical and {} horizontal angles need {} numbers after this one: the angles, "
                                 "and a candela value for each pair; the file has {}.",
                                 verticalCount, horizontalCount, expected, numbers.left()));
    }

    void checkVertical(const FileNumbers& numbers, const std::vector<double>& angles) {
        const double first = angles.front(), last = angles.back();
        if (first != 0 && first < 90)
            numbers.fail(fmt::format("vertical angles from {} to {}; expected 0 to 90, 90 to 180, or 0 to 180 in "
                                     "photometry of type C.",
                                     first, last));
        // Until 1995 the standard leaves open where they end.
        if ((first != 0 && first != 90) || (last != 90 && last != 180))
            warn(numbers.where().text(), fmt::format("vertical angles from {} to {}; expected 0 to 90, 90 to 180, or 0 "
                                                     "to 180. Beyond them it is dark.",
                                                     first, last));
    }

    // Since 2002 angles must cover the whole half space, so that what begins at 0 is symmetric.
    void checkVerticalOfAOrB(const FileNumbers& numbers, const std::vector<double>& angles) {
        if (angles.front() >= 0)
            warn(numbers.where().text(),
                 fmt::format("vertical angles begin at {}; intensities below are taken to be those above.",
                             angles.front()));
    }

    void checkHorizontalOfAOrB(const FileNumbers& numbers, const std::vector<double>& angles) {
        if (angles.size() < 2)
            numbers.fail("horizontal angles: one; expected at least two in photometry of type A or B.");
        if (angles.front() > 0)
            warn(numbers.where().text(), fmt::format("horizontal angles begin at {}; expected 0 or -90. They are taken "
                                                     "to be the same on the other side.",
                                                     angles.front()));
    }

    void checkHorizontal(const FileNumbers& numbers, const std::vector<double>& angles) {
        const double first = angles.front(), last = angles.back();
        if (lacksEnd(angles)) // setSphere closes the circle
            return warn(numbers.where().text(), fmt::format("horizontal angles end at {}, without 360; intensities "
                                                            "there are taken to be those at 0.",
                                                            last));
        const bool isKnown =
            (first == 0 && (last == 0 || last == 90 || last == 180 || last == 360)) || (first == 90 && last == 270);
        if (!isKnown)
            numbers.fail(
                fmt::format("horizontal angles from {} to {}; expected 0 alone, 0 to 90, 0 to 180, 0 to 360, or "
                            "90 to 270 in photometry of type C.",
                            first, last));
    }

    /// Angles all the way round but for the last, 360: it is no further on than others are apart.
    static bool lacksEnd(const std::vector<double>& angles) {
        if (angles.front() != 0 || angles.back() <= 180 || angles.back() == 360) return false;
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

    // Type A: half planes about a pole, by horizontal angle. Type B: about another one, by vertical angle. In LM-63 the
    // photometric horizontal is C0 and gamma 90 of type C and horizontal 0 and vertical 90 of type B, and horizontal
    // angles run clockwise, against C: vertical angles go towards C0, +x, and horizontal ones towards C270, +y.
    void setTypeAOrB(bool isTypeA, IesAngles angles, std::vector<HalfPlane> planes) {
        if (angles.horizontal.front() >= 0) mirrorHorizontally(angles, planes);
        if (angles.vertical.front() >= 0) mirrorVertically(angles, planes);
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
            isTypeA ? glm::dmat3({0, 0, -1}, {0, -1, 0}, {1, 0, 0}) : glm::dmat3({0, 0, -1}, {-1, 0, 0}, {0, 1, 0});
        setSphere(out_, fromPole, std::move(half), false);
    }

    static void mirrorHorizontally(IesAngles& angles, std::vector<HalfPlane>& planes) {
        const size_t count = planes.size();
        for (size_t k = angles.horizontal.front() > 0 ? 0 : 1; k < count; ++k) {
            angles.horizontal.push_back(-angles.horizontal[k]);
            planes.push_back({-planes[k].azimuth, planes[k].candela});
        }
        std::sort(angles.horizontal.begin(), angles.horizontal.end());
        std::sort(planes.begin(), planes.end(),
                  [](const HalfPlane& a, const HalfPlane& b) { return a.azimuth < b.azimuth; });
    }

    static void mirrorVertically(IesAngles& angles, std::vector<HalfPlane>& planes) {
        const std::vector<double> above = angles.vertical;
        const auto first = above.rbegin(), last = above.rend() - (above.front() > 0 ? 0 : 1);
        angles.vertical.clear();
        std::transform(first, last, std::back_inserter(angles.vertical), [](double angle) { return -angle; });
        angles.vertical.insert(angles.vertical.end(), above.begin(), above.end());
        for (HalfPlane& plane : planes) {
            std::vector<double> below(plane.candela.rbegin(), plane.candela.rbegin() + (last - first));
            plane.candela.insert(plane.candela.begin(), below.begin(), below.end());
        }
    }

    const FileCheck& mayRead_;
    std::vector<std::string_view> lines_;
    IesEdition edition_ = IesEdition::of1986;
    bool namesEdition_ = false, hasName_ = false;
    Goniogram out_;
};

/// Numbers as "0,5" of a file without points: commas separate numbers in LM-63, so it has too many of them.
std::string withDecimalPoints(std::string text) {
    const auto digitAt = [&](size_t k) { return k < text.size() && text[k] >= '0' && text[k] <= '9'; };
    const size_t tilt = std::min(text.rfind("TILT"), text.size());
    if (text.find('.', tilt) != std::string::npos) return text;
    for (size_t k = tilt + 1; k + 1 < text.size(); ++k)
        if (text[k] == ',' && digitAt(k - 1) && digitAt(k + 1)) text[k] = '.';
    return text;
}

} // namespace

Goniogram readIes(const std::string& path, const std::string& content, const FileCheck& mayRead) {
    try {
        return IesReader(path, content, mayRead).read();
    } catch (const InputError&) {
        const std::string withPoints = withDecimalPoints(content);
        if (withPoints == content) throw;
        std::optional<Goniogram> goniogram;
        try {
            goniogram = IesReader(path, withPoints, mayRead).read();
        } catch (const InputError&) { // what is wrong is something else
        }
        if (!goniogram) throw;
        goniogram->warnings.push_back(path + ": commas within numbers are taken for decimal points.");
        return *goniogram;
    }
}

} // namespace quasilux
