// Luminaire files that break a rule of their format as makers' files do, and are read all the same, with a warning;
// and a floodlight as programs convert it.
#include "support/luminaire_files.h"

#include <cmath>
#include <gmock/gmock.h>

namespace quasilux {
namespace {

using test::IesText;
using test::LdtText;
using test::luminaireOf;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

constexpr double pi = 3.14159265358979323846, degree = pi / 180;

std::string replaced(std::string text, const std::string& from, const std::string& to) {
    const size_t at = text.find(from);
    if (at == std::string::npos) ADD_FAILURE() << from << " is not in\n" << text;
    return text.replace(at, from.size(), to);
}

// The third factor counts until 1995, so that the edition shows in the intensities.
TEST(GoniogramOfMakers, FirstLinesOfOtherSpellingsNameTheirEdition) {
    const std::tuple<const char*, const char*, double> cases[] = {{"IESNA86", "IES LM-63-1986", 150},
                                                                  {"IESNA:LM-63-1991", "IES LM-63-1991", 150},
                                                                  {"IESNA95", "IES LM-63-1995", 150},
                                                                  {"IESNA:LM-63-95", "IES LM-63-1995", 150},
                                                                  {"IESNA:LM-63-2002 (a)", "IES LM-63-2002", 100},
                                                                  {"IESNA:LM-63-02", "IES LM-63-2002", 100},
                                                                  {"IESNA:LM-63-2019", "IES LM-63-2019", 100},
                                                                  {"IES:LM-63-2002", "IES LM-63-2002", 100},
                                                                  {"IES LM-63-2019", "IES LM-63-2019", 100}};
    for (const auto& [header, format, largest] : cases) {
        IesText ies;
        ies.header = header;
        ies.factors = "1 1.5 50";
        const Goniogram read = luminaireOf(ies);
        EXPECT_EQ(read.format, format) << header;
        EXPECT_NEAR(read.largest(), largest, 1e-9) << header;
        ASSERT_FALSE(read.warnings.empty());
        EXPECT_THAT(read.warnings[0], HasSubstr(std::string(":1: '") + header + "' is taken for " + format));
    }
}

TEST(GoniogramOfMakers, BlanksMakeNoOtherFirstLine) {
    IesText ies;
    ies.factors = "1 1.5 50";
    for (const char* header : {"IES: LM-63-2019", " IES:LM-63-2019 \t", "\n \nIES:LM-63-2019"}) {
        ies.header = header;
        const Goniogram read = luminaireOf(ies);
        EXPECT_EQ(read.format, "IES LM-63-2019") << header;
        EXPECT_NEAR(read.largest(), 100, 1e-9);
        EXPECT_THAT(read.warnings, IsEmpty());
    }
}

TEST(GoniogramOfMakers, ATiltDuringMeasurementIsWarnedOf) {
    test::LdtText ldt;
    EXPECT_THAT(luminaireOf(ldt).warnings, IsEmpty());
    ldt.tilt = "15";
    EXPECT_THAT(luminaireOf(ldt).warnings, ElementsAre(HasSubstr("was tilted by 15 degrees while it was measured")));
}

// As ERCO's files end with END.
TEST(GoniogramOfMakers, TextAfterTheLastValueIsLeftOut) {
    const Goniogram ies = luminaireOf(IesText{}.text() + "END\n1 2 3\n");
    EXPECT_EQ(ies.largest(), 100);
    EXPECT_THAT(ies.warnings, ElementsAre(HasSubstr("lamp.ies:9: 'END' and what follows is left out")));
    const Goniogram ldt = luminaireOf(LdtText{}.text() + "\nwritten by a program\n", "lamp.ldt");
    EXPECT_EQ(ldt.largest(), 100);
    EXPECT_THAT(ldt.warnings, ElementsAre(HasSubstr("lamp.ldt:54: text follows the last intensity")));
}

TEST(GoniogramOfMakers, LumensThatAreNotAboveZeroMeanAbsolutePhotometry) {
    for (const char* lumens : {"0", "-2"}) {
        IesText ies;
        ies.lamps = std::string("1 ") + lumens + " 1";
        const Goniogram read = luminaireOf(ies);
        EXPECT_TRUE(read.absolute);
        EXPECT_EQ(read.largest(), 100);
        EXPECT_THAT(read.warnings, ElementsAre(HasSubstr(std::string(":4: lumens per lamp: ") + lumens)));
    }
}

TEST(GoniogramOfMakers, TheNumberForFutureUseMayBeZero) {
    IesText ies;
    ies.header = "IESNA:LM-63-2002";
    ies.factors = "1 0 50";
    EXPECT_EQ(luminaireOf(ies).largest(), 100);
    EXPECT_THAT(luminaireOf(ies).warnings, ElementsAre(HasSubstr("number for future use is 0")));
}

TEST(GoniogramOfMakers, DecimalCommasAreRead) {
    IesText ies;
    ies.lamps = "1 -1 1,5";
    ies.factors = "0,8 1 50";
    ies.vertical = {0, 90};
    const std::string text = replaced(ies.text(), "100 100", "99,5 0,25");
    const Goniogram read = luminaireOf(text);
    EXPECT_NEAR(read.largest(), 99.5 * 1.5 * 0.8, 1e-9);
    EXPECT_NEAR(read.intensity(directionAt(0, 45)), (99.5 + 0.25) / 2 * 1.5 * 0.8, 1e-9);
    EXPECT_THAT(read.warnings, ElementsAre(HasSubstr("commas within numbers are taken for decimal points")));
    // What is wrong besides is said as it is without commas.
    try {
        luminaireOf(replaced(text, "99,5", "x"));
        ADD_FAILURE() << "read";
    } catch (const InputError& error) {
        EXPECT_THAT(error.what(), HasSubstr("lamp.ies:"));
    }
}

TEST(GoniogramOfMakers, BeyondVerticalAnglesItIsDark) {
    IesText ies;
    ies.vertical = {0, 60, 120};
    const Goniogram read = luminaireOf(ies);
    EXPECT_EQ(read.intensity(directionAt(0, 119.9)), 100);
    EXPECT_EQ(read.intensity(directionAt(0, 120.1)), 0);
    EXPECT_NEAR(read.lumens(), 100 * 2 * pi * 1.5, 1e-6);
    EXPECT_THAT(read.warnings, ElementsAre(HasSubstr(":6: vertical angles from 0 to 120; expected")));
}

TEST(GoniogramOfMakers, FourHalfPlanesAreACircleWithoutItsEnd) {
    IesText ies;
    ies.horizontal = {0, 90, 180, 270};
    ies.candela = [](double, double h) { return 100 + h; };
    const Goniogram read = luminaireOf(ies);
    EXPECT_NEAR(read.intensity(directionAt(270, 45)), 370, 1e-9);
    EXPECT_NEAR(read.intensity(directionAt(315, 45)), (370 + 100) / 2.0, 1e-9);
    EXPECT_THAT(read.warnings, ElementsAre(HasSubstr("end at 270, without 360")));
}

/// Of types A and B: cos h cos v, whichever of the angles are listed.
Goniogram floodlight(int type, std::vector<double> vertical, std::vector<double> horizontal) {
    IesText ies;
    ies.type = type;
    ies.vertical = std::move(vertical);
    ies.horizontal = std::move(horizontal);
    ies.candela = [](double v, double h) { return 1000 * std::cos(h * degree) * std::cos(v * degree); };
    return luminaireOf(ies);
}

TEST(GoniogramOfMakers, AFloodlightThatBeginsBeyondZeroIsMirroredToo) {
    const std::vector<double> all{-90, -60, -30, 0, 30, 60, 90};
    for (const int type : {2, 3}) {
        const Goniogram whole = floodlight(type, all, {0, 1, 2, 30, 60, 90}),
                        cut = floodlight(type, all, {1, 2, 30, 60, 90});
        EXPECT_THAT(whole.warnings, IsEmpty());
        EXPECT_NEAR(cut.lumens() / whole.lumens(), 1, 1e-3) << type;
        EXPECT_THAT(cut.warnings, ElementsAre(HasSubstr(":7: horizontal angles begin at 1; expected 0 or -90")));
    }
}

// Since 2002 the angles of a file must cover all that a luminaire lights.
TEST(GoniogramOfMakers, VerticalAnglesOfAFloodlightFromZeroAreMirrored) {
    const std::vector<double> half{0, 30, 60, 90}, all{-90, -60, -30, 0, 30, 60, 90};
    for (const int type : {2, 3}) {
        const Goniogram whole = floodlight(type, all, half), quarter = floodlight(type, half, half);
        EXPECT_NEAR(quarter.lumens() / whole.lumens(), 1, 1e-12) << type;
        for (const double y : {-0.5, -0.1, 0.1, 0.5})
            for (const double x : {-0.4, 0.2}) {
                const glm::dvec3 d = glm::normalize(glm::dvec3(x, y, 1));
                EXPECT_NEAR(quarter.intensity(d), whole.intensity(d), 1e-9) << type << ": " << x << " " << y;
            }
        EXPECT_THAT(quarter.warnings, ElementsAre(HasSubstr(":6: vertical angles begin at 0")));
    }
}

// The same light as a file of type B and of type C, as programs convert them: tan V = cos C tan gamma, sin H = -sin C
// sin gamma.
TEST(GoniogramOfMakers, AFloodlightIsTheSameInTypesBAndC) {
    const auto light = [](double v, double h) {
        return 1000 * std::exp(-v * v / 200 - h * h / 1800) * std::exp(v / 60);
    };
    IesText b, c;
    b.type = 2;
    b.vertical.clear();
    b.horizontal.clear();
    for (int angle = -90; angle <= 90; ++angle) {
        b.vertical.push_back(angle);
        b.horizontal.push_back(angle);
    }
    b.candela = light;
    c.vertical.clear();
    c.horizontal.clear();
    for (int angle = 0; angle <= 90; ++angle) c.vertical.push_back(angle);
    for (int angle = 0; angle <= 360; ++angle) c.horizontal.push_back(angle);
    c.candela = [&](double gamma, double turn) {
        const double across = std::sin(gamma * degree);
        return light(std::atan2(across * std::cos(turn * degree), std::cos(gamma * degree)) / degree,
                     std::asin(-across * std::sin(turn * degree)) / degree);
    };
    const Goniogram ofB = luminaireOf(b), ofC = luminaireOf(c);
    for (const double gamma : {5.0, 20.0, 40.0})
        for (double turn = 10; turn < 360; turn += 20) {
            const double expected = ofC.intensity(directionAt(turn, gamma));
            EXPECT_NEAR(ofB.intensity(directionAt(turn, gamma)), expected, 0.01 * expected + 1) << turn << " " << gamma;
        }
}

TEST(GoniogramOfMakers, WhatIsLeftOfADarkSignalMayBeNegative) {
    const std::string ies = replaced(IesText{}.text(), "100 100 100", "100 100 -0.05");
    EXPECT_EQ(luminaireOf(ies).intensity(directionAt(0, 90)), 0);
    EXPECT_THAT(luminaireOf(ies).warnings, ElementsAre(HasSubstr(":8: candela value: -0.05")));
    EXPECT_THROW(luminaireOf(replaced(ies, "-0.05", "-0.2")), InputError);
    LdtText ldt;
    ldt.intensity = [](double, double gamma) { return gamma > 80 ? -0.05 : 100; };
    EXPECT_EQ(luminaireOf(ldt).intensity(directionAt(0, 90)), 0);
    EXPECT_THAT(luminaireOf(ldt).warnings, ElementsAre(HasSubstr("luminous intensity: -0.05")));
}

TEST(GoniogramOfMakers, TheNameIsTheFirstOneOrTheCatalogueNumber) {
    const std::string text = IesText{}.text(), name = "[LUMINAIRE] of a test\n";
    EXPECT_EQ(luminaireOf(replaced(text, name, "[LUMCAT] C1\n" + name + "[LUMINAIRE] ballast 7\n")).luminaire,
              "of a test");
    EXPECT_EQ(luminaireOf(replaced(text, name, name + "[LUMCAT] C1\n")).luminaire, "of a test");
    EXPECT_EQ(luminaireOf(replaced(text, name, "[LUMINAIRE] \n[LUMCAT] C1\n")).luminaire, "C1");
}

TEST(GoniogramOfMakers, LinesOfEulumdatThatNothingDependsOnMayBeBlank) {
    LdtText ldt;
    ldt.area = "\n\n\n\n\n\n";
    ldt.lampSets = "1\n1\nlamp\n1000\nwhite\n1A\n\n";
    std::string text = replaced(ldt.text(), "company\n1\n1\n4\n90\n3\n45\n", "company\n\n1\n4\n\n3\n \n");
    text = replaced(text, "1200\n600\n50\n", "\n\n\n");
    text = replaced(text, "100\n80\n1\n0\n", "\n\n\n\n");
    text = replaced(text, "0.1\n0.2\n0.3\n", "\n\n\n");
    const Goniogram read = luminaireOf(text, "lamp.ldt");
    EXPECT_EQ(read.largest(), 100);
    EXPECT_THAT(read.warnings, ElementsAre(HasSubstr("lamp.ldt:24: the conversion factor")));
    EXPECT_EQ(read.shape.kind, LuminousShape::Kind::point);
    EXPECT_EQ(read.lampSets.at(0).watts, 0);
    EXPECT_EQ(read.directRatios[0], 0);
    EXPECT_EQ(read.directRatios[3], 0.4);
    EXPECT_THROW(luminaireOf(replaced(text, "\n1000\n", "\n\n"), "lamp.ldt"), InputError) << "lumens of the lamps";
}

TEST(GoniogramOfMakers, AllPlanesOfEulumdatAreTakenInSpiteOfTheSymmetry) {
    LdtText ldt;
    ldt.planes = 8;
    ldt.listed = {0, 45, 90, 135, 180, 225, 270, 315};
    ldt.intensity = [](double c, double) { return 1 + c; };
    for (const unsigned symmetry : {1u, 2u, 3u, 4u}) {
        ldt.symmetry = symmetry;
        const Goniogram read = luminaireOf(ldt);
        for (const double c : ldt.listed) EXPECT_NEAR(read.intensity(directionAt(c, 45)), 1 + c, 1e-9) << symmetry;
        EXPECT_THAT(read.warnings, ElementsAre(HasSubstr("lists those of all 8, which are taken")));
    }
    ldt.listed = {0, 45, 90, 135, 180, 225, 270}; // one is missing
    EXPECT_THROW(luminaireOf(ldt), InputError);
}

TEST(GoniogramOfMakers, PlanesOfEulumdatMayGoTo360) {
    LdtText ldt;
    ldt.symmetry = 0;
    ldt.listed = {0, 90, 180, 270, 360};
    ldt.intensity = [](double c, double) { return 1 + std::fmod(c, 360); };
    const std::string text = replaced(ldt.text(), "\n4\n90\n", "\n5\n90\n"), angles = "0\n90\n180\n270\n";
    const Goniogram read = luminaireOf(replaced(text, angles, angles + "360\n"), "lamp.ldt");
    EXPECT_NEAR(read.intensity(directionAt(315, 45)), (271 + 1) / 2.0, 1e-9);
}

} // namespace
} // namespace quasilux
