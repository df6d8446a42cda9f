// Luminaire files that are wrong, cut off or damaged: what is said of them.
#include "scene/goniograms/ies_file.h"
#include "support/luminaire_files.h"
#include "support/scene_files.h"

#include <cmath>
#include <gmock/gmock.h>
#include <random>

namespace quasilux {
namespace {

using test::IesText;
using test::LdtText;
using test::luminaireOf;
using testing::HasSubstr;

Goniogram read(const std::string& path, size_t lampSet = 1) { return readGoniogram(path, {}, lampSet); }

std::string errorOf(const std::string& name, const std::string& text, size_t lampSet = 1) {
    try {
        luminaireOf(text, name, lampSet);
    } catch (const InputError& error) {
        return error.what();
    }
    ADD_FAILURE() << "read without an error:\n" << text;
    return {};
}

std::string withNumbers(const std::function<void(IesText&)>& change) {
    IesText ies;
    change(ies);
    return ies.text();
}
std::string withLines(const std::function<void(LdtText&)>& change) {
    LdtText ldt;
    change(ldt);
    return ldt.text();
}
std::string replaced(std::string text, const std::string& from, const std::string& to) {
    return text.replace(text.find(from), from.size(), to);
}

TEST(GoniogramErrors, OfIesFilesSayLineAndWhatToDo) {
    const std::string plain = IesText{}.text();
    const std::pair<std::string, std::vector<std::string>> cases[] = {
        {"", {"lamp.ies", "no line TILT=NONE"}},
        {"IES:LM-63-2044\nTILT=NONE\n", {"lamp.ies:1: 'IES:LM-63-2044' is no known edition", "IES:LM-63-2019"}},
        {"IESNA:LM-63-2002\n[TEST] x\n", {"lamp.ies:2: the file has no line TILT=NONE"}},
        {"IESNA91\nTILT=\n", {"lamp.ies:2: TILT= says nothing", "INCLUDE"}},
        {"IESNA91\nTILT=nowhere.tlt\n", {"lamp.ies:2: cannot read the tilt file", "nowhere.tlt"}},
        {"IESNA91\nTILT=NONE\n", {"lamp.ies:2: the file ends where a number is expected: number of lamps", "cut off"}},
        {replaced(plain, "1 -1 1", "0 -1 1"), {"lamp.ies:4: number of lamps: '0'", "from 1"}},
        {replaced(plain, "1 -1 1", "1 -1 0"), {"lamp.ies:4: candela multiplier: 0", "above 0"}},
        {replaced(plain, "1 -1 1 3", "1 -1 1 4000000000"), {"lamp.ies:4: number of vertical angles", "2 to 3601"}},
        {replaced(plain, "1 -1 1 3 1", "1 -1 1 3 3600"),
         {"lamp.ies:5: 3 vertical and 3600 horizontal angles need 14403"}},
        {replaced(plain, "1 -1 1 3 1 1", "1 -1 1 3 1 4"), {"lamp.ies:4: photometric type", "1 to 3"}},
        {replaced(plain, "1 -1 1 3 1 1 2", "1 -1 1 3 1 1 3"), {"lamp.ies:4: units type"}},
        {replaced(plain, "0 45 90", "30 45 90"), {"lamp.ies:6: vertical angles from 30 to 90", "0 to 90"}},
        {replaced(plain, "0 45 90", "0 95 90"), {"lamp.ies:6: vertical angles", "90 follows 95"}},
        {replaced(plain, "0 45 90", "0 45 190"), {"lamp.ies:6: vertical angles", "from 0 to 180"}},
        {replaced(plain, "100 ", "nan "), {"lamp.ies:8: candela value: 'nan' is not finite"}},
        {replaced(plain, "100 ", "1e999 "), {"lamp.ies:8: candela value: '1e999'", "range"}},
        {replaced(plain, "100 ", "-1 "), {"lamp.ies:8: candela value: -1", "at least 0"}},
        {replaced(plain, "100 ", "x1 "), {"lamp.ies:8: candela value: 'x1' is not a number"}},
        {replaced(plain, "1 1 50", "1 1 50 !watts"), {"lamp.ies:5: angle or candela value: '!watts' is not a number"}},
        {plain + "7\n", {"lamp.ies:5: 3 vertical and 1 horizontal", "need 7", "has 8"}},
        {withNumbers([](IesText& t) { t.candela = [](double, double) { return 0; }; }), {"every candela value is 0"}},
        {withNumbers([](IesText& t) { t.lamps = "1 -1 1e300"; }),
         {"lamp.ies: intensities up to 1e+302 cd", "at most 1e+12"}},
        {withNumbers([](IesText& t) { t.size = "1e9 1 0"; }), {"lamp.ies: a luminous shape of 1e+09 m"}},
        {withNumbers([](IesText& t) { t.lamps = "1 -1 1e-300"; }), {"lamp.ies: a luminous flux of 6.28e-298 lm"}},
        {withNumbers([](IesText& t) {
             t.horizontal = {0, 100};
         }),
         {"lamp.ies:7: horizontal angles from 0 to 100"}},
        {withNumbers([](IesText& t) {
             for (int h = 30; h <= 300; h += 30) t.horizontal.push_back(h); // without 330 and 360
         }),
         {"lamp.ies:7: horizontal angles from 0 to 300"}},
        {replaced(plain, "1 -1 1", "1.5 -1 1"), {"lamp.ies:4: number of lamps: '1.5'", "not an integer"}},
        {withNumbers([](IesText& t) { t.factors = "0 1 5"; }), {"lamp.ies:5: ballast factor: 0"}},
        {withNumbers([](IesText& t) { t.factors = "1 1 -5"; }), {"lamp.ies:5: input watts: -5"}},
        {withNumbers([](IesText& t) { t.type = 2; }), {"horizontal angles: one; expected at least two"}},
        {withNumbers([](IesText& t) { t.tilt = "INCLUDE\n1\n2000000000\n"; }), {"lamp.ies:5: number of tilt angles"}},
        {withNumbers([](IesText& t) { t.tilt = "INCLUDE\n4\n"; }), {"lamp.ies:4: lamp to luminaire geometry"}}};
    for (const auto& [text, messages] : cases)
        for (const std::string error = errorOf("lamp.ies", text); const auto& message : messages)
            EXPECT_THAT(error, HasSubstr(message));
}

TEST(GoniogramErrors, OfEulumdatFilesSayLineAndWhatToDo) {
    const std::pair<std::string, std::vector<std::string>> cases[] = {
        {"", {"the file ends where a line is expected: company"}},
        {withLines([](LdtText& t) { t.symmetry = 5; }), {"lamp.ldt:3: symmetry indicator Isym: 5"}},
        {withLines([](LdtText& t) {
             t.symmetry = 4;
             t.planes = 6;
         }),
         {"lamp.ldt:4: number of C-planes Mc: 6", "multiple of 4"}},
        {replaced(LdtText{}.text(), "1\n1\n4\n", "1\n1\n4000000000\n"), {"lamp.ldt:4: number of C-planes"}},
        {replaced(LdtText{}.text(), "90\n3\n45", "90\n1800\n45"), {"lamp.ldt:51: gamma angles: 100 follows 100"}},
        {withLines([](LdtText& t) { t.factor = "0"; }), {"lamp.ldt:24: conversion factor", "above 0"}},
        {withLines([](LdtText& t) { t.factor = "inf"; }), {"lamp.ldt:24: conversion factor", "not finite"}},
        {withLines([](LdtText& t) { t.lampSets = "0\n"; }), {"lamp.ldt:26: number of sets of lamps: 0"}},
        {withLines([](LdtText& t) { t.lampSets = "1\n0\nx\n5\nx\nx\n5\n"; }), {"lamp.ldt:27: number of lamps: 0"}},
        {withLines([](LdtText& t) { t.lampSets = "1\n1\nx\n0\nx\nx\n5\n"; }), {"lamp.ldt:29: total luminous flux"}},
        {withLines([](LdtText& t) {
             t.gamma = {0, 200};
         }),
         {"lamp.ldt:48: gamma angles: 200", "at most 180"}},
        {withLines([](LdtText& t) { t.intensity = [](double, double) { return -1; }; }), {"luminous intensity: -1"}},
        {withLines([](LdtText& t) { t.intensity = [](double, double) { return 0; }; }),
         {"every luminous intensity is 0"}},
        {LdtText{}.text() + "7\n", {"a line follows the last intensity"}}};
    for (const auto& [text, messages] : cases)
        for (const std::string error = errorOf("lamp.ldt", text); const auto& message : messages)
            EXPECT_THAT(error, HasSubstr(message));
    EXPECT_THAT(errorOf("lamp.ldt", LdtText{}.text(), 2), HasSubstr("no set of lamps number 2"));
    EXPECT_THAT(errorOf("lamp.ies", IesText{}.text(), 2), HasSubstr("IES LM-63 files have one"));
    EXPECT_THAT(errorOf("lamp.txt", "x"), HasSubstr("expected a luminaire's file, .ies"));
}

TEST(GoniogramErrors, AFileThatIsCutOffAnywhereIsRefused) {
    for (const auto& [name, text] : {std::pair{"lamp.ies", IesText{}.text()}, {"lamp.ldt", LdtText{}.text()}}) {
        test::SceneFiles files;
        const size_t last =
            text.find_last_not_of(" \n"); // of "100"; without one or two of its digits it is a number still
        for (size_t length = 0; length < last - 1; ++length)
            EXPECT_THROW(read(files.write(name, text.substr(0, length))), InputError) << name << " " << length;
    }
}

// Bytes and whole numbers are changed at random: nothing crashes, and what is read is finite.
TEST(GoniogramErrors, AFileThatIsDamagedIsRefusedOrReadAsNumbers) {
    IesText ies;
    ies.tilt = "INCLUDE\n1\n2\n0 90\n1 0.5\n";
    ies.horizontal = {0, 45, 90};
    const std::pair<std::string, std::string> files[] = {{"lamp.ies", ies.text()}, {"lamp.ldt", LdtText{}.text()}};
    const std::string pieces[] = {"0", "-1", "1e308", "nan",    "inf",  "4294967296", "",
                                  " ", "\n", "90",    "180",    "360",  "3",          "2",
                                  "1", ".",  "-",     "1e-320", "\x80", "TILT=NONE"};
    std::mt19937 random(7);
    test::SceneFiles folder;
    size_t refused = 0, read = 0;
    for (int k = 0; k < 4000; ++k) {
        auto [name, text] = files[k % 2];
        for (unsigned changes = 1 + random() % 3; changes > 0; --changes)
            text.replace(random() % text.size(), random() % 4, pieces[random() % std::size(pieces)]);
        try {
            const Goniogram goniogram = quasilux::readGoniogram(folder.write(name, text), {});
            const double lumens = goniogram.lumens();
            ASSERT_TRUE(lumens > 0 && lumens < 1e14) << text;
            ASSERT_EQ(goniogram.candela.size(), goniogram.polar.size() * goniogram.azimuth.size());
            ASSERT_GE(goniogram.intensity(directionAt(33, 44)), 0) << text;
            ++read;
        } catch (const InputError&) {
            ++refused;
        }
    }
    EXPECT_GT(refused, 1000u);
    EXPECT_GT(read, 100u);
}

} // namespace
} // namespace quasilux
