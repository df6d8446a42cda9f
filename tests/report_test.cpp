// `quasilux report` from outside: a page that needs nothing besides itself, and figures that hold.
#include "support/luminaire_files.h"
#include "support/meter_scenes.h"
#include "support/program_runner.h"

#include <cmath>
#include <fstream>
#include <gmock/gmock.h>
#include <nlohmann/json.hpp>
#include <numbers>
#include <regex>

namespace quasilux {
namespace {

using testing::HasSubstr;
using testing::Not;

class ReportTest : public CommandLineTest {
protected:
    ReportTest() {
        // A panel of 0.6 m that faces down with 2000 cd/m2, over a floor of reflectance 1/2.
        test::IesText ies;
        ies.vertical.clear();
        for (int angle = 0; angle <= 90; ++angle) ies.vertical.push_back(angle);
        ies.size = "0.6 0.6 0";
        ies.candela = [](double v, double) { return 720 * std::cos(v * std::numbers::pi / 180); };
        std::ofstream(folder / "panel.ies") << ies.text();
        write("room.xml", camera + lamp + grid + observer);
    }

    void write(const std::string& name, const std::string& body) const {
        std::ofstream(folder / name) << "<scene version=\"3.0.0\">" << body << "</scene>";
    }

    nlohmann::json figuresOf(const std::vector<std::string>& more) const {
        std::vector<std::string> arguments{"report", "room.xml", "-o", "room.html", "--json", "--quiet"};
        arguments.insert(arguments.end(), more.begin(), more.end());
        const Outcome outcome = run(arguments);
        EXPECT_EQ(outcome.exitCode, 0) << outcome.errors;
        return nlohmann::json::parse(outcome.output);
    }

    const std::string camera = "<sensor type=\"perspective\"><transform name=\"to_world\"><lookat origin=\"0,-3,1.2\" "
                               "target=\"0,0,0\" up=\"0,0,1\"/></transform>" +
                               test::film(24, 16) + "</sensor>";
    const std::string lamp =
        "<shape type=\"rectangle\"><transform name=\"to_world\"><scale value=\"4\"/></transform>" + test::diffuse(0.5) +
        "</shape><emitter type=\"quasilux_ies\" id=\"lamp &amp; co\"><string name=\"filename\" value=\"panel.ies\"/>"
        "<transform name=\"to_world\"><rotate x=\"1\" angle=\"180\"/><translate z=\"2.5\"/></transform></emitter>";
    const std::string grid = "<?quasilux illuminance-grid origin=\"-1,-1,0.001\" edge-u=\"2,0,0\" edge-v=\"0,2,0\" "
                             "nx=\"3\" ny=\"3\"?>";
    const std::string observer = "<?quasilux observer name=\"desk\" position=\"0,-2,1.2\" direction=\"0,1,0\"?>";
};

bool holds(const std::string& page, const std::string& part) { return page.find(part) != std::string::npos; }

/// What a browser would have to fetch.
std::vector<std::string> fetchedBy(const std::string& page) {
    std::vector<std::string> found;
    const std::regex source("(?:src|href)=\"([^\"]{0,40})|url\\(([^)]{0,40})|@import");
    for (std::sregex_iterator match(page.begin(), page.end(), source), end; match != end; ++match)
        if (match->str(1).rfind("data:", 0) != 0) found.push_back(match->str(0));
    return found;
}

TEST_F(ReportTest, IsOnePageWithAllParts) {
    const Outcome outcome = run({"report", "room.xml", "-o", "room.html", "--time", "1"});
    ASSERT_EQ(outcome.exitCode, 0) << outcome.errors;
    EXPECT_THAT(outcome.output, HasSubstr("mean illuminance"));
    EXPECT_THAT(outcome.output, HasSubstr("UGR, desk"));
    EXPECT_THAT(outcome.output, HasSubstr("wrote room.html"));
    const std::string page = readText(folder / "room.html");
    EXPECT_THAT(fetchedBy(page), testing::IsEmpty());
    EXPECT_THAT(fetchedBy("<img src=\"a.png\">"), testing::SizeIs(1));
    // Not by HasSubstr, which would print all of it.
    for (const char* part : {"Lighting report", "uniformity U0", "UGR, desk", "isolux lines", "C180 (left)", "cd/m²",
                             "luminous flux by the file", "position index", "lamp &amp; co",
                             "quasilux " QUASILUX_VERSION, "seed", "Bias of the density radius", "</html>"})
        EXPECT_TRUE(holds(page, part)) << part;
    for (const char* wrong : {" nan", ">nan", "\"nan", ",nan", ">inf", " inf "})
        EXPECT_FALSE(holds(page, wrong)) << wrong;
}

// Over the floor alone nothing comes back from above: illuminance is the panel's direct light, at the middle of the
// grid as of a point to 2 %, and the eye's indirect light is that of the floor.
TEST_F(ReportTest, ItsFiguresHold) {
    const auto figures = figuresOf({"--time", "2"});
    const auto& measured = figures["grids"][0];
    const double middle = 720 / 6.25;
    EXPECT_NEAR(measured["maximum"]["value"].get<double>(), middle, 0.03 * middle);
    EXPECT_GT(measured["maximum"]["standardError"].get<double>(), 0);
    EXPECT_TRUE(figures["reached"].get<bool>());
    for (const char* figure : {"mean", "minimum", "U0", "Ud"})
        EXPECT_LE(measured[figure]["relativeHalfWidth95"].get<double>(), 0.01) << figure;
    const auto& desk = figures["observers"][0];
    const double distance2 = 4 + 1.69, cosine = 1.3 / std::sqrt(distance2), area = 0.36 * cosine,
                 sigma = std::atan(1.3 / 2) * 180 / std::numbers::pi,
                 p = std::exp((35.2 - 1.22) * 1e-3 * sigma + 21e-5 * sigma * sigma);
    EXPECT_NEAR(desk["sources"][0]["luminance"].get<double>(), 2000, 5);
    EXPECT_NEAR(desk["sources"][0]["solidAngle"].get<double>(), area / distance2, 1e-4);
    EXPECT_NEAR(desk["sources"][0]["positionIndex"].get<double>(), p, 0.05 * p);
    const double indirect = desk["indirectIlluminance"]["value"].get<double>();
    const double index = desk["sources"][0]["positionIndex"].get<double>();
    EXPECT_NEAR(desk["UGR"]["value"].get<double>(),
                8 * std::log10(0.25 * std::numbers::pi / indirect * 4e6 * area / distance2 / (index * index)), 0.02);
    EXPECT_NEAR(desk["directIlluminance"]["value"].get<double>(), 2000 * area / distance2 * 2 / std::sqrt(distance2),
                0.8);
}

TEST_F(ReportTest, AFigureThatIsNotKnownSaysSo) {
    const auto figures = figuresOf({"--time", "0.5", "--precision", "1e-7"});
    EXPECT_FALSE(figures["reached"].get<bool>());
    const std::string page = readText(folder / "room.html");
    EXPECT_TRUE(holds(page, "(not reached)"));
    EXPECT_TRUE(holds(page, "Not every figure is known to 1e-05 % (95 %)"));
}

// Grids and observers end when their figures are known, the picture when its time is over.
TEST_F(ReportTest, SaysHowLongWhereItKnows) {
    write("grid.xml", lamp + grid);
    write("picture.xml", camera + lamp);
    const auto shown = [&](const std::string& scene) {
        return runOnTerminal({"report", scene, "-o", "room.html", "--time", "2", "--precision", "1e-7"}).output;
    };
    const std::string ofGrid = shown("grid.xml");
    EXPECT_THAT(ofGrid, HasSubstr("rendering: pass "));
    EXPECT_THAT(ofGrid, Not(HasSubstr(" left")));
    shown("picture.xml"); // of the first time all goes to compiling
    EXPECT_THAT(shown("picture.xml"), HasSubstr(" left"));
}

// What was measured before the device failed is on the page. The grid takes some hundreds of launches, as it is soon known
// well enough, the picture has what is left of the time.
TEST_F(ReportTest, ADeviceThatFailsLosesNoPartBefore) {
    write("parts.xml", camera + lamp + grid);
    const Outcome outcome = runWith(
        QUASILUX_BAD_DEVICE, {"report", "parts.xml", "-o", "room.html", "--json", "--time", "60", "--precision", "0.9"},
        {{"QUASILUX_BAD_QUEUE", "1"}, {"QUASILUX_BAD_HOW", "lost"}, {"QUASILUX_BAD_AT", "3000"}});
    EXPECT_EQ(outcome.exitCode, 1) << outcome.errors;
    EXPECT_THAT(outcome.errors, HasSubstr("OpenCL error -5"));
    const auto figures = nlohmann::json::parse(outcome.output);
    ASSERT_EQ(figures["grids"].size(), 1u);
    EXPECT_GT(figures["grids"][0]["mean"]["value"].get<double>(), 0);
    EXPECT_THAT(figures["warnings"].dump(), HasSubstr("as a device failed"));
    EXPECT_TRUE(holds(readText(folder / "room.html"), "as a device failed"));
}

TEST_F(ReportTest, NeedsNeitherCameraNorGrid) {
    write("room.xml", lamp + grid);
    const auto figures = figuresOf({"--time", "0.5"});
    EXPECT_TRUE(figures["observers"].empty());
    EXPECT_FALSE(figures.contains("picture"));
    write("room.xml", camera + lamp);
    EXPECT_TRUE(figuresOf({"--time", "0.5"})["grids"].empty());
    EXPECT_TRUE(holds(readText(folder / "room.html"), "no illuminance-grid and no observer"));
    write("room.xml", lamp + observer);
    const auto alone = figuresOf({"--time", "1"});
    EXPECT_TRUE(alone["grids"].empty());
    EXPECT_FALSE(alone.contains("picture"));
    const double rating = alone["observers"].at(0)["UGR"]["value"].get<double>();
    write("room.xml", camera + lamp + grid + observer);
    EXPECT_NEAR(rating, figuresOf({"--time", "2"})["observers"].at(0)["UGR"]["value"].get<double>(), 0.3);
    write("room.xml", lamp + observer);
    expectRefused({"render", "room.xml"}, "the scene has no <sensor>");
}

// What limits a rating stands among the warnings too.
TEST_F(ReportTest, RemarksOnGlareAreWarnings) {
    write("room.xml", lamp +
                          "<emitter type=\"point\" id=\"bulb\"><point name=\"position\" value=\"0,0,2\"/></emitter>" +
                          observer + grid);
    const std::string warnings = figuresOf({"--time", "0.5"})["warnings"].dump();
    EXPECT_THAT(warnings, HasSubstr("UGR, desk: Not rated: 'bulb' is a point"));
}

// What comes straight to the eye is measured apart, and photons are to bring none of it.
TEST_F(ReportTest, DirectLightOfAnEyeLacksNoPhotons) {
    const std::string wall = "<shape type=\"rectangle\"><transform name=\"to_world\"><rotate x=\"1\" angle=\"90\"/>"
                             "<scale value=\"4\"/><translate y=\"3\"/></transform>" +
                             test::diffuse(0.5) + "</shape>";
    write("room.xml", lamp + wall + observer);
    EXPECT_THAT(figuresOf({"--time", "1"})["warnings"].dump(), Not(HasSubstr("effectively only 0 photons")));
}

// An eye in the plane of a panel: the area that it sees there is rounding.
TEST_F(ReportTest, APanelSeenEdgeOnDoesNotGlare) {
    test::IesText ies;
    ies.size = "0.6 0.6 0";
    std::ofstream(folder / "panel.ies") << ies.text(); // 100 cd along its plane as well
    write("room.xml", lamp + "<?quasilux observer name=\"desk\" position=\"0.3,-2,2.5\" direction=\"0,1,0\"?>" + grid);
    EXPECT_TRUE(figuresOf({"--time", "0.5"})["observers"].at(0)["sources"].empty());
}

TEST_F(ReportTest, RefusesBadInput) {
    expectRefused({"report", "room.xml"}, "--output is required");
    expectRefused({"report", "room.xml", "-o", "room.pdf"}, "expected a name that ends in .html");
    expectRefused({"report", "room.xml", "-o", "room.html", "--precision", "2"}, "--precision");
    expectRefused({"report", "nowhere.xml", "-o", "room.html"}, "nowhere.xml");
    write("dark.xml", camera + grid + observer);
    expectRefused({"report", "dark.xml", "-o", "room.html"}, "the scene has no light, so that every figure");
}

} // namespace
} // namespace quasilux
