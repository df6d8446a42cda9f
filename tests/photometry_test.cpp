// `quasilux photometry`: its figures against closed forms, the polar curve, and the command from outside.
#include "photometry/photometry.h"
#include "support/luminaire_files.h"
#include "support/program_runner.h"
#include "support/scene_files.h"

#include <cmath>
#include <fstream>
#include <gmock/gmock.h>
#include <nlohmann/json.hpp>
#include <numbers>

namespace quasilux {
namespace {

using std::numbers::pi;
using test::IesText;
using test::luminaireOf;
using testing::HasSubstr;
using testing::Not;
constexpr double degree = pi / 180;

Goniogram readFile(const std::string& name) { return readGoniogram(test::luminaireFolder + name, {}); }

std::vector<double> everyDegree(double first, double last) {
    std::vector<double> angles;
    for (double angle = first; angle <= last; ++angle) angles.push_back(angle);
    return angles;
}

TEST(Photometry, OfALambertianRectangleIsThatOfItsLuminance) {
    IesText ies;
    ies.vertical = everyDegree(0, 90);
    ies.size = "0.6 1.2 0";
    ies.candela = [](double v, double) { return 500 * std::cos(v * degree); };
    const Photometry figures = photometryOf(luminaireOf(ies));
    EXPECT_NEAR(figures.lumens, 500 * pi, 0.1);
    EXPECT_EQ(figures.upwardLumens, 0);
    EXPECT_NEAR(figures.efficacy(), 10 * pi, 0.01);
    EXPECT_EQ(figures.largest, 500);
    EXPECT_EQ(figures.largestGamma, 0);
    ASSERT_EQ(figures.luminances.size(), 9u);
    for (const LuminanceRow& row : figures.luminances) {
        EXPECT_NEAR(row.c0, 500 / 0.72, 1e-2) << row.gamma;
        EXPECT_NEAR(row.c90, 500 / 0.72, 1e-2) << row.gamma;
        EXPECT_NEAR(row.highest, 500 / 0.72, 1e-2) << row.gamma;
    }
    EXPECT_NEAR(figures.planes[0].beam, 120, 0.01) << "the cosine is a half at 60 degrees";
    EXPECT_NEAR(figures.planes[1].field, 2 * std::acos(0.1) / degree, 0.01);
}

TEST(Photometry, AnglesAreThoseOfTheCurve) {
    const Photometry spot = photometryOf(readFile("spot_cos40.ies"));
    // Of cos^40, within what lines between values a degree apart add.
    EXPECT_NEAR(spot.planes[0].beam, 2 * std::acos(std::pow(0.5, 1 / 40.0)) / degree, 0.02);
    EXPECT_NEAR(spot.planes[0].field, 2 * std::acos(std::pow(0.1, 1 / 40.0)) / degree, 0.04);
    EXPECT_TRUE(spot.luminances.empty()) << "of a point";
    const Photometry isotropic = photometryOf(readFile("isotropic100.ies"));
    EXPECT_EQ(isotropic.planes[0].beam, 360) << "it never falls to a half";
    EXPECT_NEAR(isotropic.upwardLumens, 200 * pi, 1e-6);

    // A tent of half width 20 about 50 degrees in C90, and nothing elsewhere.
    IesText ies;
    ies.vertical = everyDegree(0, 90);
    ies.horizontal = {0, 45, 90, 135, 180};
    ies.candela = [](double v, double h) { return h == 90 ? std::max(1000 - 50 * std::abs(v - 50), 0.0) : 0.0; };
    const Photometry tent = photometryOf(luminaireOf(ies));
    EXPECT_NEAR(tent.planes[1].beam, 20, 1e-3);
    EXPECT_NEAR(tent.planes[1].field, 36, 1e-3);
    EXPECT_NEAR(tent.largestC, 90, 1e-9);
    EXPECT_NEAR(tent.largestGamma, 50, 1e-9);
    EXPECT_EQ(tent.planes[0].c, 0);
}

TEST(Photometry, UpwardsIsWhatLeavesAboveTheHorizon) {
    for (const unsigned type : {1u, 2u, 3u}) {
        IesText ies;
        ies.type = static_cast<int>(type);
        ies.vertical = type == 1 ? everyDegree(0, 180) : everyDegree(-90, 90);
        ies.horizontal = type == 1 ? std::vector<double>{0} : everyDegree(-90, 90);
        // Type C: uplight of half the intensity, though 90 degrees is no angle of the file; the others look along the
        // axis only.
        if (type == 1) ies.vertical.erase(ies.vertical.begin() + 90);
        ies.candela = [&](double v, double) { return type == 1 && v > 90 ? 50 : 100; };
        const Photometry figures = photometryOf(luminaireOf(ies));
        EXPECT_NEAR(figures.upwardLumens, type == 1 ? 100 * pi * (1 + degree / 4) : 0, 1) << type;
        EXPECT_NEAR(figures.lumens, type == 1 ? 300 * pi : 200 * pi, 1) << type;
    }
}

TEST(Photometry, ThePolarCurveIsAPageOfItsOwn) {
    IesText ies;
    const std::string text = ies.text();
    test::SceneFiles files;
    const std::string path = files.write("lamp.ies", std::string(text).replace(text.find("of a test"), 9, "<A & B>"));
    const std::string svg = svgOf(polarCurve(readGoniogram(path, {})));
    EXPECT_THAT(svg, HasSubstr("xmlns=\"http://www.w3.org/2000/svg\""));
    EXPECT_THAT(svg, HasSubstr("&lt;A &amp; B&gt;"));
    EXPECT_THAT(svg, HasSubstr("C270 (left) – C90 (right)"));
    EXPECT_THAT(svg, Not(HasSubstr("nan")));
    // 100 cd all over the lower half: both curves reach the outermost of five rings, straight down.
    EXPECT_THAT(svg, HasSubstr("L240.0,452.0"));
}

class PhotometryCommandTest : public CommandLineTest {
protected:
    PhotometryCommandTest() {
        std::ofstream(folder / "lamp.ies") << IesText{}.text();
        std::ofstream(folder / "lamp.ldt") << test::LdtText{}.text();
    }
};

TEST_F(PhotometryCommandTest, PrintsFiguresAndWritesTheCurve) {
    const Outcome text = run({"photometry", "lamp.ies", "--svg", "lamp.svg"});
    EXPECT_EQ(text.exitCode, 0) << text.errors;
    EXPECT_THAT(text.output, HasSubstr("luminous flux: 628.319 lm"));
    EXPECT_THAT(text.output, HasSubstr("wrote lamp.svg"));
    EXPECT_THAT(readText(folder / "lamp.svg"), HasSubstr("</svg>"));
    const Outcome outcome = run({"photometry", "lamp.ldt", "--json"});
    const auto figures = nlohmann::json::parse(outcome.output);
    EXPECT_EQ(figures.at("format"), "EULUMDAT");
    EXPECT_NEAR(figures.at("lumens").get<double>(), 200 * pi, 1e-6);
    EXPECT_NEAR(figures.at("efficacy").get<double>(), 10 * pi, 1e-6);
    EXPECT_EQ(figures.at("lampLumens"), 1000);
    EXPECT_NEAR(figures.at("statedLightOutputRatio").get<double>(), 0.8, 1e-12);
    EXPECT_THAT(run({"photometry", "lamp.ldt"}).output, HasSubstr("leave the luminaire 62.8 %, by the file 80 %"));
    EXPECT_EQ(run({"photometry", "lamp.ldt", "--quiet"}).output, "");
}

TEST_F(PhotometryCommandTest, RefusesBadInput) {
    expectRefused({"photometry"}, "FILE is required");
    expectRefused({"photometry", "nowhere.ies"}, "cannot read the luminaire file 'nowhere.ies'");
    expectRefused({"photometry", "lamp.ies", "--svg", "lamp.png"}, "--svg");
    expectRefused({"photometry", "lamp.ldt", "--lamp-set", "2"}, "no set of lamps number 2 in 'lamp.ldt'");
    std::ofstream(folder / "lamp.ies") << "IES:LM-63-2019\nTILT=NONE\n1 -1 nan\n";
    expectRefused({"photometry", "lamp.ies"}, "lamp.ies:3: candela multiplier: 'nan' is not finite");
}

} // namespace
} // namespace quasilux
