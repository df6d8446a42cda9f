// `quasilux compare` from outside: files of several kinds, regions of masks, exit codes, the report and the page.
#include "support/program_runner.h"

#include <OpenImageIO/imageio.h>
#include <fstream>
#include <gmock/gmock.h>
#include <limits>
#include <nlohmann/json.hpp>

namespace quasilux {
namespace {

using nlohmann::json;
using testing::HasSubstr;
using testing::Not;

constexpr int width = 8, height = 4;

class CompareCommandTest : public CommandLineTest {
protected:
    /// `value(x, y, channel)` in the numbers of the file: 0 .. 255 for 8 bits.
    template <typename Value>
    void write(const std::string& name, const std::vector<std::string>& channels, const Value& value,
               OIIO::TypeDesc format = OIIO::TypeDesc::FLOAT, int columns = width) const {
        OIIO::ImageSpec spec(columns, height, static_cast<int>(channels.size()), format);
        spec.channelnames = channels;
        spec.attribute("oiio:UnassociatedAlpha", 1); // colours stay as they are under alpha
        const double scale = format == OIIO::TypeDesc::UINT8 ? 255 : format == OIIO::TypeDesc::UINT16 ? 65535 : 1;
        std::vector<float> pixels;
        for (int y = 0; y < height; ++y)
            for (int x = 0; x < columns; ++x)
                for (int c = 0; c < spec.nchannels; ++c) pixels.push_back(static_cast<float>(value(x, y, c) / scale));
        const auto output = OIIO::ImageOutput::create(name);
        ASSERT_TRUE(output) << name;
        ASSERT_TRUE(output->open((folder / name).string(), spec)) << output->geterror();
        ASSERT_TRUE(output->write_image(OIIO::TypeDesc::FLOAT, pixels.data()));
        ASSERT_TRUE(output->close());
    }

    /// image.exr is reference.exr with 2.5 for 2 in the upper half; mask.png is 30 there, 200 below.
    CompareCommandTest() {
        write("reference.exr", rgb, [](int, int, int) { return 2.0; });
        write("image.exr", rgb, [](int, int y, int) { return y < 2 ? 2.5 : 2.0; });
        write(
            "mask.png", {"Y"}, [](int, int y, int) { return y < 2 ? 30 : 200; }, OIIO::TypeDesc::UINT8);
    }

    json report(std::vector<std::string> arguments, int exitCode = 0) const {
        arguments.insert(arguments.begin(), "compare");
        arguments.emplace_back("--json");
        const Outcome outcome = run(arguments);
        EXPECT_EQ(outcome.exitCode, exitCode) << outcome.errors;
        const auto parsed = json::parse(outcome.output, nullptr, false);
        EXPECT_TRUE(parsed.is_object()) << outcome.output;
        return parsed;
    }

    void refuse(std::vector<std::string> arguments, const std::string& message) const {
        arguments.insert(arguments.begin(), "compare");
        expectRefused(arguments, message);
    }

    const std::vector<std::string> rgb{"R", "G", "B"};
};

TEST_F(CompareCommandTest, RegionsOfAMaskAndTheWhole) {
    const json regions = report({"image.exr", "reference.exr", "--mask", "mask.png"})["regions"];
    ASSERT_EQ(regions.size(), 3u);
    EXPECT_EQ(regions[0]["region"], "all");
    EXPECT_NEAR(regions[0]["relMSE"], 0.125 / 4.04, 1e-9);
    EXPECT_EQ(regions[1]["region"], "30");
    EXPECT_NEAR(regions[1]["relMSE"], 0.25 / 4.04, 1e-9);
    EXPECT_NEAR(regions[1]["relativeBias"], 0.25, 1e-9);
    EXPECT_EQ(regions[2]["region"], "200");
    EXPECT_EQ(regions[2]["relMSE"], 0);
    EXPECT_EQ(regions[2]["pixels"], 16);
    EXPECT_TRUE(regions[0]["referenceNoise"].is_null());
}

TEST_F(CompareCommandTest, GroupsColoursAndSixteenBits) {
    const json groups =
        report({"image.exr", "reference.exr", "--mask", "mask.png", "--region", "both=30,200", "--region", "up=30",
                "--reference-noise", "0.001", "--reference-noise", "up=0.002"})["regions"];
    ASSERT_EQ(groups.size(), 3u);
    EXPECT_EQ(groups[1]["region"], "both");
    EXPECT_EQ(groups[1]["pixels"], 32);
    EXPECT_NEAR(groups[1]["netRelMSE"], 0.125 / 4.04 - 0.001, 1e-9);
    EXPECT_NEAR(groups[2]["netRelMSE"], 0.25 / 4.04 - 0.002, 1e-9);

    const auto colour = [](int x, int, int c) { return c == 3 ? 100 * (x % 2) : (x < 2 ? 255 : 128) * (c == 0); };
    write("colour.png", {"R", "G", "B", "A"}, colour, OIIO::TypeDesc::UINT8);
    const json colours = report({"image.exr", "reference.exr", "--mask", "colour.png"})["regions"];
    ASSERT_EQ(colours.size(), 3u) << "alpha must neither count nor change colours";
    EXPECT_EQ(colours[1]["region"], "#ff0000");
    EXPECT_EQ(colours[1]["pixels"], 8);
    EXPECT_EQ(colours[2]["region"], "#800000");

    write(
        "deep.png", {"Y"}, [](int x, int, int) { return x < 1 ? 65535 : 1000; }, OIIO::TypeDesc::UINT16);
    const json deep = report({"image.exr", "reference.exr", "--mask", "deep.png"})["regions"];
    EXPECT_EQ(deep[1]["region"], "65535");
    EXPECT_EQ(deep[2]["region"], "1000");
}

TEST_F(CompareCommandTest, ThresholdsDecideTheExitCode) {
    const std::vector<std::string> base{"image.exr", "reference.exr", "--mask", "mask.png"};
    const auto with = [&](const std::string& option, const std::string& value) {
        auto arguments = base;
        arguments.insert(arguments.end(), {option, value});
        return arguments;
    };
    // Region 30 is the worst: relMSE 0.0619, RMSE 0.5, bias 25 %.
    for (const auto& [option, below, above] : std::vector<std::array<std::string, 3>>{
             {"--max-relmse", "0.061", "0.062"}, {"--max-rmse", "0.49", "0.51"}, {"--max-bias", "0.249", "0.251"}}) {
        EXPECT_THAT(report(with(option, below), 1)["exceeded"], testing::SizeIs(1)) << option;
        EXPECT_THAT(report(with(option, above), 0)["exceeded"], testing::SizeIs(0)) << option;
    }
    const Outcome quiet = run({"compare", "image.exr", "reference.exr", "--max-bias", "0.01", "--quiet"});
    EXPECT_EQ(quiet.exitCode, 1);
    EXPECT_EQ(quiet.output + quiet.errors, "");
    EXPECT_THAT(run({"compare", "image.exr", "reference.exr", "--max-bias", "0.01"}).output,
                HasSubstr("exceeded: relative bias of region all is 0.125, the limit is 0.01"));
}

TEST_F(CompareCommandTest, NothingIsRelativeToABlackReference) {
    write("black.exr", rgb, [](int, int, int) { return 0.0; });
    const Outcome outcome = run({"compare", "image.exr", "black.exr", "--max-bias", "0.1"});
    EXPECT_EQ(outcome.exitCode, 1);
    EXPECT_THAT(outcome.output, HasSubstr("the reference is black in region all"));
    EXPECT_THAT(outcome.output, HasSubstr("undefined"));
    EXPECT_THAT(outcome.output, testing::Not(HasSubstr("nan")));
}

TEST_F(CompareCommandTest, PixelsThatAreNotFiniteAreNamed) {
    write("broken.exr", rgb, [](int x, int y, int c) {
        return x == 5 && y == 3 && c == 1 ? std::numeric_limits<double>::quiet_NaN() : 2.0;
    });
    const Outcome strict = run({"compare", "broken.exr", "reference.exr"});
    EXPECT_EQ(strict.exitCode, 1) << "without any threshold";
    EXPECT_THAT(strict.output, HasSubstr("not finite: 1 pixels of the image, 0 of the reference, at (5, 3)"));
    const json spoilt = report({"broken.exr", "reference.exr", "--max-relmse", "1"}, 1);
    EXPECT_TRUE(spoilt["regions"][0]["relMSE"].is_null());
    EXPECT_THAT(spoilt["exceeded"], testing::SizeIs(2)) << "what is not a number exceeds every limit";
    const json left = report({"broken.exr", "reference.exr", "--max-nonfinite", "1"});
    EXPECT_EQ(left["regions"][0]["relMSE"], 0);
    EXPECT_EQ(left["regions"][0]["nonFinite"], 1);
    EXPECT_EQ(left["nonFinite"]["leftOut"], true);
}

TEST_F(CompareCommandTest, AnotherImageInTheDenominators) {
    write("half.exr", rgb, [](int, int, int) { return 1.0; });
    write("sigma.exr", {"Y"}, [](int, int, int) { return 1.0; });
    const json scaled = report({"image.exr", "reference.exr", "--scale", "half.exr"});
    EXPECT_NEAR(scaled["regions"][0]["relMSE"], 0.125 / 1.01, 1e-9);
    EXPECT_EQ(scaled["scale"], "half.exr");
    EXPECT_TRUE(report({"image.exr", "reference.exr"})["scale"].is_null());
    EXPECT_THAT(run({"compare", "image.exr", "reference.exr", "--reference-stderr", "sigma.exr"}).errors,
                HasSubstr("--scale FILE divides by another image"));
    EXPECT_EQ(run({"compare", "image.exr", "reference.exr"}).errors, "") << "nothing is known of the noise";
    write("broken.exr", rgb,
          [](int x, int y, int) { return x == 5 && y == 3 ? std::numeric_limits<double>::quiet_NaN() : 2.0; });
    refuse({"image.exr", "reference.exr", "--scale", "broken.exr"}, "--scale: broken.exr is not finite at (5, 3)");
    refuse({"image.exr", "reference.exr", "--scale", "missing.exr"}, "missing.exr");
}

TEST_F(CompareCommandTest, StandardErrorsFromLayersOrAFile) {
    const std::vector<std::string> layers{"R", "G", "B", "stderr.R", "stderr.G", "stderr.B"};
    write("noisy.exr", layers, [](int, int, int c) { return c < 3 ? 2.0 : 0.25; });
    write("sigma.exr", {"Y"}, [](int, int, int) { return 0.5; });
    const json fromLayers = report({"image.exr", "noisy.exr"})["regions"][0];
    EXPECT_NEAR(fromLayers["referenceNoise"], 0.0625 / 4.04, 1e-9);
    const json fromFile = report({"noisy.exr", "noisy.exr", "--reference-stderr", "sigma.exr"})["regions"][0];
    EXPECT_NEAR(fromFile["referenceNoise"], 0.25 / 4.04, 1e-9);
    EXPECT_NEAR(fromFile["netRelMSE"], -0.25 / 4.04, 1e-9);
    const json both =
        report({"noisy.exr", "noisy.exr", "--reference-stderr", "sigma.exr", "--net-of-image-noise"})["regions"][0];
    EXPECT_NEAR(both["netRelMSE"], -0.3125 / 4.04, 1e-9);
    EXPECT_NEAR(both["standardErrorByPixels"], std::sqrt(0.3125 / 32), 1e-7);

    write("unknown.exr", layers, [](int, int, int c) { return c < 3 ? 2.0 : std::numeric_limits<double>::infinity(); });
    const Outcome warned = run({"compare", "image.exr", "unknown.exr"});
    EXPECT_EQ(warned.exitCode, 0);
    EXPECT_THAT(warned.errors, HasSubstr("96 values of the stderr layers are negative or not finite"));
    refuse({"unknown.exr", "reference.exr", "--net-of-image-noise"}, "has no usable layers stderr.R");
    write("negative.exr", {"Y"}, [](int, int, int) { return -1.0; });
    refuse({"image.exr", "reference.exr", "--reference-stderr", "negative.exr"},
           "values are negative or not finite, expected standard errors");
}

TEST_F(CompareCommandTest, OtherRenderersFiles) {
    const auto value = [](int x, int y, int c) { return 1.0 + x + 8 * y + 0.5 * c; };
    write("a.exr", {"A", "B", "G", "R"}, [&](int x, int y, int c) { return c == 0 ? 7 : value(x, y, 3 - c); });
    write("half.exr", rgb, value, OIIO::TypeDesc::HALF);
    write("b.hdr", rgb, value);
    std::ofstream pfm(folder / "c.pfm", std::ios::binary);
    pfm << "PF\n" << width << ' ' << height << "\n-1\n"; // rows from the bottom, little endian
    for (int y = height - 1; y >= 0; --y)
        for (int x = 0; x < width; ++x)
            for (int c = 0; c < 3; ++c) {
                const auto v = static_cast<float>(value(x, y, c));
                pfm.write(reinterpret_cast<const char*>(&v), sizeof v);
            }
    pfm.close();
    EXPECT_EQ(report({"half.exr", "a.exr"})["regions"][0]["relMSE"], 0);
    EXPECT_EQ(report({"c.pfm", "a.exr"})["regions"][0]["relMSE"], 0);
    EXPECT_LT(report({"b.hdr", "a.exr"})["regions"][0]["relMSE"], 1e-4); // 8 bits of mantissa
    write("grey.exr", {"Y"}, [](int, int, int) { return 2.0; });
    EXPECT_EQ(report({"grey.exr", "reference.exr"})["regions"][0]["relMSE"], 0);
    // Radiance: the same picture of half the exposure, from the bottom.
    std::string exposed = readText(folder / "b.hdr");
    const std::string asWritten = "\n\n-Y 4 +X 8\n";
    const size_t at = exposed.find(asWritten);
    ASSERT_NE(at, std::string::npos);
    exposed.replace(at, asWritten.size(), "\nEXPOSURE=0.5\n\n+Y 4 +X 8\n");
    std::ofstream(folder / "d.hdr", std::ios::binary) << exposed;
    write("d.exr", rgb, [&](int x, int y, int c) { return 2 * value(x, height - 1 - y, c); });
    EXPECT_LT(report({"d.hdr", "d.exr"})["regions"][0]["relMSE"], 1e-4);
}

// Headers of a few bytes that promise much, and files that end too early.
TEST_F(CompareCommandTest, HeadersAreNotBelieved) {
    const auto put = [&](const char* name, const std::string& content) {
        std::ofstream(folder / name, std::ios::binary) << content;
    };
    put("huge.pfm", "PF\n100000 100000\n-1.0\n");
    put("huger.pfm", "PF\n2000000000 2000000000\n-1.0\n");
    put("huge.hdr", "#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y 1000000 +X 1000000\n");
    for (const std::string name : {"huge.pfm", "huger.pfm", "huge.hdr"})
        refuse({name, "reference.exr"}, name + ": cannot read the image: it has ");
    put("cut.pfm", "PF\n8 4\n-1.0\n" + std::string(95, 'x'));
    refuse({"cut.pfm", "reference.exr"}, "cut.pfm: cannot read the pixels: it ends before its last row");
}

TEST_F(CompareCommandTest, BadInputIsRefused) {
    refuse({"image.exr"}, "REFERENCE is required");
    refuse({"none.exr", "reference.exr"}, "none.exr: cannot read the image");
    std::ofstream(folder / "text.exr") << "no image";
    refuse({"text.exr", "reference.exr"}, "text.exr: cannot read the image");
    refuse({"mask.png", "reference.exr"}, "expected linear radiance in floating point");
    write("two.exr", {"R", "G"}, [](int, int, int) { return 1.0; });
    refuse({"two.exr", "reference.exr"}, "expected channels R, G and B, or one channel; found R, G");
    write(
        "wide.exr", rgb, [](int, int, int) { return 1.0; }, OIIO::TypeDesc::FLOAT, 9);
    refuse({"wide.exr", "reference.exr"}, "wide.exr has 9 x 4 pixels but reference.exr has 8 x 4");
    refuse({"image.exr", "reference.exr", "--mask", "wide.exr"}, "expected 8 x 4 as the images");
    refuse({"image.exr", "reference.exr", "--reference-stderr", "wide.exr"}, "has 9 x 4 pixels, expected 8 x 4");
    refuse({"image.exr", "reference.exr", "--region", "up=30"}, "--region requires --mask");
    const std::vector<std::string> masked{"image.exr", "reference.exr", "--mask", "mask.png"};
    for (const auto& [value, message] : std::vector<std::pair<std::string, std::string>>{
             {"up=31", "no pixel of mask.png has the value 31, expected some of 30, 200"},
             {"up", "expected NAME=VALUE"},
             {"up=30,", "expected NAME=VALUE"},
             {"all=30", "that name means the whole picture"}}) {
        auto arguments = masked;
        arguments.insert(arguments.end(), {"--region", value});
        refuse(arguments, message);
    }
    refuse({"image.exr", "reference.exr", "--reference-noise", "-1"}, "expected a number from 0");
    refuse({"image.exr", "reference.exr", "--reference-noise", "up=1"}, "no region is called 'up'");
    refuse({"image.exr", "reference.exr", "--max-relmse", "x"}, "--max-relmse: 'x' given, expected a number");
    refuse({"image.exr", "reference.exr", "--html", "page.txt"}, "expected a name that ends in .html");
}

TEST_F(CompareCommandTest, ThePageNeedsNothingElse) {
    const Outcome outcome = run({"compare", "image.exr", "reference.exr", "--html", "page.html", "--max-bias", "0.01"});
    EXPECT_EQ(outcome.exitCode, 1) << "the page is written all the same";
    const std::string page = readText(folder / "page.html");
    EXPECT_THAT(page, HasSubstr("image.exr against reference.exr"));
    EXPECT_THAT(page, HasSubstr("exceeded: relative bias of region all"));
    for (const char* outside : {"http", "src=\"/", "href", "import", "fetch("}) {
        std::string markup = page; // without the pictures, whose text is arbitrary
        for (size_t at; (at = markup.find("data:image/png;base64,")) != std::string::npos;)
            markup.erase(at, markup.find('"', at) - at);
        EXPECT_THAT(markup, Not(HasSubstr(outside)));
    }
    size_t pictures = 0;
    for (size_t at = 0; (at = page.find("data:image/png;base64,", at)) != std::string::npos; ++at) ++pictures;
    EXPECT_EQ(pictures, 4u);
}

} // namespace
} // namespace quasilux
