// Luminaire files: IES LM-63 of every edition, type and symmetry, EULUMDAT of every symmetry. What breaks a rule:
// goniogram_makers_test, what is refused: goniogram_errors_test.
#include "support/luminaire_files.h"
#include "support/scene_files.h"

#include <cmath>
#include <gtest/gtest.h>
#include <numbers>

namespace quasilux {
namespace {

using std::numbers::pi;
using test::IesText;
using test::LdtText;
using test::luminaireOf;
constexpr double degree = pi / 180;

Goniogram read(const std::string& path, size_t lampSet = 1) { return readGoniogram(path, {}, lampSet); }

/// By the midpoint rule over all directions.
double integral(const Goniogram& goniogram) {
    constexpr int rows = 900, columns = 720;
    double sum = 0;
    for (int i = 0; i < rows; ++i) {
        const double gamma = 180 * (i + 0.5) / rows;
        for (int k = 0; k < columns; ++k)
            sum += goniogram.intensity(directionAt(360 * (k + 0.5) / columns, gamma)) * std::sin(gamma * degree);
    }
    return sum * (pi / rows) * (2 * pi / columns);
}

TEST(Goniogram, FilesOfAClosedFormHaveItsIntensitiesAndLumens) {
    const auto cosine = [](double gamma) { return std::max(std::cos(gamma * degree), 0.0); };
    const struct {
        std::string name;
        double lumens;
        double bend, step; ///< integral of the second derivative over that of the intensity; degrees between angles
        std::function<double(double c, double gamma)> candela;
    } cases[] = {{"isotropic100", 400 * pi, 0, 5, [](double, double) { return 100.0; }},
                 {"lambert1000", 1000 * pi, -1, 2.5, [&](double, double gamma) { return 1000 * cosine(gamma); }},
                 {"spot_cos40", 10000 * pi / 41, 40, 1,
                  [&](double, double gamma) { return 5000 * std::pow(cosine(gamma), 40); }},
                 {"asym_cosphi", 1000 * pi, -1, 2.5,
                  [&](double c, double gamma) { return 500 * (2 + std::cos(c * degree)) * cosine(gamma); }},
                 {"quadrant", 1500 * pi, -1, 2.5, [&](double c, double gamma) {
                      const double folded = c > 180 ? 360 - c : c;
                      return 2000 * (1 - std::min(folded, 180 - folded) / 180) * cosine(gamma);
                  }}};
    for (const auto& expected : cases) {
        const Goniogram goniogram = read(test::luminaireFolder + expected.name + ".ies");
        EXPECT_EQ(goniogram.format, "IES LM-63-2002");
        EXPECT_TRUE(goniogram.absolute);
        EXPECT_NEAR(goniogram.lumens() / integral(goniogram), 1, 1e-4) << expected.name;
        // What chords add to a curve: h^2 / 12 of the integral of its second derivative over the sphere. Of cos^n it is
        // n times that of the curve, and -1 times for n = 1, which ends with a slope.
        const double chords = 1 + expected.bend * std::pow(expected.step * degree, 2) / 12;
        EXPECT_NEAR(goniogram.lumens() / (chords * expected.lumens), 1, 1e-5) << expected.name;
        for (const double c : {0.0, 45.0, 90.0, 135.0, 180.0, 270.0, 315.0})
            for (const double gamma : {5.0, 30.0, 60.0, 85.0, 100.0}) {
                if (expected.name == "quadrant" && std::fmod(c, 90) != 0) continue;
                EXPECT_NEAR(goniogram.intensity(directionAt(c, gamma)), expected.candela(c, gamma), 2e-3)
                    << expected.name << ", C " << c << ", gamma " << gamma;
            }
        // Between 90 degrees and a listed plane: linear in C.
        if (expected.name == "quadrant") {
            EXPECT_NEAR(goniogram.intensity(directionAt(225, 60)), expected.candela(225, 60), 1e-3);
            EXPECT_NEAR(goniogram.intensity(directionAt(225, 60)), 750, 1e-3);
        }
    }
}

TEST(Goniogram, IsLinearInBothAnglesBetweenTheValuesOfTheFile) {
    IesText ies;
    ies.horizontal = {0, 90, 180, 270, 360};
    ies.candela = [](double v, double h) { return 10 + v + std::fmod(h, 360); };
    const Goniogram goniogram = luminaireOf(ies);
    EXPECT_NEAR(goniogram.intensity(directionAt(120, 20)), 10 + 20 + 120, 1e-9);
    EXPECT_NEAR(goniogram.intensity(directionAt(315, 70)), 10 + 70 + 135, 1e-9) << "between 270 and 0";
    EXPECT_NEAR(goniogram.intensity(directionAt(100, 90 - 1e-9)), 10 + 90 + 100, 1e-6);
    EXPECT_EQ(goniogram.intensity(directionAt(100, 90 + 1e-9)), 0) << "nothing beyond the last angle";
    EXPECT_NEAR(goniogram.lumens() / integral(goniogram), 1, 1e-5);
}

TEST(Goniogram, CRunsAsLm63HasIt) {
    // Seen from above, C0 to the right: counter-clockwise. Seen along the light (+z away from the eye, +x to the right)
    // +y is down.
    EXPECT_LT(glm::length(directionAt(0, 90) - glm::dvec3(1, 0, 0)), 1e-15);
    EXPECT_LT(glm::length(directionAt(90, 90) - glm::dvec3(0, -1, 0)), 1e-15);
    EXPECT_LT(glm::length(directionAt(33, 0) - glm::dvec3(0, 0, 1)), 1e-15);
}

TEST(Goniogram, EverySymmetryOfTypeCIsTheWholeSphere) {
    const struct {
        std::vector<double> horizontal;
        std::function<double(double)> folded; ///< the azimuth of the file that a direction has the value of
    } cases[] = {{{0}, [](double) { return 0.0; }},
                 {{0, 45, 90}, [](double c) { return std::min(std::fmod(c, 180), 180 - std::fmod(c, 180)); }},
                 {{0, 45, 90, 135, 180}, [](double c) { return std::min(c, 360 - c); }},
                 {{90, 135, 180, 225, 270}, [](double c) { return c < 90    ? 180 - c
                                                                  : c > 270 ? 540 - c
                                                                            : c; }},
                 {{0, 45, 90, 135, 180, 225, 270, 315, 360}, [](double c) { return c; }}};
    for (const auto& expected : cases) {
        IesText ies;
        ies.vertical = {0, 30, 60, 90, 120, 180};
        ies.horizontal = expected.horizontal;
        ies.candela = [](double v, double h) { return 1 + v + 2 * std::fmod(h, 360); };
        const Goniogram goniogram = luminaireOf(ies);
        for (double c = 0; c < 360; c += 45)
            EXPECT_NEAR(goniogram.intensity(directionAt(c, 60)), 61 + 2 * expected.folded(c), 1e-9)
                << fmt::format("{}", fmt::join(expected.horizontal, " ")) << ": " << c;
        EXPECT_NEAR(goniogram.lumens() / integral(goniogram), 1, 1e-5);
    }
    IesText upwards;
    upwards.vertical = {90, 135, 180};
    const Goniogram goniogram = luminaireOf(upwards);
    EXPECT_NEAR(goniogram.lumens(), 200 * pi, 1e-9);
    EXPECT_EQ(goniogram.intensity(directionAt(10, 80)), 0);
    EXPECT_EQ(goniogram.intensity(directionAt(10, 100)), 100);
}

// As LM-63 has them: horizontal 0 and vertical 90 of type B is C0 and gamma 90 of type C, and horizontal angles run
// clockwise seen from above, against C. So `up` is along +x and `right` along +y.
TEST(Goniogram, TypesAAndBTurnAboutAVerticalAndAHorizontalPole) {
    for (const bool isTypeA : {true, false})
        for (const bool isSymmetric : {true, false}) {
            IesText ies;
            ies.type = isTypeA ? 3 : 2;
            ies.vertical = {-90, -45, 0, 10, 90};
            ies.horizontal = isSymmetric ? std::vector<double>{0, 30, 90} : std::vector<double>{-90, 0, 30, 90};
            ies.candela = [](double v, double h) { return v == 10 && h == 30 ? 500 : v == -45 && h == 30 ? 100 : 1; };
            const Goniogram goniogram = luminaireOf(ies);
            const auto along = [&](double h, double v) {
                const double right = isTypeA ? std::cos(v * degree) * std::sin(h * degree) : std::sin(h * degree);
                const double up = isTypeA ? std::sin(v * degree) : std::cos(h * degree) * std::sin(v * degree);
                return goniogram.intensity({up, right, std::cos(h * degree) * std::cos(v * degree)});
            };
            EXPECT_NEAR(along(30, 10), 500, 1e-6) << isTypeA << isSymmetric;
            EXPECT_NEAR(along(30, -45), 100, 1e-6) << isTypeA << isSymmetric;
            EXPECT_NEAR(along(-30, 10), isSymmetric ? 500 : 1, 1e-6);
            EXPECT_NEAR(along(15, 10), 250.5, 1e-6) << "linear in H";
            EXPECT_NEAR(along(30, 50), 250.5, 1e-6) << "linear in V";
            EXPECT_EQ(goniogram.intensity({0, 0, -1}), 0) << "backwards it is dark";
            EXPECT_NEAR(goniogram.lumens() / integral(goniogram), 1, 2e-3);
        }
}

TEST(Goniogram, FactorsAreThoseOfTheEdition) {
    for (const auto& [header, format, factor] : {std::tuple{"any first line", "IES LM-63-1986", 3 * 0.9 * 0.8},
                                                 {"IESNA91", "IES LM-63-1991", 3 * 0.9 * 0.8},
                                                 {"IESNA:LM-63-1995", "IES LM-63-1995", 3 * 0.9 * 0.8},
                                                 {"IESNA:LM-63-2002", "IES LM-63-2002", 3 * 0.9},
                                                 {"IES:LM-63-2019", "IES LM-63-2019", 3 * 0.9}}) {
        IesText ies;
        ies.header = header;
        ies.lamps = "2 1500 3";
        ies.factors = "0.9 0.8 36";
        const Goniogram goniogram = luminaireOf(ies);
        EXPECT_EQ(goniogram.format, format);
        EXPECT_NEAR(goniogram.largest(), 100 * factor, 1e-9) << header;
        EXPECT_FALSE(goniogram.absolute);
        EXPECT_EQ(goniogram.lampSets.at(0).lumens, 3000);
        EXPECT_EQ(goniogram.lampSets[0].watts, 36);
        EXPECT_EQ(goniogram.luminaire, "of a test");
        EXPECT_EQ(goniogram.warnings.size(),
                  goniogram.format == "IES LM-63-2002" || goniogram.format == "IES LM-63-1986" ? 1u : 0u);
    }
}

TEST(Goniogram, NamesAreUtf8WhateverTheFileHas) {
    for (const char* name : {"L\xfc"
                             "ster",
                             "L\xc3\xbc"
                             "ster",
                             "L\xfc"
                             "s\x01ter"}) {
        const std::string text = IesText{}.text();
        EXPECT_EQ(luminaireOf(std::string(text).replace(text.find("of a test"), 9, name)).luminaire, "L\xc3\xbc"
                                                                                                     "ster");
    }
}

TEST(Goniogram, NumbersMayStandOnAnyLines) {
    std::string text = IesText{}.text();
    const size_t first = text.find("1 -1 1");
    for (size_t k = first; k < text.size(); ++k)
        if (text[k] == ' ' || text[k] == '\n') text[k] = k % 3 == 0 ? ',' : k % 3 == 1 ? '\n' : '\t';
    EXPECT_EQ(luminaireOf(text + "\r\n\x1a").largest(), 100);
    std::string carriageReturns = IesText{}.text();
    std::replace(carriageReturns.begin(), carriageReturns.end(), '\n', '\r');
    EXPECT_EQ(luminaireOf(carriageReturns).largest(), 100);
}

TEST(Goniogram, TiltMultipliesByAngle) {
    IesText ies;
    ies.tilt = "INCLUDE\n1\n3\n0 30 90\n1 0.9 0.6\n";
    const Goniogram included = luminaireOf(ies);
    EXPECT_EQ(included.tiltFactor(0, {}), 1);
    EXPECT_NEAR(included.tiltFactor(60, {}), 0.75, 1e-12);
    EXPECT_THROW(included.tiltFactor(91, {}), InputError);
    test::SceneFiles files;
    files.write("lamp.tlt", "1\n3\n0 30 90\n1 0.9 0.6\n");
    ies.tilt = "lamp.tlt\n";
    EXPECT_NEAR(read(files.write("lamp.IES", ies.text())).tiltFactor(60, {}), 0.75, 1e-12);
    EXPECT_EQ(luminaireOf(IesText{}).tiltFactor(12, {}), 1);
}

/// Of a file with this first line and these sizes in metres.
LuminousShape shapeOf(const std::string& header, double width, double length, double height) {
    IesText ies;
    ies.header = header;
    ies.size = fmt::format("{} {} {}", width, length, height);
    return luminaireOf(ies).shape;
}

TEST(Goniogram, ShapesAreThoseOfTheStandard) {
    using Kind = LuminousShape::Kind;
    const struct {
        double width, length, height;
        Kind kind;
        double alongX, alongY, alongZ; ///< area seen along C0, C90 and the axis, by hand
    } cases[] = {{0, 0, 0, Kind::point, 0, 0, 0},           {2, 3, 0, Kind::box, 0, 0, 6},
                 {2, 3, 0.5, Kind::box, 1, 1.5, 6},         {-2, 0, 0, Kind::uprightRod, 0, 0, pi},
                 {-2, -2, 0, Kind::uprightRod, 0, 0, pi},   {-2, -4, 0, Kind::uprightRod, 0, 0, 2 * pi},
                 {-2, 0, 3, Kind::uprightRod, 6, 6, pi},    {-2, -4, 3, Kind::uprightRod, 6, 12, 2 * pi},
                 {-2, -2, -2, Kind::ellipsoid, pi, pi, pi}, {-2, -4, -6, Kind::ellipsoid, 3 * pi, 6 * pi, 2 * pi},
                 {-2, 5, -2, Kind::rodAlongC0, pi, 10, 10}, {5, -2, -2, Kind::rodAlongC90, 10, pi, 10},
                 {-2, 0, -2, Kind::rodAlongC0, pi, 0, 0},   {-2, 0, -4, Kind::rodAlongC0, 2 * pi, 0, 0}};
    for (const auto& expected : cases) {
        SCOPED_TRACE(fmt::format("{} {} {}", expected.width, expected.length, expected.height));
        const LuminousShape shape = shapeOf("IESNA:LM-63-2002", expected.width, expected.length, expected.height);
        EXPECT_EQ(shape.kind, expected.kind);
        EXPECT_NEAR(shape.projectedArea({1, 0, 0}), expected.alongX, 1e-12);
        EXPECT_NEAR(shape.projectedArea({0, 1, 0}), expected.alongY, 1e-12);
        EXPECT_NEAR(shape.projectedArea({0, 0, 1}), expected.alongZ, 1e-12);
        EXPECT_FALSE(shape.text().empty());
    }
    // A sphere and a cube from aslant.
    const glm::dvec3 aslant = glm::normalize(glm::dvec3(1, 1, 1));
    EXPECT_NEAR(shapeOf("IESNA:LM-63-2002", -2, -2, -2).projectedArea(aslant), pi, 1e-12);
    EXPECT_NEAR(shapeOf("IESNA:LM-63-2002", 1, 1, 1).projectedArea(aslant), std::sqrt(3.0), 1e-12);
    IesText ies;
    ies.units = 1;
    ies.size = "2 4 0";
    EXPECT_NEAR(luminaireOf(ies).shape.sizeC0, 4 * 0.3048, 1e-12) << "feet";
}

// The table of LM-63-1995 as I. Ashdown, "Parsing the IESNA LM-63 photometric data file" (1998), has it.
TEST(Goniogram, ShapesUntil1995AreThoseOfTheTableOfThen) {
    using Kind = LuminousShape::Kind;
    const struct {
        double width, length, height;
        Kind kind;
        double alongX, alongY, alongZ; ///< area seen along C0, C90 and the axis, by hand
    } cases[] = {{0, 0, 0, Kind::point, 0, 0, 0},
                 {2, 3, 0.5, Kind::box, 1, 1.5, 6},
                 {-2, 0, 0, Kind::uprightRod, 0, 0, pi},
                 {-2, 0, 3, Kind::uprightRod, 6, 6, pi},
                 {-2, 0, -2, Kind::ellipsoid, pi, pi, pi},
                 {0, 5, -2, Kind::rodAlongC0, pi, 10, 10},
                 {5, 0, -2, Kind::rodAlongC90, 10, pi, 10},
                 {-2, 4, 0, Kind::uprightRod, 0, 0, 2 * pi},
                 {-2, 4, 3, Kind::uprightRod, 6, 12, 2 * pi},
                 {2, -4, 3, Kind::uprightRod, 6, 12, 2 * pi},
                 {-2, 4, -6, Kind::ellipsoid, 3 * pi, 6 * pi, 2 * pi},
                 {2, -4, -6, Kind::ellipsoid, 3 * pi, 6 * pi, 2 * pi}};
    for (const char* header : {"a lamp", "IESNA91", "IESNA:LM-63-1995"})
        for (const auto& expected : cases) {
            SCOPED_TRACE(fmt::format("{}: {} {} {}", header, expected.width, expected.length, expected.height));
            const LuminousShape shape = shapeOf(header, expected.width, expected.length, expected.height);
            EXPECT_EQ(shape.kind, expected.kind);
            EXPECT_NEAR(shape.projectedArea({1, 0, 0}), expected.alongX, 1e-12);
            EXPECT_NEAR(shape.projectedArea({0, 1, 0}), expected.alongY, 1e-12);
            EXPECT_NEAR(shape.projectedArea({0, 0, 1}), expected.alongZ, 1e-12);
        }
}

TEST(Goniogram, AFlatShapeSeenEdgeOnCoversNothing) {
    for (const LuminousShape& shape : {shapeOf("IESNA:LM-63-2002", 2, 3, 0), shapeOf("IESNA:LM-63-2002", -2, -2, 0)}) {
        EXPECT_EQ(shape.projectedArea(directionAt(30, 90)), 0) << "the cosine of 90 degrees is 6e-17";
        EXPECT_GT(shape.projectedArea(directionAt(30, 89.99)), 0);
    }
    EXPECT_EQ(shapeOf("IESNA:LM-63-2002", -2, 0, -2).projectedArea(directionAt(90, 60)), 0) << "a disc that faces C0";
}

// A byte order mark, or another case, makes no other edition of a file: the third factor is none since 2002.
TEST(Goniogram, FirstLinesAreReadWithoutMarkAndCase) {
    IesText ies;
    ies.factors = "1 1.5 50";
    const std::string mark = "\xef\xbb\xbf";
    for (const char* header : {"IES:LM-63-2019", "ies:lm-63-2019"})
        for (const std::string& before : {std::string(), mark}) {
            ies.header = before + header;
            const Goniogram read = luminaireOf(ies);
            EXPECT_EQ(read.format, "IES LM-63-2019");
            EXPECT_NEAR(read.largest(), 100, 1e-9);
        }
    ies.header = "a lamp";
    const Goniogram old = luminaireOf(ies);
    EXPECT_NEAR(old.largest(), 150, 1e-9);
    ASSERT_EQ(old.warnings.size(), 1u);
    EXPECT_NE(old.warnings[0].find("names no edition"), std::string::npos) << old.warnings[0];
    EXPECT_EQ(luminaireOf(mark + LdtText{}.text(), "lamp.ldt").largest(), 100);
}

TEST(Goniogram, EverydayFilesAreRead) {
    IesText ies;
    ies.lamps = "1.0 -1 1";
    for (const char* tilt : {"none\n", " NONE\n", "include\n1.\n2.0\n0 90\n1 0.5\n"}) {
        ies.tilt = tilt;
        EXPECT_EQ(luminaireOf(ies).largest(), 100) << tilt;
    }
    EXPECT_EQ(luminaireOf(ies).tilt.factors.size(), 2u);
    std::string spaced = IesText{}.text();
    EXPECT_EQ(luminaireOf(spaced.replace(spaced.find("TILT="), 5, "Tilt = ")).largest(), 100);
    std::string blankTilt = LdtText{}.text();
    blankTilt.replace(blankTilt.find("\n80\n1\n0\n") + 6, 1, "");
    EXPECT_EQ(luminaireOf(blankTilt, "lamp.ldt").largest(), 100);
}

TEST(Goniogram, ACircleWithoutItsEndIsClosed) {
    IesText ies;
    ies.horizontal.clear();
    for (int h = 0; h < 360; h += 15) ies.horizontal.push_back(h);
    ies.candela = [](double, double h) { return 100 + h; };
    const Goniogram read = luminaireOf(ies);
    EXPECT_NEAR(read.intensity(directionAt(345, 45)), 445, 1e-9);
    EXPECT_NEAR(read.intensity(directionAt(352.5, 45)), (445 + 100) / 2.0, 1e-9);
    ASSERT_EQ(read.warnings.size(), 1u);
    EXPECT_NE(read.warnings[0].find("end at 345, without 360"), std::string::npos) << read.warnings[0];
}

TEST(Goniogram, EverySymmetryOfEulumdatIsTheWholeSphere) {
    const struct {
        unsigned symmetry;
        std::vector<double> listed;
        std::function<double(double)> folded;
    } cases[] = {{0, {0, 45, 90, 135, 180, 225, 270, 315}, [](double c) { return c; }},
                 {1, {0}, [](double) { return 0.0; }},
                 {2, {0, 45, 90, 135, 180}, [](double c) { return std::min(c, 360 - c); }},
                 {3,
                  {270, 315, 0, 45, 90},
                  [](double c) { return c > 90 && c <= 180   ? 180 - c
                                        : c > 180 && c < 270 ? 540 - c
                                                             : c; }},
                 {4, {0, 45, 90}, [](double c) { return std::min(std::fmod(c, 180), 180 - std::fmod(c, 180)); }}};
    for (const auto& expected : cases) {
        LdtText ldt;
        ldt.symmetry = expected.symmetry;
        ldt.planes = 8;
        ldt.listed = expected.listed;
        ldt.intensity = [](double c, double gamma) { return 1 + c + gamma; };
        const Goniogram goniogram = luminaireOf(ldt);
        for (double c = 0; c < 360; c += 45)
            EXPECT_NEAR(goniogram.intensity(directionAt(c, 45)), 46 + expected.folded(c), 1e-9)
                << expected.symmetry << ": " << c;
        EXPECT_NEAR(goniogram.lumens() / integral(goniogram), 1, 1e-5);
        EXPECT_EQ(goniogram.format, "EULUMDAT");
        EXPECT_EQ(goniogram.directRatios[9], 1);
    }
}

TEST(Goniogram, EulumdatScalesByFactorAndSetOfLamps) {
    LdtText ldt;
    ldt.factor = "1,5";
    ldt.lampSets = "2\n1\nfirst\n1000\nwhite\n1A\n20\n-2\nsecond\n3000\nwhite\n1A\n40\n";
    EXPECT_NEAR(luminaireOf(ldt).largest(), 150, 1e-9);
    EXPECT_FALSE(luminaireOf(ldt).absolute);
    const Goniogram second = luminaireOf(ldt, 2);
    EXPECT_NEAR(second.largest(), 450, 1e-9);
    EXPECT_TRUE(second.absolute) << "a negative number of lamps";
    EXPECT_EQ(second.lampSets.at(second.lampSet).watts, 40);
    ldt.area = "1200\n300\n10\n20\n30\n40\n";
    EXPECT_NEAR(luminaireOf(ldt).shape.sizeC90, 1.2, 1e-12);
    EXPECT_NEAR(luminaireOf(ldt).shape.sizeC0, 0.3, 1e-12);
    EXPECT_NEAR(luminaireOf(ldt).shape.height, 0.025, 1e-12);
    ldt.area = "400\n0\n0\n0\n0\n0\n";
    EXPECT_NEAR(luminaireOf(ldt).shape.projectedArea({0, 0, 1}), 0.04 * pi, 1e-12) << "a disc";
}

} // namespace
} // namespace quasilux
