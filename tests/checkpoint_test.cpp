// A render that goes on from its checkpoint is the render that was never interrupted, to the bit; a checkpoint that is
// not what was written is refused; passes of several are the passes of one (docs/reference/reliability.md).
#include "support/folder_files.h"
#include "support/lit_plate.h"
#include "support/meter_scenes.h"
#include "support/program_runner.h"
#include "support/render_statistics.h"

#include "cli/checkpoints.h"
#include "device/device.h"
#include "learn/learned_state.h"
#include "output/checkpoint_json.h"
#include "output/merge_checkpoints.h"
#include "util/error.h"

#include <cerrno>
#include <cmath>
#include <csignal>
#include <fstream>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/resource.h>
#include <system_error>

namespace quasilux {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

Device& device() {
    static Device only(0);
    return only;
}

class CheckpointTest : public testing::Test {
protected:
    std::string path(const std::string& name) const { return (folder.path() / name).string(); }
    std::vector<std::string> files() const { return test::namesIn(folder.path()); }
    Scene litPlate(unsigned film, const std::string& reflectance = "0.5") const {
        std::ofstream(path("scene.xml")) << test::litPlate(film, reflectance);
        return loadScene(path("scene.xml"));
    }

    TemporaryFolder folder;
};

void renderFrom(Renderer& renderer, unsigned first, unsigned end) {
    for (unsigned pass = first; pass < end; ++pass) renderer.renderPass(pass);
}

Checkpoint stateOf(const RenderSettings& settings, const Renderer& renderer, unsigned first) {
    Checkpoint checkpoint;
    checkpoint.version = QUASILUX_VERSION;
    checkpoint.kernels = kernelChecksum();
    checkpoint.wanted = checkpoint.settings = settings;
    checkpoint.sceneChecksums = renderer.report().checksums;
    const auto film = renderer.filmShape();
    checkpoint.width = film.width;
    checkpoint.height = film.height;
    checkpoint.film = film.layout;
    checkpoint.counters = renderer.counters();
    checkpoint.stop.firstPass = first;
    if (renderer.nextPass() > first) checkpoint.passes = {{first, renderer.nextPass()}};
    return checkpoint;
}

/// Passes `first` to `end` - 1 by another process, as it were, that leaves them at `file`.
void renderPart(const std::string& file, const Scene& scene, const RenderSettings& settings, unsigned first,
                unsigned end) {
    Renderer renderer(device(), scene, settings);
    renderFrom(renderer, first, end);
    writeCheckpoint(file, stateOf(settings, renderer, first), renderer);
}

std::unique_ptr<Renderer> restored(const std::string& file, const Scene& scene) {
    const CheckpointReader reader(file);
    const Checkpoint checkpoint = checkpointOf(reader);
    auto renderer = std::make_unique<Renderer>(device(), scene, checkpoint.settings,
                                               std::make_shared<const LearnedScene>(restoreLearned(reader)));
    renderer->restoreState(reader, checkpoint.counters, checkpoint.passes.empty() ? 0 : checkpoint.passes.back().end);
    return renderer;
}

std::vector<std::vector<float>> layersOf(const FilmImage& image) {
    std::vector<std::vector<float>> layers;
    const auto add = [&](const RadianceEstimate& of) {
        layers.insert(layers.end(), {of.radiance, of.standardError, of.bias, of.biasError});
    };
    add(image);
    for (const RadianceEstimate& component : image.components) add(component);
    return layers;
}

bool sameBits(const FilmImage& a, const FilmImage& b) {
    const auto of = layersOf(a), others = layersOf(b);
    for (size_t k = 0; k < of.size(); ++k)
        if (of[k].size() != others[k].size() ||
            std::memcmp(of[k].data(), others[k].data(), of[k].size() * sizeof(float)) != 0)
            return false;
    return a.passes == b.passes;
}

struct ResumeCase {
    std::string scene;
    std::vector<std::pair<std::string, std::string>> parameters;
    MapOrder map = MapOrder::photons;
    RadiusChoice radius = RadiusChoice::adaptive;
    Emission emission = Emission::guided;
};

// Photons are counted where they meet it.
Scene lampOverMeter() {
    return test::meterScene("<emitter type=\"point\"><point name=\"position\" x=\"1.5\" y=\"0\" z=\"3\"/>"
                            "<rgb name=\"intensity\" value=\"1000\"/></emitter><shape type=\"rectangle\">" +
                            test::diffuse(0.5) + test::irradiancemeter(2, 4) + "</shape>");
}

class Resume : public CheckpointTest, public testing::WithParamInterface<ResumeCase> {};

// After the first pass, within the choice of radii by pixel and after it, between batches of passes and within one.
TEST_P(Resume, GivesTheBitsOfARenderThatWentThrough) {
    const Scene scene =
        GetParam().scene == "meter" ? lampOverMeter() : projectScene(GetParam().scene, GetParam().parameters);
    RenderSettings settings;
    if (GetParam().scene == "meter") settings.direct = DirectLight::photons;
    settings.photonsPerPass = 2000;
    settings.map = GetParam().map;
    settings.radius = GetParam().radius;
    settings.emission = GetParam().emission;
    constexpr unsigned passes = 22;
    Renderer through(device(), scene, settings);
    renderFrom(through, 0, passes);
    const FilmImage whole = through.develop();
    for (const unsigned cut : {0u, 1u, 6u, 18u, 20u}) {
        renderPart(path("a.ckpt"), scene, settings, 0, cut);
        const auto renderer = restored(path("a.ckpt"), scene);
        EXPECT_EQ(renderer->nextPass(), cut);
        renderFrom(*renderer, cut, passes);
        EXPECT_TRUE(sameBits(renderer->develop(), whole)) << cut;
        auto counted = toJson(renderer->counters()), expected = toJson(through.counters());
        for (const char* seconds : {"prepareSeconds", "compileSeconds", "firstPassSeconds", "renderSeconds",
                                    "radiusSeconds", "storedBytes"}) {
            counted.erase(seconds);
            expected.erase(seconds);
        }
        EXPECT_EQ(counted, expected) << cut;
    }
    // Control: a pass of the wrong number is seen.
    const auto renderer = restored(path("a.ckpt"), scene);
    renderFrom(*renderer, 21, passes + 1);
    EXPECT_FALSE(sameBits(renderer->develop(), whole));
}

INSTANTIATE_TEST_SUITE_P(Renders, Resume,
                         testing::Values(ResumeCase{"cornell_phong.xml", {{"resolution", "24"}}},
                                         ResumeCase{"cornell_phong.xml",
                                                    {{"resolution", "24"}},
                                                    MapOrder::photons,
                                                    RadiusChoice::fixed,
                                                    Emission::plain},
                                         ResumeCase{"cornell_ggx.xml", {{"resolution", "24"}}, MapOrder::camera},
                                         ResumeCase{"fog_caustic.xml", {{"width", "16"}, {"height", "16"}}},
                                         ResumeCase{"meter", {}}));

// --- the file ---

class SmallCheckpoint : public CheckpointTest {
protected:
    SmallCheckpoint() {
        settings.photonsPerPass = 256;
        settings.radius = RadiusChoice::fixed;
        settings.emission = Emission::plain;
        renderPart(path("a.ckpt"), litPlate(2), settings, 0, 3);
    }
    RenderSettings settings;
};

// Each byte of all, then each length. None is taken for a checkpoint, but the one that was written.
TEST_F(SmallCheckpoint, EveryAlteredByteIsSeen) {
    const std::string file = path("a.ckpt"), good = readText(file);
    ASSERT_LT(good.size(), 100'000u);
    std::fstream stream(file, std::ios::binary | std::ios::in | std::ios::out);
    const auto put = [&](size_t at, char byte) {
        stream.seekp(static_cast<std::streamoff>(at));
        stream.put(byte);
        stream.flush();
    };
    size_t unseen = 0;
    for (size_t at = 0; at < good.size(); ++at) {
        put(at, static_cast<char>(good[at] ^ char(1 << at % 8)));
        if (!refusal([&] { checkpointOf(CheckpointReader(file)); })) ++unseen;
        put(at, good[at]);
    }
    EXPECT_EQ(unseen, 0u);
    EXPECT_EQ(checkpointOf(CheckpointReader(file)).counters.passes, 3u); // control
    for (size_t length = good.size(); length-- > 0;) {
        fs::resize_file(file, length);
        if (!refusal([&] { checkpointOf(CheckpointReader(file)); })) ++unseen;
    }
    EXPECT_EQ(unseen, 0u);
    std::ofstream(file, std::ios::binary) << good << 'x';
    EXPECT_THROW(CheckpointReader{file}, InputError);
}

TEST_F(SmallCheckpoint, WhatIsWrongIsNamed) {
    const auto message = [](const std::string& file) {
        return refusal([&] { checkpointOf(CheckpointReader(file)); }).value_or("");
    };
    EXPECT_THAT(message(path("none.ckpt")), HasSubstr("cannot be read (No such file or directory)"));
    std::ofstream(path("text.ckpt")) << "a text that is long enough to hold the bytes that a checkpoint ends with";
    EXPECT_THAT(message(path("text.ckpt")), HasSubstr("is no checkpoint"));
    renderPart(path("a.ckpt"), litPlate(2), settings, 0, 4);
    fs::resize_file(path("a.ckpt"), 1000);
    EXPECT_THAT(message(path("a.ckpt")), testing::AllOf(HasSubstr("its checksum is wrong"),
                                                        HasSubstr("the one before it is " + path("a.ckpt.previous"))));
    EXPECT_EQ(checkpointOf(CheckpointReader(path("a.ckpt.previous"))).counters.passes, 3u);
}

// What another version writes has a checksum that is right.
TEST_F(SmallCheckpoint, OtherVersionsAreRefused) {
    const CheckpointReader reader(path("a.ckpt"));
    for (const char* key : {"version", "kernels"}) {
        auto description = reader.description();
        description[key] = "other";
        CheckpointWriter writer(path("b.ckpt"));
        writer.finish(description);
        EXPECT_THAT(refusal([&] { checkpointOf(CheckpointReader(path("b.ckpt"))); }).value_or(""),
                    HasSubstr("of another version of quasilux"));
    }
}

// As far as a limit on files is like a disk that is full: at 50 lengths, all below that of the next checkpoint.
// (Seconds are written in as many digits as they have, so two checkpoints differ in length by some bytes; the next one
// is held fixed.)
TEST_F(SmallCheckpoint, FullDiskKeepsTheLastGoodOne) {
    const std::string good = readText(path("a.ckpt"));
    const Scene scene = litPlate(2);
    Renderer renderer(device(), scene, settings);
    renderFrom(renderer, 0, 5);
    const Checkpoint next = stateOf(settings, renderer, 0);
    writeCheckpoint(path("next.ckpt"), next, renderer);
    const rlim_t length = fs::file_size(path("next.ckpt"));
    fs::remove(path("next.ckpt"));
    rlimit before{};
    getrlimit(RLIMIT_FSIZE, &before);
    std::signal(SIGXFSZ, SIG_IGN);
    for (unsigned k = 0; k < 50; ++k) {
        const rlimit full{k * (length - 1) / 49, before.rlim_max};
        setrlimit(RLIMIT_FSIZE, &full);
        int why = 0;
        try {
            writeCheckpoint(path("a.ckpt"), next, renderer);
        } catch (const std::system_error& error) {
            why = error.code().value();
        }
        setrlimit(RLIMIT_FSIZE, &before);
        EXPECT_EQ(why, EFBIG) << full.rlim_cur;
        EXPECT_EQ(readText(path("a.ckpt")), good);
        EXPECT_THAT(files(), testing::UnorderedElementsAre("a.ckpt", "scene.xml"));
    }
    writeCheckpoint(path("a.ckpt"), next, renderer); // control: without the limit
    EXPECT_EQ(checkpointOf(CheckpointReader(path("a.ckpt"))).counters.passes, 5u);
    EXPECT_EQ(readText(path("a.ckpt.previous")), good);
}

TEST_F(SmallCheckpoint, TellsScenesApart) {
    const auto checksums = [&](const Scene& scene) { return Renderer(device(), scene, settings).report().checksums; };
    const auto first = checksums(litPlate(2));
    EXPECT_EQ(checksums(litPlate(2)), first);
    const auto otherPlate = checksums(litPlate(2, "0.50001")), otherFilm = checksums(litPlate(3));
    EXPECT_NE(otherPlate, first);
    EXPECT_EQ(otherPlate.at("geometry"), first.at("geometry"));
    EXPECT_NE(otherFilm, first);
}

// --- passes of several ---

// One unit in the last place, as sums are rounded when they are added in another order.
void expectSameMeans(const std::vector<float>& a, const std::vector<float>& b, double tolerance) {
    ASSERT_EQ(a.size(), b.size());
    size_t apart = 0;
    for (size_t k = 0; k < a.size(); ++k) apart += std::abs(a[k] - b[k]) > tolerance * std::abs(b[k]) ? 1 : 0;
    EXPECT_EQ(apart, 0u);
}

// Who is to go on from it has to know.
TEST(CheckpointKeeper, SaysQuietlyTooThatNoneIsWritten) {
    RenderOptions options;
    options.checkpoint = "none.ckpt";
    options.quiet = true;
    const SceneReport report;
    const RenderCounters counters;
    const PassesSoFar passes{report, counters, {}, 0, {}, {}};
    AutoRender soFar;
    soFar.search.interrupted = true;
    const auto said = [&](bool isLast) {
        testing::internal::CaptureStderr();
        CheckpointKeeper(options, device(), {}, {}).afterPasses(soFar, passes, 0, isLast);
        return testing::internal::GetCapturedStderr();
    };
    EXPECT_THAT(said(true), HasSubstr("warning: no checkpoint is written: the render was interrupted"));
    EXPECT_EQ(said(false), "");
    options.checkpoint = ""; // nobody asks
    EXPECT_EQ(said(true), "");
}

class Merge : public CheckpointTest {
protected:
    Merge() : scene(projectScene("cornell_phong.xml", {{"resolution", "16"}})) { settings.photonsPerPass = 2000; }
    std::string part(unsigned first, unsigned end) {
        const std::string file = path(std::to_string(first) + "-" + std::to_string(end) + ".ckpt");
        if (!fs::exists(file)) renderPart(file, scene, settings, first, end);
        return file;
    }
    FilmImage through(unsigned first, unsigned end) {
        Renderer renderer(device(), scene, settings);
        renderFrom(renderer, first, end);
        return renderer.develop();
    }
    std::string refused(const std::vector<std::string>& parts) {
        return refusal([&] { MergedPasses{parts}; }).value_or("");
    }
    Scene scene;
    RenderSettings settings;
};

TEST_F(Merge, PartsAreTheWhole) {
    const std::vector<std::string> parts{part(0, 7), part(7, 20), part(20, 32)};
    const MergedPasses merged(parts);
    EXPECT_EQ(text(merged.checkpoint().passes), "0 to 31");
    const FilmImage whole = through(0, 32), image = merged.develop();
    EXPECT_EQ(image.passes, 32u);
    constexpr double unit = 1.2e-7;
    expectSameMeans(image.radiance, whole.radiance, unit);
    for (size_t k = 0; k < whole.components.size(); ++k)
        expectSameMeans(image.components[k].radiance, whole.components[k].radiance, unit);
    // Batches are cut where those of one render are, so errors are the same but for rounding: of differences, and of
    // sums in 24 bits.
    expectSameMeans(image.standardError, whole.standardError, 1e-5);
    expectSameMeans(image.biasError, whole.biasError, 1e-4);
    for (size_t k = 0; k < whole.bias.size(); ++k) // it may be near 0
        EXPECT_NEAR(image.bias[k], whole.bias[k], 1e-5f * std::abs(whole.radiance[k]) + 1e-7f) << "value " << k;
    // Control: without one part.
    EXPECT_NE(MergedPasses({parts[0], parts[2]}).develop().radiance, whole.radiance);
    EXPECT_EQ(text(MergedPasses({parts[2], parts[0]}).checkpoint().passes), "0 to 6, 20 to 31");
}

TEST_F(Merge, OrderDoesNotMatter) {
    const FilmImage image = MergedPasses({part(0, 7), part(7, 20), part(20, 32)}).develop();
    EXPECT_TRUE(sameBits(MergedPasses({part(20, 32), part(0, 7), part(7, 20)}).develop(), image));
}

// Also where it is cut within a batch: the estimate of noise has batches of other lengths, but the image is the same.
TEST_F(Merge, CutsWithinABatchAreTheWhole) {
    const FilmImage image = MergedPasses({part(0, 18), part(18, 29), part(29, 32)}).develop(), whole = through(0, 32);
    expectSameMeans(image.radiance, whole.radiance, 1.2e-7);
    double sum = 0, expected = 0;
    for (size_t k = 0; k < whole.standardError.size(); ++k) {
        sum += image.standardError[k] * image.standardError[k];
        expected += whole.standardError[k] * whole.standardError[k];
    }
    EXPECT_NEAR(sum / expected, 1, 0.1); // two of 20 batches are cut
}

// In two steps; and what is merged can go on.
TEST_F(Merge, MergedCheckpointsAreCheckpoints) {
    MergedPasses({part(0, 7), part(7, 20)}).write(path("first.ckpt"));
    const MergedPasses merged({path("first.ckpt"), part(20, 32)});
    expectSameMeans(merged.develop().radiance, through(0, 32).radiance, 1.2e-7);
    merged.write(path("all.ckpt"));
    const auto renderer = restored(path("all.ckpt"), scene);
    renderFrom(*renderer, 32, 36);
    expectSameMeans(renderer->develop().radiance, through(0, 36).radiance, 1.2e-7);
    EXPECT_EQ(renderer->counters().passes, 36u);
}

TEST_F(Merge, RefusesWhatIsNoOtherPassOfTheSameImage) {
    EXPECT_THAT(refused({part(0, 7), part(5, 9)}), HasSubstr("both have passes 5 to 6"));
    EXPECT_THAT(refused({part(0, 7), part(7, 20), part(0, 7)}), HasSubstr("both have passes 0 to 6"));
    const std::string file = part(0, 7);
    fs::remove(path("7-20.ckpt"));
    settings.seed = 2;
    EXPECT_THAT(refused({file, part(7, 20)}), HasSubstr("seed is 2 there, 1 here"));
    settings.seed = 1;
    fs::remove(path("7-20.ckpt"));
    scene = projectScene("cornell_phong.xml", {{"resolution", "17"}});
    EXPECT_THAT(refused({file, part(7, 20)}), HasSubstr("17 x 17 pixels"));
    renderPart(path("none.ckpt"), scene, settings, 0, 0);
    EXPECT_THAT(refused({path("none.ckpt")}), HasSubstr("it has no pass yet"));
}

} // namespace
} // namespace quasilux
