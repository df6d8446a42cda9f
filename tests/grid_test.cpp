// The table of an illuminance-grid and the readings that the program prints.
#include "support/meter_scenes.h"
#include "support/program_runner.h"

#include <cmath>
#include <fstream>
#include <gmock/gmock.h>
#include <nlohmann/json.hpp>
#include <numbers>
#include <sstream>

namespace quasilux {
namespace {

using testing::HasSubstr;

const std::string pointLight = "<emitter type=\"point\"><rgb name=\"intensity\" value=\"2,1,4\"/></emitter>";
const std::string grid = "<?quasilux illuminance-grid origin=\"-1,-1,-2\" edge-u=\"2,0,0\" edge-v=\"0,2,0\" nx=\"2\" "
                         "ny=\"3\"?>";

std::vector<std::vector<std::string>> rowsOf(const std::string& text) {
    std::vector<std::vector<std::string>> rows;
    std::istringstream lines(text);
    for (std::string line; std::getline(lines, line);) {
        if (line.rfind('#', 0) == 0) continue;
        std::istringstream cells(line);
        rows.emplace_back();
        for (std::string cell; std::getline(cells, cell, ',');) rows.back().push_back(cell);
    }
    return rows;
}

class GridTest : public CommandLineTest {
protected:
    void write(const std::string& name, const std::string& body) const {
        std::ofstream(folder / name) << "<scene version=\"3.0.0\">" << body << "</scene>";
    }
};

TEST_F(GridTest, IsWrittenPointByPoint) {
    write("grid.xml", pointLight + grid);
    const Outcome outcome = run({"render", "grid.xml", "--grid", "out.csv", "--passes", "2"});
    ASSERT_EQ(outcome.exitCode, 0) << outcome.errors;
    EXPECT_THAT(outcome.output, HasSubstr("wrote out.csv"));
    EXPECT_FALSE(std::filesystem::exists(folder / "grid.exr")) << "no image was asked for";
    const std::string text = readText(folder / "out.csv");
    for (const char* setting : {"# bdd: 0", "# seed: 1", "# passes: 2", "# quasiSpecular: auto", "# scene: grid.xml"})
        EXPECT_THAT(text, HasSubstr(setting));
    const auto rows = rowsOf(text);
    ASSERT_EQ(rows.size(), 7u);
    EXPECT_EQ(rows[0].size(), 28u);
    EXPECT_EQ(rows[0][2], "x");
    EXPECT_EQ(rows[0][10], "irradiance_R");
    for (size_t k = 1; k < rows.size(); ++k) {
        ASSERT_EQ(rows[k].size(), rows[0].size());
        const double x = std::stod(rows[k][2]), y = std::stod(rows[k][3]), z = std::stod(rows[k][4]);
        EXPECT_NEAR(x, (k - 1) % 2 == 0 ? -0.5 : 0.5, 1e-9);
        EXPECT_NEAR(y, -2 / 3.0 + 2 / 3.0 * std::floor((k - 1) / 2.0), 1e-6);
        EXPECT_EQ(z, -2);
        const double truth = 2 / std::pow(x * x + y * y + 4, 1.5); // of intensity 1
        EXPECT_NEAR(std::stod(rows[k][10]), 2 * truth, 1e-5);
        EXPECT_NEAR(std::stod(rows[k][12]), 4 * truth, 1e-5);
        EXPECT_NEAR(std::stod(rows[k][16]), 2 * truth, 1e-5) << "all of it direct";
        EXPECT_NEAR(std::stod(rows[k][8]), 683 * (0.2126 * 2 + 0.7152 + 0.0722 * 4) * truth, 1e-2);
    }
}

TEST_F(GridTest, SeveralAreOneTable) {
    const std::string begin = "<?quasilux illuminance-grid origin=\"-1,-1,-2\" edge-u=\"2,0,0\" edge-v=\"0,2,0\" ",
                      walls = begin + "nx=\"2\" ny=\"3\" name=\"faces\" quantity=\"cylindrical\"?>",
                      single = begin + "nx=\"2\" ny=\"1\" name=\"single row\"?>";
    write("grids.xml", pointLight + grid + walls + single);
    const Outcome outcome =
        run({"render", "grids.xml", "--grid", "out.csv", "--stats", "s.json", "--passes", "4", "--fixed"});
    ASSERT_EQ(outcome.exitCode, 0) << outcome.errors;
    EXPECT_THAT(outcome.output, HasSubstr("modelling"));
    const auto rows = rowsOf(readText(folder / "out.csv"));
    ASSERT_EQ(rows.size(), 1 + 6 + 6 + 2u);
    EXPECT_EQ(rows[0][0], "grid");
    EXPECT_EQ(rows[1][0], "grid 1");
    EXPECT_EQ(rows[7][0], "faces");
    EXPECT_EQ(rows[13][0], "single row");
    const auto meter = nlohmann::json::parse(readText(folder / "s.json"))["meter"];
    ASSERT_EQ(meter["grids"].size(), 3u);
    EXPECT_EQ(meter["grids"][1]["kind"], "cylindrical");
    // Of a point: cylindrical over horizontal = tan(theta) / pi.
    const double nearest = std::hypot(0.5, 0) / 2 / std::numbers::pi;
    EXPECT_NEAR(meter["grids"][1]["modelling"]["minimum"].get<double>(), nearest, 0.05 * nearest);
    EXPECT_FALSE(meter["grids"][0].contains("modelling"));
    expectRefused({"falsecolour", "out.csv", "-o", "out.svg"},
                  "the grids grid 1, faces, single row, choose one by --grid");
    expectRefused({"falsecolour", "out.csv", "-o", "out.svg", "--grid", "face"}, "not 'face'");
    EXPECT_EQ(run({"falsecolour", "out.csv", "-o", "out.svg", "--grid", "faces"}).exitCode, 0);
}

TEST_F(GridTest, PhotometricUnitsLeaveTheEfficacyOut) {
    write("grid.xml", "<?quasilux units=\"photometric\"?>" + pointLight + grid);
    ASSERT_EQ(run({"render", "grid.xml", "--grid", "out.csv", "--passes", "1"}).exitCode, 0);
    const auto rows = rowsOf(readText(folder / "out.csv"));
    ASSERT_GT(rows.size(), 1u);
    const double y =
        0.2126 * std::stod(rows[1][10]) + 0.7152 * std::stod(rows[1][11]) + 0.0722 * std::stod(rows[1][12]);
    EXPECT_NEAR(std::stod(rows[1][8]), y, 1e-6);
    EXPECT_EQ(rows[1][9], "") << "one pass tells nothing of the error";
}

TEST_F(GridTest, IsRefusedWhereThereIsNone) {
    expectRefused({"render", "scene.xml", "--grid", "out.csv"}, "no illuminance-grid");
    expectRefused({"render", "scene.xml", "--grid", "out.txt"}, ".csv");
    write("both.xml", pointLight + grid);
    expectRefused({"render", "both.xml", "--grid", "out.csv", "--without", "bias"}, "--without is of images");
}

// Of a point light 2 above the grid, irradiances are as 1 / distance^3: 2 (x^2 + y^2 + 4)^-1.5.
TEST_F(GridTest, StatesWhatNormsAskFor) {
    write("grid.xml", pointLight + grid);
    const Outcome outcome = run({"render", "grid.xml", "--grid", "out.csv", "--stats", "s.json", "--passes", "2"});
    ASSERT_EQ(outcome.exitCode, 0) << outcome.errors;
    const auto lux = [](double y) {
        return 683 * (0.2126 * 2 + 0.7152 + 0.0722 * 4) * 2 / std::pow(0.25 + y * y + 4, 1.5);
    };
    const double most = lux(0), least = lux(2 / 3.0), mean = (most + 2 * least) / 3;
    const auto meter = nlohmann::json::parse(readText(folder / "s.json"))["meter"];
    EXPECT_NEAR(meter["illuminance"].get<double>(), mean, 1e-4 * mean);
    EXPECT_EQ(meter["grid"]["points"], 6);
    EXPECT_NEAR(meter["grid"]["minimum"].get<double>(), least, 1e-4 * least);
    EXPECT_NEAR(meter["grid"]["maximum"].get<double>(), most, 1e-4 * most);
    EXPECT_NEAR(meter["grid"]["U0"].get<double>(), least / mean, 1e-4);
    EXPECT_NEAR(meter["grid"]["Ud"].get<double>(), least / most, 1e-4);
    EXPECT_LT(meter["grid"]["U0StandardError"].get<double>(), 1e-4);
    const std::string table = readText(folder / "out.csv");
    for (const std::string& line : {fmt::format("# U0: {:.3f}", std::floor(1000 * least / mean) / 1000),
                                    fmt::format("# mean: {:.0f}", std::floor(mean))})
        EXPECT_THAT(table, HasSubstr(line));
}

// EN 12464-1: of 4.8 m x 7.2 m the longer side counts, 0.2 * 5^lg 7.2 = 0.794 m; of 2 m x 7.2 m the shorter one, 0.325
// m; 10 m at most. The other side goes by the spacing that results: of 6.2 m x 3.8 m 9 points along 6.2 m are 0.689 m
// apart, and 3.8 m has 5.5 such spacings.
TEST_F(GridTest, SpacingIsThatOfTheNorm) {
    const auto sizeOf = [&](const std::string& u, const std::string& v) {
        const Scene scene = test::meterScene("<?quasilux illuminance-grid origin=\"0,0,0\" edge-u=\"" + u +
                                             "\" edge-v=\"" + v + "\" spacing=\"en12464\"?>" + pointLight);
        return std::pair(scene.grids.front().nx, scene.grids.front().ny);
    };
    EXPECT_EQ(sizeOf("4.8,0,0", "0,7.2,0"), std::pair(6u, 9u));
    EXPECT_EQ(sizeOf("0,0,2", "0,7.2,0"), std::pair(6u, 22u));
    EXPECT_EQ(sizeOf("6.2,0,0", "0,3.8,0"), std::pair(9u, 6u));
    EXPECT_EQ(sizeOf("0,3.8,0", "6.2,0,0"), std::pair(6u, 9u));
    EXPECT_EQ(sizeOf("1000,0,0", "0,900,0"), std::pair(100u, 90u));
    EXPECT_EQ(sizeOf("0.01,0,0", "0,0.01,0"), std::pair(1u, 1u));
    write("grid.xml", pointLight + grid.substr(0, grid.size() - 2) + " spacing=\"en12464\"?>");
    expectRefused({"render", "grid.xml", "--grid", "out.csv"}, "both spacing and nx");
    write("grid.xml",
          pointLight +
              "<?quasilux illuminance-grid origin=\"0,0,0\" edge-u=\"1,0,0\" edge-v=\"0,1,0\" spacing=\"1\"?>");
    expectRefused({"render", "grid.xml", "--grid", "out.csv"}, "expected en12464");
}

TEST_F(GridTest, AMeterIsPrinted) {
    write("meter.xml", pointLight +
                           "<shape type=\"rectangle\"><transform name=\"to_world\"><scale value=\"0.001\"/>"
                           "<translate z=\"-2\"/></transform>" +
                           test::irradiancemeter() + "</shape>");
    const Outcome text = run({"render", "meter.xml", "--passes", "4", "--stats", "s.json"});
    ASSERT_EQ(text.exitCode, 0) << text.errors;
    EXPECT_THAT(text.output, HasSubstr("irradiance R 0.5"));
    EXPECT_THAT(text.output, HasSubstr(" lx"));
    const Outcome asJson = run({"render", "meter.xml", "--passes", "4", "--json"});
    for (const std::string& document : {asJson.output, readText(folder / "s.json")}) {
        const auto meter = nlohmann::json::parse(document)["meter"];
        EXPECT_EQ(meter["quantity"], "irradiance");
        EXPECT_EQ(meter["unit"], "W/m2");
        EXPECT_NEAR(meter["value"][1].get<double>(), 0.25, 1e-5);
        EXPECT_NEAR(meter["components"]["direct"][1].get<double>(), 0.25, 1e-5);
        EXPECT_LT(meter["standardError"][1].get<double>(), 1e-5);
        EXPECT_NEAR(meter["illuminance"].get<double>(), 683 * (0.2126 * 0.5 + 0.7152 * 0.25 + 0.0722), 1e-2);
    }
}

} // namespace
} // namespace quasilux
