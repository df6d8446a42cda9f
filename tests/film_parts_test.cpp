// Films that take several buffers, and films that keep less: the image has the same bits.
//
// Nothing here is left to chance: renders have fixed seeds.
#include "learn/learning.h"
#include "render/renderer.h"
#include "support/render_statistics.h"
#include "support/test_kernels.h"

#include <gtest/gtest.h>
#include <map>

namespace quasilux {
namespace {

constexpr unsigned passes = 6; // one batch of errors, and radii by pixel have been chosen once

/// Keeps what is saved.
struct Memory : StateSink, StateSource {
    std::map<std::string, std::vector<char>> arrays;
    std::vector<char>* open = nullptr;

    void begin(const std::string& name) override { open = &arrays[name]; }
    void write(const void* data, size_t bytes) override {
        const auto* from = static_cast<const char*>(data);
        open->insert(open->end(), from, from + bytes);
    }
    bool has(const std::string& name) const override { return arrays.count(name) > 0; }
    uint64_t bytes(const std::string& name) const override { return arrays.at(name).size(); }
    void read(const std::string& name, uint64_t first, void* data, size_t bytes) const override {
        std::copy_n(arrays.at(name).data() + first, bytes, static_cast<char*>(data));
    }
};

/// One that allows less in a buffer than the film takes.
Device& smallDevice() {
    static Device device(-1, testDevice().workGroupSize(), 0, 0, 10'000'000);
    return device;
}

RenderSettings settingsOf(FilmLayout film) {
    RenderSettings settings = settingsFromScene(projectScene("cornell_phong.xml"));
    settings.photonsPerPass = 20'000;
    settings.film = film;
    return settings;
}

struct Rendered {
    FilmImage image;
    size_t buffers = 0; ///< of the film
    Memory state;
    uint64_t sampleBytes = 0; ///< of the buffer of samples that pixels share
};

RenderCounters countersAfter(unsigned rendered) {
    RenderCounters counters;
    counters.passes = rendered;
    return counters;
}

/// With a filter in which pixels share samples.
Scene smoothScene() {
    Scene scene = projectScene("cornell_phong.xml");
    scene.sensor.filter = FILTER_TABLE;
    scene.sensor.filterRadius = 1.7;
    scene.sensor.filterShape = [](double x) { return 1.7 - x; };
    return scene;
}

Rendered render(Device& device, FilmLayout film, uint64_t seed = 1, const Memory* from = nullptr,
                const Scene& scene = projectScene("cornell_phong.xml")) {
    RenderSettings settings = settingsOf(film);
    settings.seed = seed;
    Renderer renderer(device, scene, settings);
    if (from)
        renderer.restoreState(*from, countersAfter(passes), passes);
    else
        for (unsigned pass = 0; pass < passes; ++pass) renderer.renderPass(pass);
    Rendered rendered{renderer.develop(), 0, {}, 0};
    renderer.saveState(rendered.state);
    for (const auto& [label, bytes] : renderer.report().bufferBytes) {
        rendered.buffers += label.compare(0, 4, "film") == 0;
        if (label == "samples") rendered.sampleBytes = bytes;
    }
    return rendered;
}

const Rendered& usual() {
    static const Rendered rendered = render(testDevice(), {});
    return rendered;
}

TEST(FilmParts, HaveTheSameBits) {
    const Rendered parts = render(smallDevice(), {});
    EXPECT_EQ(usual().buffers, 1u);
    EXPECT_GT(parts.buffers, 2u);
    EXPECT_EQ(parts.image.radiance, usual().image.radiance);
    EXPECT_EQ(parts.image.standardError, usual().image.standardError);
    EXPECT_EQ(parts.image.bias, usual().image.bias);
    EXPECT_EQ(parts.image.components, usual().image.components);
    EXPECT_NE(render(smallDevice(), {}, 2).image.radiance, usual().image.radiance) << "negative control: another seed";
}

// They are traced in bands of rows where the device allows little in a buffer.
TEST(FilmParts, OfSharedSamplesHaveTheSameBits) {
    const Rendered whole = render(testDevice(), {}, 1, nullptr, smoothScene()),
                   parts = render(smallDevice(), {}, 1, nullptr, smoothScene());
    EXPECT_GT(whole.sampleBytes, 2 * parts.sampleBytes);
    EXPECT_EQ(parts.image.radiance, whole.image.radiance);
    EXPECT_EQ(parts.image.standardError, whole.image.standardError);
    EXPECT_NE(whole.image.radiance, usual().image.radiance) << "negative control: another filter";
}

// From pass 16 on, two passes of four estimate the bias. Of a range that has none of these, or those of one batch
// alone, the bias is not known, rather than 0.
TEST(FilmBias, OfFewLatePassesIsNotKnown) {
    const auto hasBias = [](unsigned first, unsigned last) {
        Renderer renderer(testDevice(), projectScene("cornell_phong.xml"), settingsOf({}));
        for (unsigned pass = first; pass < last; ++pass) renderer.renderPass(pass);
        const FilmImage image = renderer.develop();
        EXPECT_EQ(image.bias.empty(), image.biasError.empty());
        EXPECT_EQ(image.bias.empty(), image.components[LIGHT_DIFFUSE].bias.empty());
        return !image.bias.empty();
    };
    EXPECT_FALSE(hasBias(19, 21));
    EXPECT_FALSE(hasBias(16, 21));
    EXPECT_TRUE(hasBias(16, 24));
    EXPECT_TRUE(hasBias(0, 2));
}

TEST(FilmParts, AreSavedAsOne) {
    const Rendered parts = render(smallDevice(), {}, 1, &usual().state);
    EXPECT_EQ(parts.image.radiance, usual().image.radiance);
    EXPECT_EQ(parts.state.arrays.at("film"), usual().state.arrays.at("film"));
    EXPECT_EQ(render(testDevice(), {}, 1, &parts.state).image.standardError, usual().image.standardError);
}

TEST(FilmLayout, KeepsLessOfTheSameImage) {
    for (const FilmLayout film : {FilmLayout{false, true}, FilmLayout{true, false}, FilmLayout{false, false}}) {
        const Rendered less = render(testDevice(), film);
        EXPECT_EQ(less.image.radiance, usual().image.radiance);
        EXPECT_EQ(less.image.standardError, usual().image.standardError);
        EXPECT_EQ(less.image.bias, film.bias ? usual().image.bias : std::vector<float>());
        EXPECT_EQ(less.image.hasComponents(), film.components);
        EXPECT_LT(less.state.arrays.at("film").size(), usual().state.arrays.at("film").size());
    }
    EXPECT_EQ((FilmLayout{false, false}.floatsPerPixel()), 15u) << "4K in 500 MB";
}

} // namespace
} // namespace quasilux
