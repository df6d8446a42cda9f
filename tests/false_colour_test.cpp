// Pictures for engineers: colour maps, scales, lines of equal value, and `quasilux falsecolour` from outside.
#include "drawing/contours.h"
#include "drawing/value_scale.h"
#include "output/grid_csv.h"
#include "photometry/isolux.h"
#include "support/program_runner.h"

#include <OpenImageIO/imageio.h>
#include <cmath>
#include <fmt/format.h>
#include <fstream>
#include <gmock/gmock.h>
#include <limits>

namespace quasilux {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::Not;

double lightnessOf(const Colour& colour) {
    const auto linear = [](double v) {
        return v <= 0.04045 * 255 ? v / 255 / 12.92 : std::pow((v / 255 + 0.055) / 1.055, 2.4);
    };
    return 0.2126 * linear(colour.r) + 0.7152 * linear(colour.g) + 0.0722 * linear(colour.b);
}

TEST(ColourMap, LightnessRisesAllTheWay) {
    for (const std::string& name : colourMapNames()) {
        const ColourMap map = parseColourMap(name);
        double before = -1;
        for (int k = 0; k <= 32; ++k) {
            const double here = lightnessOf(colourOf(map, k / 32.0));
            EXPECT_GT(here, before) << name << " at " << k;
            before = here;
        }
        EXPECT_EQ(colourOf(map, -1), colourOf(map, 0));
        EXPECT_EQ(colourOf(map, 2), colourOf(map, 1));
    }
    // As published, between the places that are kept: entries 100 and 200 of 256.
    const Colour viridis = colourOf(ColourMap::viridis, 100 / 255.0),
                 cividis = colourOf(ColourMap::cividis, 200 / 255.0);
    EXPECT_NEAR(viridis.r, 0x2a, 2);
    EXPECT_NEAR(viridis.g, 0x76, 2);
    EXPECT_NEAR(viridis.b, 0x8e, 2);
    EXPECT_NEAR(cividis.r, 0xc4, 2);
    EXPECT_NEAR(cividis.g, 0xb4, 2);
    EXPECT_NEAR(cividis.b, 0x68, 2);
}

TEST(ValueScale, MarksAreRound) {
    EXPECT_THAT((ValueScale{0, 500, false}.marks()), ElementsAre(0, 100, 200, 300, 400, 500));
    EXPECT_THAT((ValueScale{1, 100, true}.marks()), ElementsAre(1, 2, 5, 10, 20, 50, 100));
    EXPECT_EQ((ValueScale{1, 1e5, true}.marks().size()), 6u) << "powers of ten only";
    EXPECT_EQ((ValueScale{100, 300, false}.shareOf(150)), 0.25);
    EXPECT_NEAR((ValueScale{1, 100, true}.shareOf(10)), 0.5, 1e-12);
    EXPECT_LT((ValueScale{1, 100, true}.shareOf(0)), 0);
}

TEST(ValueScale, AutomaticOnesSpanTheValues) {
    std::vector<double> values;
    for (int k = 1; k <= 100; ++k) values.push_back(k);
    values.push_back(1e6); // a lamp
    values.push_back(std::numeric_limits<double>::quiet_NaN());
    const ValueScale linear = automaticScale(values, false, 0.02);
    EXPECT_EQ(linear.from, 0);
    EXPECT_EQ(linear.to, 100);
    EXPECT_EQ(automaticScale(values, false, 0).to, 1e6);
    const ValueScale logarithmic = automaticScale(values, true, 0.02);
    EXPECT_EQ(logarithmic.from, 2) << "the first per cent, 2, rounded down to 1, 2 or 5";
    EXPECT_EQ(logarithmic.to, 100);
    const ValueScale close = closeScale({312, 480, 655}, false);
    EXPECT_EQ(close.from, 300);
    EXPECT_EQ(close.to, 700);
    for (const bool isLogarithmic : {false, true}) {
        const ValueScale dark = automaticScale({0, 0}, isLogarithmic, 0), flat = closeScale({5, 5}, isLogarithmic);
        EXPECT_LT(dark.from, dark.to);
        EXPECT_LT(flat.from, flat.to);
    }
}

Field fieldOf(unsigned cells, double (*value)(double x, double y)) {
    Field field;
    for (unsigned k = 0; k <= cells; ++k) field.x.push_back(double(k) / cells);
    field.y = field.x;
    for (const double y : field.y)
        for (const double x : field.x) field.values.push_back(value(x, y));
    return field;
}

TEST(Contours, OfAPlaneAreStraight) {
    const Field field = fieldOf(10, [](double x, double y) { return x + 2 * y; });
    const auto lines = contoursOf(field, 1.05);
    ASSERT_EQ(lines.size(), 1u);
    for (const Place& place : lines[0]) EXPECT_NEAR(place.x + 2 * place.y, 1.05, 1e-9);
    EXPECT_NEAR(lengthOf(lines[0]), std::hypot(1, 0.5), 1e-9);
    const Place middle = middleOf(lines[0]);
    EXPECT_NEAR(middle.x, 0.5, 1e-9);
    EXPECT_TRUE(contoursOf(field, 3.1).empty());
}

TEST(Contours, OfAHillAreClosed) {
    const Field field = fieldOf(60, [](double x, double y) { return -std::hypot(x - 0.5, y - 0.5); });
    const auto lines = contoursOf(field, -0.3);
    ASSERT_EQ(lines.size(), 1u);
    EXPECT_NEAR(lines[0].front().x, lines[0].back().x, 1e-12);
    EXPECT_NEAR(lengthOf(lines[0]), 2 * 3.14159265 * 0.3, 0.01);
    // Two hills: two closed lines, and a pass between them that the mean of its cell decides.
    const Field hills = fieldOf(3, [](double x, double y) { return (x - 0.5) * (y - 0.5); });
    EXPECT_EQ(contoursOf(hills, 0.001).size(), 2u);
    EXPECT_EQ(contoursOf(hills, -0.001).size(), 2u);
}

TEST(Contours, LieOnTheValueBetweenPoints) {
    EXPECT_NEAR(fieldOf(4, [](double x, double y) { return 3 * x - y; }).value(0.33, 0.71), 0.28, 1e-12);
    const Field wave = fieldOf(40, [](double x, double y) { return std::sin(7 * x) * std::cos(5 * y); });
    for (const double level : {-0.5, 0.1, 0.7})
        for (const auto& line : contoursOf(wave, level))
            for (const Place& place : line) EXPECT_NEAR(wave.value(place.x, place.y), level, 1e-9);
}

TEST(Isolux, LinesLieWhereTheGridHasTheValue) {
    GridValues grid;
    grid.nx = 6;
    grid.ny = 4;
    grid.lengthU = 6;
    grid.lengthV = 4;
    for (unsigned j = 0; j < 4; ++j)
        for (unsigned i = 0; i < 6; ++i) grid.values.push_back(100 + 100 * (i + 0.5)); // 100 lx a metre
    const Drawing drawing = isoluxDrawing(grid, {ColourMap::viridis, scaleOfGrid(grid, false)}, {300}, "grid");
    size_t lines = 0;
    for (const DrawnThing& thing : drawing.things)
        if (const auto* line = std::get_if<DrawnLine>(&thing); line && line->places.size() > 2) {
            ++lines;
            // The grid is 520 pixels wide and begins at 16: 300 lx lie at 2 m.
            for (const Place& place : line->places) EXPECT_NEAR(place.x, 16 + 520 * 2 / 6.0, 1e-6);
        }
    EXPECT_EQ(lines, 2u) << "a rim and the line";
    // What lies beyond the scale is said at its end, and only then.
    EXPECT_THAT(svgOf(isoluxDrawing(grid, {ColourMap::viridis, {200, 450, false}}, {300}, "")),
                testing::AllOf(HasSubstr(">≥ 450</text>"), HasSubstr(">≤ 200</text>")));
    const std::string svg = svgOf(drawing);
    EXPECT_THAT(svg, Not(HasSubstr("≥")));
    EXPECT_THAT(svg, HasSubstr(">300</text>"));
    EXPECT_THAT(svg, HasSubstr(">lx</text>"));
    EXPECT_THAT(svg, HasSubstr("data:image/png;base64,"));
    EXPECT_THAT(svg, Not(HasSubstr("nan,")));
}

class FalseColourTest : public CommandLineTest {
protected:
    FalseColourTest() {
        std::ofstream(folder / "grid.csv") << "# a comment\ni,j,x,y,z,illuminance,illuminance_stderr\n"
                                              "0,0,0,0,0,100,1\n1,0,1,0,0,200,2\n0,1,0,1,0,300,3\n1,1,1,1,0,400,4\n";
        // Grey of radiance 1, 2, 3 … W: 683 cd/m² each.
        std::vector<float> rgb;
        for (int k = 0; k < 8; ++k) rgb.insert(rgb.end(), 3, static_cast<float>(k + 1));
        writeImage("grey.exr", rgb);
    }
    /// Of 4 x 2 pixels.
    void writeImage(const std::string& name, const std::vector<float>& rgb) const {
        const OIIO::ImageSpec spec(4, 2, 3, OIIO::TypeDesc::FLOAT);
        const auto file = OIIO::ImageOutput::create("openexr");
        file->open((folder / name).string(), spec);
        file->write_image(OIIO::TypeDesc::FLOAT, rgb.data());
        file->close();
    }
    std::vector<uint8_t> pixelsOfFile(const std::string& name, OIIO::ImageSpec& spec) const {
        const auto input = OIIO::ImageInput::open((folder / name).string());
        if (!input) return {};
        spec = input->spec();
        std::vector<uint8_t> pixels(spec.image_pixels() * spec.nchannels);
        input->read_image(0, 0, 0, spec.nchannels, OIIO::TypeDesc::UINT8, pixels.data());
        return pixels;
    }
};

TEST_F(FalseColourTest, DrawsAnImageWithItsScale) {
    const Outcome outcome = run({"falsecolour", "grey.exr", "-o", "out.png", "--range", "683:5464"});
    ASSERT_EQ(outcome.exitCode, 0) << outcome.errors;
    OIIO::ImageSpec spec;
    const auto pixels = pixelsOfFile("out.png", spec);
    ASSERT_EQ(spec.nchannels, 3);
    // The first pixel of the picture has the first colour, the last one the last; each is 120 pixels wide.
    const auto at = [&](int x, int y) { return &pixels[3 * (size_t(y) * spec.width + x)]; };
    EXPECT_THAT(std::vector<int>(at(20, 20), at(20, 20) + 3), ElementsAre(0x44, 0x01, 0x54));
    EXPECT_THAT(std::vector<int>(at(490, 250), at(490, 250) + 3), ElementsAre(0xfd, 0xe7, 0x25));
    const Colour middle = colourOf(ColourMap::viridis, 3 / 7.0);
    EXPECT_THAT(std::vector<int>(at(490, 20), at(490, 20) + 3), ElementsAre(middle.r, middle.g, middle.b));

    ASSERT_EQ(run({"falsecolour", "grey.exr", "-o", "out.svg", "--map", "cividis"}).exitCode, 0);
    const std::string svg = readText(folder / "out.svg");
    EXPECT_THAT(svg, HasSubstr(">cd/m²</text>"));
    EXPECT_THAT(svg, HasSubstr("minimum 683, mean 3074, maximum 5464 cd/m²"));
    EXPECT_THAT(svg, HasSubstr("683 lm/W"));
    ASSERT_EQ(run({"falsecolour", "grey.exr", "-o", "out.svg", "--photometric", "--log"}).exitCode, 0);
    EXPECT_THAT(readText(folder / "out.svg"), HasSubstr("minimum 1, mean 4.5, maximum 8 cd/m²"));
}

TEST_F(FalseColourTest, DrawsAGridWithIsoluxLines) {
    const Outcome outcome = run({"falsecolour", "--levels", "250", "grid.csv", "-o", "grid.svg"});
    ASSERT_EQ(outcome.exitCode, 0) << outcome.errors;
    const std::string svg = readText(folder / "grid.svg");
    EXPECT_THAT(svg, HasSubstr(">250</text>"));
    EXPECT_THAT(svg, HasSubstr("2 × 2 points: minimum 100, mean 250, maximum 400 lx"));
    ASSERT_EQ(run({"falsecolour", "grid.csv", "-o", "grid.png", "--log", "--quiet"}).output, "");
    OIIO::ImageSpec spec;
    EXPECT_FALSE(pixelsOfFile("grid.png", spec).empty());
}

TEST_F(FalseColourTest, TakesEndingsInUpperCase) {
    std::filesystem::copy_file(folder / "grid.csv", folder / "GRID.CSV");
    ASSERT_EQ(run({"falsecolour", "GRID.CSV", "-o", "GRID.SVG"}).exitCode, 0);
    EXPECT_THAT(readText(folder / "GRID.SVG"), HasSubstr("maximum 400 lx"));
    ASSERT_EQ(run({"falsecolour", "GRID.CSV", "-o", "GRID.PNG"}).exitCode, 0);
    EXPECT_THAT(readText(folder / "GRID.PNG"), HasSubstr("PNG"));
}

TEST_F(FalseColourTest, OfARenderedGridKnowsItsUnits) {
    std::ofstream(folder / "room.xml")
        << "<scene version=\"3.0.0\"><?quasilux units=\"photometric\"?><emitter type=\"point\"><rgb name=\"intensity\" "
           "value=\"100\"/></emitter><?quasilux illuminance-grid origin=\"-1,-1,-2\" edge-u=\"2,0,0\" edge-v=\"0,2,0\" "
           "nx=\"3\" ny=\"3\"?></scene>";
    ASSERT_EQ(run({"render", "room.xml", "--grid", "g.csv", "-o", "g.exr", "--passes", "2"}).exitCode, 0);
    ASSERT_EQ(run({"falsecolour", "g.csv", "-o", "g.svg"}).exitCode, 0);
    ASSERT_EQ(run({"falsecolour", "g.exr", "-o", "e.svg"}).exitCode, 0);
    EXPECT_THAT(readText(folder / "g.svg"), HasSubstr("maximum 25 lx"));
    EXPECT_THAT(readText(folder / "e.svg"), HasSubstr("maximum 25 lx"));
}

// Of a sky in W per nanometre lux are 107 times too low, though no ratio of them.
TEST_F(FalseColourTest, OfATablePerNanometreIsWarnedOf) {
    FilmImage image;
    image.width = 2;
    image.height = image.passes = image.batches = 1;
    image.radiance = {1, 1, 1, 2, 2, 2};
    RenderRecord record;
    record.meter = MeterKind::grid;
    record.grids.emplace_back();
    record.grids[0].nx = 2;
    record.grids[0].ny = 1;
    record.grids[0].edgeU = {2, 0, 0};
    record.grids[0].edgeV = {0, 1, 0};
    record.unobstructedIlluminance = 1000;
    for (const bool perNanometre : {false, true}) {
        record.isPerNanometre = perNanometre;
        writeGridCsv((folder / "sky.csv").string(), image, record);
        const auto warns = [&](std::vector<std::string> more) {
            more.insert(more.begin(), {"falsecolour", "sky.csv", "-o", "sky.svg"});
            const Outcome outcome = run(more);
            EXPECT_EQ(outcome.exitCode, 0) << outcome.errors;
            return outcome.errors.find(
                       "sky.csv: the sky of its scene is in W per nanometre, so that lx are some 107") !=
                   std::string::npos;
        };
        EXPECT_EQ(warns({}), perNanometre);
        EXPECT_FALSE(warns({"--daylight-factor"}));
        EXPECT_FALSE(warns({"--quiet"}));
    }
}

TEST_F(FalseColourTest, WithoutAFinitePixelThereIsNothingToDraw) {
    writeImage("nan.exr", std::vector<float>(24, std::numeric_limits<float>::quiet_NaN()));
    expectRefused({"falsecolour", "nan.exr", "-o", "out.png"}, "nan.exr: no pixel is finite");
}

TEST_F(FalseColourTest, RefusesBadInput) {
    const auto refused = [&](std::vector<std::string> more, const std::string& message) {
        more.insert(more.begin(), "falsecolour");
        expectRefused(more, message);
    };
    refused({"grey.exr"}, "--output is required");
    refused({"nowhere.exr", "-o", "a.png"}, "nowhere.exr");
    refused({"nowhere.csv", "-o", "a.png"}, "cannot read the grid 'nowhere.csv'");
    refused({"grey.exr", "-o", "a.jpg"}, "expected a name that ends in .png or .svg");
    refused({"grey.exr", "-o", "a.png", "--range", "5:1"}, "two numbers A:B");
    refused({"grey.exr", "-o", "a.png", "--range", "0:1", "--log"}, "begins above 0");
    refused({"grey.exr", "-o", "a.png", "--levels", "5"}, "isolux lines are of grids");
    refused({"grid.csv", "-o", "a.png", "--efficacy", "179"}, "a grid's table is in lx already");
    refused({"grid.csv", "-o", "a.png", "--daylight-factor"}, "grid.csv:3: the table has no column 'daylight_factor'");
    std::ofstream(folder / "bad.csv") << "i,j,x,y,z,illuminance,illuminance_stderr\n0,0,0,0,0,ten,\n";
    refused({"bad.csv", "-o", "a.png"}, "bad.csv:2: column 'illuminance': 'ten' is not a finite number");
    std::ofstream(folder / "bad.csv") << "i,j,x,y,z,illuminance,illuminance_stderr\n1,0,0,0,0,1,\n";
    refused({"bad.csv", "-o", "a.png"}, "bad.csv:2: point 1, 0 is out of order");
}

} // namespace
} // namespace quasilux
