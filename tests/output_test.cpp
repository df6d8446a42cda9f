// Files that the program writes: EXR layers and header, and that none is ever half written.
#include "output/atomic_file.h"
#include "output/exr.h"
#include "output/png.h"
#include "output/statistics.h"
#include "util/error.h"

#include "support/folder_files.h"
#include "support/read_text.h"
#include "support/render_records.h"
#include "util/temporary_folder.h"

#include <OpenImageIO/imageio.h>
#include <cerrno>
#include <cmath>
#include <csignal>
#include <filesystem>
#include <fstream>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/resource.h>
#include <system_error>
#include <unistd.h>

namespace quasilux {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

class OutputTest : public testing::Test {
protected:
    std::string path(const std::string& name) const { return (folder.path() / name).string(); }
    std::vector<std::string> files() const { return test::namesIn(folder.path()); }

    TemporaryFolder folder;
};

TEST_F(OutputTest, ExrHoldsEveryLayerUnchanged) {
    const FilmImage image = distinctImage();
    writeExr(path("a.exr"), image, exampleRecord());
    EXPECT_THAT(files(), testing::ElementsAre("a.exr"));

    const auto input = OIIO::ImageInput::open(path("a.exr"));
    ASSERT_TRUE(input);
    const OIIO::ImageSpec& spec = input->spec();
    EXPECT_EQ(spec.width, 5);
    EXPECT_EQ(spec.height, 150);
    EXPECT_EQ(spec.format, OIIO::TypeDesc::FLOAT);
    EXPECT_EQ(spec.get_string_attribute("compression"), "zip");
    const std::vector<std::pair<std::string, const std::vector<float>*>> layers{
        {"", &image.radiance},
        {"direct.", &image.components[LIGHT_DIRECT].radiance},
        {"quasi_caustic.", &image.components[LIGHT_QUASI_CAUSTIC].radiance},
        {"emission.", &image.components[FILM_EMISSION].radiance},
        {"stderr.", &image.standardError},
        {"bias.", &image.bias},
        {"bias_stderr.", &image.biasError}};
    const auto channels = static_cast<int>(3 * layers.size());
    ASSERT_EQ(spec.nchannels, channels) << "absent components have no channels";

    std::vector<float> pixels(size_t{5} * 150 * 3 * layers.size());
    ASSERT_TRUE(input->read_image(0, 0, 0, channels, OIIO::TypeDesc::FLOAT, pixels.data()));
    for (const auto& [prefix, values] : layers)
        for (size_t c = 0; c < 3; ++c) {
            const int channel = spec.channelindex(prefix + "RGB"[c]);
            ASSERT_GE(channel, 0) << prefix << "RGB"[c];
            for (size_t i = 0; i < size_t{5} * 150; ++i)
                ASSERT_EQ(pixels[3 * layers.size() * i + static_cast<size_t>(channel)], (*values)[3 * i + c])
                    << prefix << "RGB"[c] << i;
        }
}

TEST_F(OutputTest, PixelFormatsAddLuminanceAndXyz) {
    FilmImage image = distinctImage();
    const auto channelOf = [&](const PixelFormat& format, const std::string& name) {
        RenderRecord record = exampleRecord();
        record.pixelFormat = format;
        writeExr(path("a.exr"), image, record);
        const auto input = OIIO::ImageInput::open(path("a.exr"));
        const OIIO::ImageSpec& spec = input->spec();
        const int channel = spec.channelindex(name), all = spec.nchannels;
        std::vector<float> pixels(size_t{5} * 150 * size_t(all)), values;
        EXPECT_TRUE(input->read_image(0, 0, 0, all, OIIO::TypeDesc::FLOAT, pixels.data()));
        for (size_t i = 0; channel >= 0 && i < size_t{5} * 150; ++i)
            values.push_back(pixels[i * size_t(all) + size_t(channel)]);
        return values;
    };
    const PixelFormat luminance{true, false, false}, xyz{false, true, false};
    const auto y = channelOf(luminance, "Y"), sameY = channelOf(xyz, "Y"), x = channelOf(xyz, "X"),
               z = channelOf(xyz, "Z");
    ASSERT_EQ(y.size(), size_t{5} * 150);
    EXPECT_EQ(y, sameY);
    for (size_t i = 0; i < y.size(); ++i) {
        const float* rgb = &image.radiance[3 * i];
        EXPECT_FLOAT_EQ(y[i], 0.212671f * rgb[0] + 0.71516f * rgb[1] + 0.072169f * rgb[2]);
        EXPECT_FLOAT_EQ(x[i], 0.412453f * rgb[0] + 0.35758f * rgb[1] + 0.180423f * rgb[2]);
        EXPECT_FLOAT_EQ(z[i], 0.019334f * rgb[0] + 0.119193f * rgb[1] + 0.950227f * rgb[2]);
    }
    EXPECT_EQ(channelOf(xyz, "R").size(), y.size()) << "R, G, B stay";
    EXPECT_TRUE(channelOf({}, "Y").empty());
}

TEST_F(OutputTest, ExrHeaderHoldsAllSettings) {
    writeExr(path("a.exr"), distinctImage(), exampleRecord());
    const auto input = OIIO::ImageInput::open(path("a.exr"));
    ASSERT_TRUE(input);
    const OIIO::ImageSpec& spec = input->spec();
    const std::vector<std::pair<std::string, std::string>> texts{
        {"version", QUASILUX_VERSION},    {"scene", "box.xml"},
        {"device", "Test device"},        {"driver", "driver 1.2"},
        {"variant", "alternative"},       {"direct", "photons"},
        {"quasiSpecular", "glass,metal"}, {"kernels", "generic"},
        {"seed", "18446744073709551615"}, {"nonFinite", "2"}};
    for (const auto& [key, value] : texts) EXPECT_EQ(spec.get_string_attribute("quasilux:" + key), value) << key;
    const std::vector<std::pair<std::string, int>> counts{{"bdd", 3}, {"photonsPerPass", 4096}, {"passes", 7}};
    for (const auto& [key, value] : counts) EXPECT_EQ(spec.get_int_attribute("quasilux:" + key, -1), value) << key;
    const std::vector<std::pair<std::string, float>> numbers{
        {"radiusScale", 0.5f},      {"seconds", 12.5f},
        {"relativeError", 0.5625f}, {"noiseMean", 0.0625f},
        {"noiseRms", 0.125f},       {"noisePercentile95", 0.25f},
        {"biasRms", 0.5f},          {"biasNoiseRms", 0.75f},
        {"direct.noiseMean", 0.5f}, {"direct.noisePercentile95", 1.5f},
        {"direct.noiseRms", 2.5f},  {"direct.biasRms", 3.5f}};
    for (const auto& [key, value] : numbers) EXPECT_EQ(spec.get_float_attribute("quasilux:" + key, -1), value) << key;
    EXPECT_EQ(spec.get_string_attribute("Software"), "quasilux " QUASILUX_VERSION);

    const std::string documentation = readText(QUASILUX_SOURCE_DIR "/docs/reference/command-line.md");
    for (const auto& attribute : spec.extra_attribs) {
        const std::string name = attribute.name().string();
        if (name.starts_with("quasilux:") && name.find('.') == std::string::npos) { // components have the same keys
            EXPECT_THAT(documentation, HasSubstr("`" + name + "`"));
        }
    }
}

TEST_F(OutputTest, ExrLeavesOutAnUnknownBias) {
    FilmImage image = distinctImage();
    image.bias.clear();
    image.biasError.clear();
    RenderRecord record = exampleRecord();
    record.error.hasBias = false;
    writeExr(path("a.exr"), image, record);
    const auto input = OIIO::ImageInput::open(path("a.exr"));
    ASSERT_TRUE(input);
    EXPECT_EQ(input->spec().channelindex("bias.R"), -1);
    EXPECT_EQ(input->spec().find_attribute("quasilux:biasRms"), nullptr);
    EXPECT_NE(input->spec().find_attribute("quasilux:noiseRms"), nullptr);
}

TEST_F(OutputTest, ExrLeavesOutAnUnknownError) {
    RenderRecord record = exampleRecord();
    record.error.total.noiseMean = INFINITY;
    writeExr(path("a.exr"), distinctImage(), record);
    const auto input = OIIO::ImageInput::open(path("a.exr"));
    ASSERT_TRUE(input);
    EXPECT_EQ(input->spec().find_attribute("quasilux:relativeError"), nullptr);
}

TEST_F(OutputTest, FailedWritesLeaveNothingBehind) {
    FilmImage image = distinctImage();
    image.components[LIGHT_DIRECT].radiance.pop_back();
    EXPECT_THROW(writeExr(path("a.exr"), image, exampleRecord()), std::runtime_error);
    image.radiance.pop_back();
    EXPECT_THROW(writePng(path("a.png"), image, {}, exampleRecord()), std::runtime_error);
    const FilmImage good = distinctImage();
    EXPECT_THROW(writeExr(path("gone/a.exr"), good, exampleRecord()), std::runtime_error);
    EXPECT_THROW(writePng(path("gone/a.png"), good, {}, exampleRecord()), std::runtime_error);
    EXPECT_THROW(writeJson(path("gone/a.json"), {}), std::runtime_error);
    // The final name is a folder, so the rename fails after everything was written.
    fs::create_directory(path("b.exr"));
    EXPECT_THROW(writeExr(path("b.exr"), good, exampleRecord()), std::runtime_error);
    EXPECT_THAT(files(), testing::ElementsAre("b.exr"));
}

// A disk that is full, as far as a limit on files is like one: the reason is that of this failure, not of any before,
// and what was there stays.
TEST_F(OutputTest, FullDiskIsNamedAndLeavesTheOldFile) {
    writeText(path("a.txt"), "old");
    rlimit before{};
    getrlimit(RLIMIT_FSIZE, &before);
    std::signal(SIGXFSZ, SIG_IGN);
    const rlimit small{4096, before.rlim_max};
    setrlimit(RLIMIT_FSIZE, &small);
    errno = EDOM; // stale
    std::error_code why;
    try {
        writeText(path("a.txt"), std::string(10000, 'x'));
    } catch (const std::system_error& error) {
        why = error.code();
    }
    setrlimit(RLIMIT_FSIZE, &before);
    EXPECT_EQ(why.value(), EFBIG) << why.message();
    EXPECT_EQ(readText(path("a.txt")), "old");
    EXPECT_THAT(files(), testing::ElementsAre("a.txt"));
    writeText(path("a.txt"), std::string(10000, 'x')); // control: without the limit
    EXPECT_EQ(readText(path("a.txt")).size(), 10000u);
}

// The file that is replaced is kept by another name, and so on; one that fails to be replaced stays as it is.
TEST_F(OutputTest, AtomicFileKeepsTheOneBefore) {
    for (const char* text : {"1", "2", "3"}) {
        AtomicFile file(path("a"));
        std::ofstream(file.temporary()) << text;
        file.commitKeeping(path("a.previous"));
    }
    EXPECT_EQ(readText(path("a")), "3");
    EXPECT_EQ(readText(path("a.previous")), "2");
    EXPECT_THAT(files(), testing::UnorderedElementsAre("a", "a.previous"));
}

// Where the older name cannot be given, or both are names of one file, no third one is left.
TEST_F(OutputTest, AtomicFileLeavesNoThirdName) {
    const auto commit = [&] {
        AtomicFile file(path("a"));
        std::ofstream(file.temporary()) << "new";
        file.commitKeeping(path("a.previous"));
    };
    std::ofstream(path("a")) << "old";
    fs::create_hard_link(path("a"), path("a.previous"));
    commit();
    EXPECT_EQ(readText(path("a.previous")), "old");
    EXPECT_THAT(files(), testing::UnorderedElementsAre("a", "a.previous"));
    fs::remove(path("a.previous"));
    fs::create_directory(path("a.previous"));
    EXPECT_THROW(commit(), std::system_error);
    EXPECT_THAT(files(), testing::UnorderedElementsAre("a", "a.previous"));
}

// Two that write one file by one temporary name, as two renders of one checkpoint do: until the first has renamed it
// the second can neither write nor remove it.
TEST_F(OutputTest, AtomicFileIsOnesUntilItHasItsName) {
    AtomicFile first(path("a"), path("a.tmp"));
    OutputStream stream(first, path("a"));
    stream.write("first", 5);
    stream.close();
    {
        AtomicFile second(path("a"), path("a.tmp"));
        EXPECT_THROW(OutputStream(second, path("a")), std::system_error);
    }
    EXPECT_THAT(files(), testing::ElementsAre("a.tmp"));
    first.commit();
    EXPECT_EQ(readText(path("a")), "first");
    AtomicFile third(path("a"), path("a.tmp")); // the first is no longer in its way
    OutputStream free(third, path("a"));
    free.write("3", 1);
    free.close();
    third.commit();
    EXPECT_EQ(readText(path("a")), "3");
    EXPECT_THAT(files(), testing::ElementsAre("a"));
}

TEST_F(OutputTest, AtomicFileReplacesOnlyOnCommit) {
    std::ofstream(path("a.txt")) << "old";
    {
        AtomicFile file(path("a.txt"));
        std::ofstream(file.temporary()) << "half";
        EXPECT_EQ(files().size(), 2u);
    }
    EXPECT_EQ(readText(path("a.txt")), "old");
    EXPECT_THAT(files(), testing::ElementsAre("a.txt"));
    {
        AtomicFile file(path("a.txt"));
        std::ofstream(file.temporary()) << "new";
        EXPECT_EQ(readText(path("a.txt")), "old");
        file.commit();
    }
    EXPECT_EQ(readText(path("a.txt")), "new");
    EXPECT_THAT(files(), testing::ElementsAre("a.txt"));
}

// In a container each program may have the same PID, and so the temporary name of one that was killed.
TEST_F(OutputTest, OutputPathsAreFreeWhereOneOfThisPidWasKilled) {
    const std::string left = AtomicFile(path("a.exr")).temporary();
    std::ofstream(left) << "half";
    checkOutputPath(path("a.exr"), "--output", ".exr");
    EXPECT_TRUE(files().empty());
    AtomicFile other(path("a.exr")); // that is written just now keeps its file
    OutputStream stream(other, path("a.exr"));
    checkOutputPath(path("a.exr"), "--output", ".exr");
    EXPECT_EQ(files().size(), 1u);
    stream.close();
    other.commit();
    EXPECT_THAT(files(), testing::ElementsAre("a.exr"));
}

TEST_F(OutputTest, OutputPathsAreCheckedWithoutATrace) {
    checkOutputPath(path("a.exr"), "--output", ".exr");
    checkOutputPath(path("A.EXR"), "--output", ".exr");
    EXPECT_TRUE(files().empty());
    const auto message = [](const std::string& file) -> std::string {
        try {
            checkOutputPath(file, "--output", ".exr");
        } catch (const InputError& error) {
            return error.what();
        }
        return "";
    };
    EXPECT_THAT(message(path("gone/a.exr")), HasSubstr("does not exist"));
    EXPECT_THAT(message(path("a.jpg")),
                HasSubstr("unknown extension '.jpg', expected a name that ends in .exr; --png FILE writes"));
    EXPECT_THAT(message(path("a")), HasSubstr("no extension"));
    fs::create_directory(path("b.exr"));
    EXPECT_THAT(message(path("b.exr")), HasSubstr("is a folder"));
    EXPECT_THAT(message("/proc/a.exr"), HasSubstr("cannot write there")); // no user may create files there
}

} // namespace
} // namespace quasilux
