// Daylight glare probability against its formula, on images made for it.
#include "photometry/daylight_glare.h"
#include "photometry/position_index.h"
#include "support/program_runner.h"

#include <OpenImageIO/imageio.h>
#include <cmath>
#include <fstream>
#include <functional>
#include <gmock/gmock.h>
#include <nlohmann/json.hpp>
#include <numbers>

namespace quasilux {
namespace {

using std::numbers::pi;
using testing::HasSubstr;
using testing::SizeIs;

const LineOfSight ahead{{0, 0, 1}, {0, 1, 0}};

/// r in half widths where an image that is `width` radians wide shows theta.
double radiusOf(Projection projection, double width, double theta) {
    switch (projection) {
    case Projection::perspective:
        return std::tan(theta) / std::tan(width / 2);
    case Projection::equidistant:
        return theta / (width / 2);
    case Projection::equisolid:
        return std::sin(theta / 2) / std::sin(width / 4);
    case Projection::orthographic:
        return std::sin(theta) / std::sin(width / 2);
    }
    return 0;
}

/// The angle that a pixel at the distance r shows, by bisection: no formula of the program's.
double thetaOf(Projection projection, double width, double r) {
    double low = 0, high = pi / 2 - 1e-9;
    for (int k = 0; k < 60; ++k) (radiusOf(projection, width, (low + high) / 2) < r ? low : high) = (low + high) / 2;
    return low;
}

/// 50 cd/m² everywhere, and 20,000 cd/m² in cones of half angle 0.1 about `lamps`.
LuminanceImage imageOf(const View& view, unsigned size, const std::vector<glm::dvec3>& lamps) {
    LuminanceImage image;
    image.width = image.height = size;
    for (unsigned j = 0; j < size; ++j)
        for (unsigned i = 0; i < size; ++i) {
            const double x = (i + 0.5) / (size / 2.0) - 1, y = 1 - (j + 0.5) / (size / 2.0), r = std::hypot(x, y);
            const double theta = thetaOf(view.projection, view.width, r);
            const glm::dvec3 d(std::sin(theta) * x / r, std::sin(theta) * y / r, std::cos(theta));
            double value = 50;
            for (const glm::dvec3& lamp : lamps)
                if (glm::dot(d, glm::normalize(lamp)) > std::cos(0.1)) value = 20000;
            image.values.push_back(static_cast<float>(value));
        }
    return image;
}

const std::vector<glm::dvec3> twoLamps{{0.5, 0.4, 1}, {-0.3, -0.5, 1}};

/// By hand: cones have 2 pi (1 - cos 0.1) sr, and bring L pi sin² 0.1 cos theta.
double byHand(const std::vector<glm::dvec3>& lamps, double illuminance, double power = 1.87, bool hasIndex = true) {
    double sum = 0;
    for (const glm::dvec3& lamp : lamps) {
        const double p = hasIndex ? positionIndexOfDaylight(ahead, glm::normalize(lamp)) : 1;
        sum += 2e4 * 2e4 * 2 * pi * (1 - std::cos(0.1)) / (std::pow(illuminance, power) * p * p);
    }
    return 5.87e-5 * illuminance + 9.18e-2 * std::log10(1 + sum) + 0.16;
}

double illuminanceOf(const std::vector<glm::dvec3>& lamps) {
    double sum = 50 * pi;
    for (const glm::dvec3& lamp : lamps) sum += (2e4 - 50) * pi * std::pow(std::sin(0.1), 2) * glm::normalize(lamp).z;
    return sum;
}

TEST(DaylightGlare, IsTheFormulaOnEveryFisheye) {
    for (const Projection projection : {Projection::equidistant, Projection::equisolid, Projection::orthographic}) {
        const View view{projection, pi};
        const DaylightGlare glare = daylightGlare(imageOf(view, 400, twoLamps), view, 2000, std::nullopt);
        const double expected = illuminanceOf(twoLamps);
        EXPECT_NEAR(glare.covered, 1, 0.005);
        EXPECT_NEAR(glare.illuminance, expected, 0.01 * expected) << static_cast<int>(projection);
        ASSERT_THAT(glare.sources, SizeIs(2));
        for (const auto& source : glare.sources) {
            EXPECT_NEAR(source.luminance, 20000, 1);
            EXPECT_NEAR(source.solidAngle, 2 * pi * (1 - std::cos(0.1)), 0.02 * 0.0314);
        }
        EXPECT_NEAR(glare.probability, byHand(twoLamps, expected), 0.001);
        // Wrong rules: another exponent, no position index, the direct light forgotten.
        EXPECT_GT(std::abs(glare.probability - byHand(twoLamps, expected, 2)), 0.01);
        EXPECT_GT(std::abs(glare.probability - byHand(twoLamps, expected, 1.87, false)), 0.01);
        EXPECT_GT(std::abs(glare.probability - byHand(twoLamps, 50 * pi)), 0.01);
        EXPECT_FALSE(glare.standardError) << "the image has none";
    }
}

TEST(DaylightGlare, WithoutSourcesIsOfTheIlluminanceAlone) {
    const View view{Projection::equidistant, pi};
    const DaylightGlare glare = daylightGlare(imageOf(view, 200, {}), view, 2000, std::nullopt);
    EXPECT_TRUE(glare.sources.empty());
    EXPECT_NEAR(glare.probability, 5.87e-5 * 50 * pi + 0.16, 1e-4);
    EXPECT_EQ(daylightGlare(imageOf(view, 20, {}), view, 2000, 1e6).probability, 1) << "at most 1";
}

// A blind at 2500 cd/m² with the sun in it: their mean would not glare.
TEST(DaylightGlare, APeakIsASourceOfItsOwn) {
    const View view{Projection::equidistant, pi};
    LuminanceImage image = imageOf(view, 400, {{0.5, 0.4, 1}});
    for (float& value : image.values)
        if (value > 1000) value = 2500;
    const size_t peak =
        static_cast<size_t>(std::max_element(image.values.begin(), image.values.end()) - image.values.begin());
    const size_t within = peak + 6 * image.width; // not at the blind's rim
    ASSERT_EQ(image.values[within], 2500);
    image.values[within] = 1e7f;
    const DaylightGlare glare = daylightGlare(image, view, 2000, 2500);
    ASSERT_THAT(glare.sources, SizeIs(2));
    EXPECT_EQ(glare.sources[0].pixels, 1u);
    EXPECT_FLOAT_EQ(float(glare.sources[0].luminance), 1e7f);
    EXPECT_NEAR(glare.sources[1].luminance, 2500, 1e-6);
    double sum = 0;
    for (const auto& s : glare.sources)
        sum += s.luminance * s.luminance * s.solidAngle / (std::pow(2500, 1.87) * s.positionIndex * s.positionIndex);
    EXPECT_NEAR(glare.probability, 5.87e-5 * 2500 + 9.18e-2 * std::log10(1 + sum) + 0.16, 1e-12);
}

// A night: the formula would divide by nothing.
TEST(DaylightGlare, OfABlackImageIsItsLeast) {
    const View view{Projection::equidistant, pi};
    LuminanceImage image = imageOf(view, 20, {});
    std::fill(image.values.begin(), image.values.end(), 0.f);
    image.standardError.assign(image.values.size(), 0.f);
    const DaylightGlare glare = daylightGlare(image, view, 2000, std::nullopt);
    EXPECT_EQ(glare.probability, 0.16);
    EXPECT_EQ(glare.standardError, 0);
}

TEST(DaylightGlare, OfAPerspectiveImageTakesTheIlluminanceGiven) {
    const View view{Projection::perspective, pi / 2};
    const DaylightGlare glare = daylightGlare(imageOf(view, 300, twoLamps), view, 2000, 1500);
    ASSERT_THAT(glare.sources, SizeIs(2));
    EXPECT_NEAR(glare.probability, byHand(twoLamps, 1500), 0.001);
    // A square of 90 degrees: 2 · 2 / sqrt 2 · atan(1 / sqrt 2) of pi.
    EXPECT_NEAR(glare.covered, 4 / std::sqrt(2) * std::atan(1 / std::sqrt(2)) / pi, 1e-3);
}

TEST(DaylightGlare, ItsErrorBoundsWhatCommonErrorsDo) {
    const View view{Projection::equisolid, pi};
    LuminanceImage image = imageOf(view, 200, twoLamps);
    for (const float value : image.values) image.standardError.push_back(0.01F * value);
    const DaylightGlare glare = daylightGlare(image, view, 2000, std::nullopt);
    ASSERT_TRUE(glare.standardError && glare.illuminanceError);
    EXPECT_NEAR(*glare.illuminanceError, 0.01 * glare.illuminance, 1e-4 * glare.illuminance);
    for (float& value : image.values) value *= 1.01F;
    EXPECT_LE(std::abs(daylightGlare(image, view, 2000, std::nullopt).probability - glare.probability),
              *glare.standardError);
}

class DgpTest : public CommandLineTest {
protected:
    DgpTest() { writeEye("eye.exr", ""); }

    /// `units`: what the header says of them, or nothing. `width`: an equidistant fisheye's, which it says then.
    void writeEye(const char* name, const char* units, std::optional<double> width = {}) const {
        const View view{Projection::equidistant, width.value_or(pi)};
        const LuminanceImage image = imageOf(view, 200, twoLamps);
        std::vector<float> rgb;
        for (const float value : image.values) rgb.insert(rgb.end(), 3, value / 683);
        OIIO::ImageSpec spec(200, 200, 3, OIIO::TypeDesc::FLOAT);
        if (*units) spec.attribute("quasilux:units", units);
        if (width) {
            spec.attribute("quasilux:projection", "equidistant");
            spec.attribute("quasilux:fov", static_cast<float>(*width * 180 / pi));
        }
        const auto file = OIIO::ImageOutput::create("openexr");
        file->open((folder / name).string(), spec);
        file->write_image(OIIO::TypeDesc::FLOAT, rgb.data());
        file->close();
    }
};

TEST_F(DgpTest, IsPrinted) {
    const Outcome text = run({"dgp", "eye.exr"});
    ASSERT_EQ(text.exitCode, 0) << text.errors;
    EXPECT_THAT(text.output, HasSubstr("DGP 0."));
    EXPECT_THAT(text.output, HasSubstr("2 sources from 2000 cd/m2 on"));
    EXPECT_THAT(text.output, HasSubstr("standard error not known"));
    const auto json = nlohmann::json::parse(run({"dgp", "eye.exr", "--json"}).output);
    EXPECT_NEAR(json["DGP"].get<double>(), byHand(twoLamps, illuminanceOf(twoLamps)), 0.002);
    EXPECT_EQ(json["sources"].size(), 2u);
    EXPECT_TRUE(json["standardErrorAtMost"].is_null());
    EXPECT_THAT(run({"dgp", "eye.exr", "--illuminance", "100"}).errors, HasSubstr("DGP was made from 380 lx on"));
}

// The angle in the header is that of the projection there: to say the same one again changes nothing.
TEST_F(DgpTest, KeepsTheAngleOfTheHeader) {
    writeEye("narrow.exr", "", 2 * pi / 3);
    const auto found = [&](std::vector<std::string> options) {
        options.insert(options.begin(), {"dgp", "narrow.exr", "--illuminance", "2000", "--json"});
        const auto json = nlohmann::json::parse(run(options).output);
        return std::pair(json["covered"].get<double>(), json["DGP"].get<double>());
    };
    // Of a uniform field a cone of half angle 60 degrees gives sin² 60 degrees of the illuminance.
    EXPECT_NEAR(found({}).first, 0.75, 0.01);
    EXPECT_EQ(found({"--projection", "equidistant"}), found({}));
    EXPECT_NEAR(found({"--projection", "equisolid"}).first, 1, 0.01) << "of another one nothing is said";
}

// Of a sky in W per nanometre luminances are 107 times too low, so that what glares seems not to.
TEST_F(DgpTest, WarnsOfASkyPerNanometre) {
    writeEye("sky.exr", "radiometric per nanometre");
    writeEye("watts.exr", "radiometric");
    EXPECT_THAT(run({"dgp", "sky.exr"}).errors, HasSubstr("sky.exr: the sky of its scene is in W per nanometre"));
    const auto json = nlohmann::json::parse(run({"dgp", "sky.exr", "--json"}).output);
    EXPECT_THAT(json["warnings"].dump(), HasSubstr("106.75"));
    EXPECT_EQ(run({"dgp", "watts.exr"}).errors, "") << "control";
    EXPECT_EQ(run({"dgp", "sky.exr", "--photometric"}).errors.find("nanometre"), std::string::npos);
    EXPECT_THAT(run({"falsecolour", "sky.exr", "-o", "sky.svg"}).errors, HasSubstr("cd/m² are some 107 times too low"));
    EXPECT_EQ(run({"falsecolour", "watts.exr", "-o", "sky.svg"}).errors, "") << "control";
}

// A file may have fewer pixels than its view, or more.
TEST_F(DgpTest, RefusesAPartOfAView) {
    OIIO::ImageSpec spec(16, 16, 3, OIIO::TypeDesc::FLOAT);
    spec.full_width = spec.full_height = 32;
    spec.x = spec.y = 8;
    const std::vector<float> rgb(3 * 16 * 16, 1.F);
    const auto file = OIIO::ImageOutput::create("openexr");
    ASSERT_TRUE(file->open((folder / "part.exr").string(), spec) &&
                file->write_image(OIIO::TypeDesc::FLOAT, rgb.data()) && file->close());
    expectRefused({"dgp", "part.exr", "--illuminance", "2000"},
                  "part.exr: has 16 x 16 pixels from 8, 8 on of a view of 32 x 32");
}

// Radiance has 179 lm/W, and states in EXPOSURE by what it multiplied.
TEST_F(DgpTest, AsksForTheUnitsOfARadiancePicture) {
    constexpr int size = 64;
    const auto write = [&](const char* name, const std::string& lines, unsigned char exponent) {
        std::ofstream file(folder / name, std::ios::binary);
        file << "#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n" << lines << "\n-Y " << size << " +X " << size << '\n';
        for (int k = 0; k < size * size; ++k) file << "\x80\x80\x80" << char(exponent);
    };
    write("eye.hdr", "", 129);                                  // 1 W
    write("exposed.hdr", "EXPOSURE=4\nEXPOSURE= 0.125\n", 128); // 0.5 by two exposures, of 0.5 together
    const auto illuminance = [&](std::vector<std::string> more) {
        more.insert(more.begin(), "dgp");
        more.emplace_back("--json");
        return nlohmann::json::parse(run(more).output)["illuminance"].get<double>();
    };
    EXPECT_NEAR(illuminance({"eye.hdr"}), 683 * pi, 0.01 * 683 * pi);
    EXPECT_EQ(illuminance({"exposed.hdr"}), illuminance({"eye.hdr"}));
    EXPECT_NEAR(illuminance({"eye.hdr", "--efficacy", "179"}), 179 * pi, 0.01 * 179 * pi);
    EXPECT_NEAR(illuminance({"eye.hdr", "--photometric"}), pi, 0.01 * pi);
    for (const std::vector<std::string>& command :
         {std::vector<std::string>{"dgp", "eye.hdr"}, {"falsecolour", "eye.hdr", "-o", "eye.svg"}}) {
        EXPECT_THAT(run(command).errors, HasSubstr("eye.hdr: a Radiance picture says nothing of its units"));
        auto stated = command;
        stated.insert(stated.end(), {"--efficacy", "179"});
        EXPECT_EQ(run(stated).errors.find("units"), std::string::npos);
    }
    EXPECT_THAT(readText(folder / "eye.svg"), HasSubstr("179 lm/W"));
    write("never.hdr", "EXPOSURE=0\n", 129);
    expectRefused({"dgp", "never.hdr"}, "never.hdr: EXPOSURE in its header is no positive number");
}

TEST_F(DgpTest, RefusesBadInput) {
    expectRefused({"dgp"}, "IMAGE is required");
    expectRefused({"dgp", "nowhere.exr"}, "nowhere.exr");
    expectRefused({"dgp", "eye.exr", "--projection", "perspective"}, "give --fov");
    expectRefused({"dgp", "eye.exr", "--projection", "perspective", "--fov", "60"}, "give --illuminance LX");
    expectRefused({"dgp", "eye.exr", "--projection", "mercator"}, "--projection");
}

} // namespace
} // namespace quasilux
