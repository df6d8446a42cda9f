// Media in balance with a uniform sky (scenes/furnace_medium.xml): radiance 1 outside and n^2 within, whatever
// scatters; Beer's law; and paths of very many collisions.
//
// A right render passes within 0.5 % or 3 standard errors (from 20 batches: two-sided Student t, 0.7 % a case); the
// seeds are fixed. A render with a standard error above 1.5 % decides nothing and fails.
#include "support/render_statistics.h"
#include "support/scene_files.h"
#include "support/shared_features.h"
#include "support/test_kernels.h"
#include "support/wrong_rules.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <gtest/gtest.h>

namespace quasilux {
namespace {

using test::MediumRule;

constexpr unsigned batches = 20;
constexpr double glassRadiance = 1.5 * 1.5;

using Parameters = std::vector<std::pair<std::string, std::string>>;

struct Case {
    const char* name;
    Parameters parameters;
    std::string split;
    double radiance; ///< that the camera must see
    unsigned passes; ///< per batch
    Variant variant = Variant::main;
    unsigned bdd = 0;
    MediumRule rule = MediumRule::right;
    DirectLight direct = DirectLight::emitters;
    unsigned photons = 20000;
};

void PrintTo(const Case& c, std::ostream* stream) { *stream << c.name; }

MeanAndError measure(const Case& c) {
    const Scene scene = projectScene("furnace_medium.xml", c.parameters);
    RenderSettings settings;
    settings.quasiSpecular = c.split;
    settings.quasiSpecularOverridesScene = true;
    settings.variant = c.variant;
    settings.bdd = c.bdd;
    settings.controlOptions += optionOf(c.rule);
    settings.direct = c.direct;
    settings.furtherFeatures = test::mediumFeatures();
    settings.photonsPerPass = c.photons;
    const std::vector<int> group(size_t(scene.sensor.width) * scene.sensor.height, 0);
    return renderGroups(scene, settings, group, batches, c.passes).front();
}

double allowed(const Case& c, const MeanAndError& result) {
    return std::max(0.005 * c.radiance, 3 * result.standardError);
}

class MediumFurnace : public testing::TestWithParam<Case> {};
TEST_P(MediumFurnace, IsInBalance) {
    const Case& c = GetParam();
    const auto result = measure(c);
    EXPECT_NEAR(result.mean, c.radiance, allowed(c, result)) << "standard error " << result.standardError;
    EXPECT_LT(result.standardError, 0.015 * c.radiance) << "too noisy to decide anything";
}

const Parameters inside = {{"border", "glass"}, {"eye", "0,0,0.3"}, {"fov", "60"}};

INSTANTIATE_TEST_SUITE_P(
    Render, MediumFurnace,
    testing::Values(
        Case{"Fog", {}, "level:0.1", 1, 5}, //
        Case{"FogWhole", {}, "all", 1, 15, Variant::alternative},
        Case{"FogStandard", {}, "none", 1, 15, Variant::main, 1},
        Case{"FogDirectPhotons", {}, "level:0.1", 1, 10, Variant::main, 0, MediumRule::right, DirectLight::photons},
        Case{"Rayleigh", {{"phase", "rayleigh"}}, "level:0.1", 1, 5},
        Case{"Isotropic", {{"phase", "isotropic"}}, "none", 1, 5, Variant::main, 2},
        Case{"Coloured", {{"sigma_t", "1,4,0.5"}}, "level:0.1", 1, 13},
        Case{"OneClearChannel", {{"sigma_t", "0,2,1"}, {"phase", "isotropic"}}, "level:0.05", 1, 30},
        Case{"Glass", {{"border", "glass"}}, "level:0.1", 1, 5},
        Case{"WithinGlass", inside, "level:0.1", glassRadiance, 10},
        Case{"WithinGlassAlternative", inside, "level:0.1", glassRadiance, 7, Variant::alternative}),
    [](const auto& tested) { return tested.param.name; });

// Negative controls: known mistakes must be seen.
class WrongMediumFurnace : public testing::TestWithParam<Case> {};
TEST_P(WrongMediumFurnace, IsNotInBalance) {
    const Case& c = GetParam();
    const auto result = measure(c);
    EXPECT_GT(std::abs(result.mean - c.radiance), allowed(c, result)) << result.mean << " looks right";
}
INSTANTIATE_TEST_SUITE_P(
    Render, WrongMediumFurnace,
    testing::Values(Case{"MissingSigmaT", {}, "level:0.1", 1, 5, Variant::main, 0, MediumRule::missingSigmaT},
                    Case{"MissingEtaSquared",
                         {{"border", "glass"}},
                         "level:0.1",
                         1,
                         5,
                         Variant::main,
                         0,
                         MediumRule::missingEtaSquared}),
    [](const auto& tested) { return tested.param.name; });

// Optical depth 200 through glass: a photon collides some 2 n^2 tau = 900 times on average, the longest paths over 10^4
// times. None is cut, and what gets out balances what came in.
TEST(MediumRender, LosesNothingOfPathsOfManyCollisions) {
    const Scene scene =
        projectScene("furnace_medium.xml",
                     {{"border", "glass"}, {"sigma_t", "100,100,100"}, {"phase", "isotropic"}, {"resolution", "4"}});
    RenderSettings settings;
    settings.quasiSpecular = "all"; // camera paths follow every collision
    settings.quasiSpecularOverridesScene = true;
    settings.furtherFeatures = test::mediumFeatures();
    settings.photonsPerPass = 3000;
    const auto result = renderGroups(scene, settings, std::vector<int>(16, 0), batches, 3).front();
    EXPECT_NEAR(result.mean, 1, std::max(0.005, 3 * result.standardError));
    EXPECT_LT(result.standardError, 0.1);

    Renderer renderer(testDevice(), scene, settings);
    renderer.renderPass(0);
    EXPECT_EQ(renderer.counters().cutPaths, 0u);
    EXPECT_EQ(renderer.counters().nonFinite, 0u);
    const auto stored = renderer.counters().photonsStored;
    EXPECT_GT(stored.at("volume caustic") + stored.at("volume quasi_caustic"), 0u);
}

// Light through an absorbing medium, by channel: emission seen through it, and a floor that a lamp lights through it.
TEST(MediumRender, AbsorbsByBeersLaw) {
    test::SceneFiles files;
    const std::string path = files.write("beer.xml", R"(<scene version="3.0.0">
    <sensor type="orthographic">
        <transform name="to_world"><scale x="0.1" y="0.1"/><lookat origin="0,0,5" target="0,0,0" up="0,1,0"/></transform>
        <film type="hdrfilm"><integer name="width" value="32"/><integer name="height" value="32"/><rfilter type="box"/></film>
    </sensor>
    <shape type="cube">
        <transform name="to_world"><scale x="3" y="3" z="0.5"/><translate z="2"/></transform>
        <bsdf type="null"/>
        <medium name="interior" type="homogeneous"><rgb name="sigma_t" value="0.5,1,2"/><float name="albedo" value="0"/></medium>
    </shape>
    <shape type="rectangle"><transform name="to_world"><scale value="3"/></transform>
        <bsdf type="diffuse"><rgb name="reflectance" value="0.5"/></bsdf>
        <emitter type="area"><rgb name="radiance" value="1"/></emitter>
    </shape>
    <emitter type="point"><point name="position" x="0" y="0" z="3"/><rgb name="intensity" value="9"/></emitter>
</scene>)");
    RenderSettings settings;
    settings.photonsPerPass = 64; // no light comes by photons: the slab only absorbs, and the floor is alone
    Renderer renderer(testDevice(), loadScene(path), settings);
    constexpr unsigned passes = 64, pixels = 32 * 32;
    for (unsigned pass = 0; pass < passes; ++pass) renderer.renderPass(pass);
    const FilmImage image = renderer.develop();
    // The point stands 3 above the floor: irradiance 9 / 9 through the slab, reflected with 0.5 / pi.
    const double sigma[3] = {0.5, 1, 2};
    for (size_t channel = 0; channel < 3; ++channel) {
        double mean = 0, variance = 0;
        for (size_t pixel = 0; pixel < pixels; ++pixel) {
            mean += image.radiance[3 * pixel + channel] / pixels;
            variance += std::pow(image.standardError[3 * pixel + channel] / pixels, 2);
        }
        const double transmitted = std::exp(-sigma[channel]);
        const double expected = transmitted * (1 + transmitted * 0.5 / 3.141592653589793);
        // Pixels are independent here. The view is 0.1 wide: cosines and distances differ by less than 0.2 %.
        EXPECT_NEAR(mean, expected, 3.5 * std::sqrt(variance) + 2e-3 * expected) << channel; // false alarm 5e-4
        EXPECT_LT(std::sqrt(variance), 0.02 * expected);
    }
}

// Also where the medium's boundary is known to be further away: what survives up to the plane sees the sky.
TEST(MediumRender, FlightsEndAtTheFarClippingPlane) {
    test::SceneFiles files;
    const Scene scene = loadScene(files.write("clip.xml", R"(<scene version="3.0.0">
    <sensor type="orthographic"><float name="near_clip" value="0.001"/><float name="far_clip" value="1"/>
        <transform name="to_world"><scale x="0.1" y="0.1"/><lookat origin="0,0,1" target="0,0,0" up="0,1,0"/></transform>
        <film type="hdrfilm"><integer name="width" value="32"/><integer name="height" value="32"/><rfilter type="box"/></film>
    </sensor>
    <shape type="cube"><transform name="to_world"><scale value="3"/></transform><bsdf type="null"/>
        <medium name="interior" type="homogeneous"><float name="sigma_t" value="1"/><float name="albedo" value="0"/></medium>
    </shape>
    <emitter type="constant"/></scene>)"));
    RenderSettings settings;
    settings.photonsPerPass = 64;
    const std::vector<int> group(size_t{32} * 32, 0);
    const auto result = renderGroups(scene, settings, group, batches, 4).front();
    EXPECT_NEAR(result.mean, std::exp(-1.0), 3 * result.standardError + 0.002);
    EXPECT_LT(result.standardError, 0.01);
}

// A pool whose surface alone says what fills it: nothing tells its depth, from which photons' kernels follow. White
// walls and water under a white sky are white. The surface lies in a plane through the origin: it goes round a volume
// of 0.
TEST(MediumRender, OpenSurfacesBoundMedia) {
    const test::SceneFiles files;
    const auto wall = [](const char* transform) {
        return fmt::format(
            "<shape type=\"rectangle\"><transform name=\"to_world\">{}</transform><ref id=\"white\"/></shape>",
            transform);
    };
    const Scene scene = loadScene(files.write(
        "pool.xml", R"(<scene version="3.0.0">
    <sensor type="perspective"><float name="fov" value="20"/><transform name="to_world">
        <lookat origin="0,0,3" target="0,0,0" up="0,1,0"/></transform>
        <film type="hdrfilm"><integer name="width" value="8"/><integer name="height" value="8"/></film></sensor>
    <emitter type="constant"/>
    <bsdf type="twosided" id="white"><bsdf type="diffuse"><rgb name="reflectance" value="1"/></bsdf></bsdf>
    <shape type="rectangle"><bsdf type="null"/><medium name="interior" type="homogeneous">
        <float name="sigma_t" value="1"/><float name="albedo" value="1"/></medium></shape>)" +
                        wall("<translate z=\"-1\"/>") + wall("<rotate y=\"1\" angle=\"90\"/><translate x=\"1\"/>") +
                        wall("<rotate y=\"1\" angle=\"90\"/><translate x=\"-1\"/>") +
                        wall("<rotate x=\"1\" angle=\"90\"/><translate y=\"1\"/>") +
                        wall("<rotate x=\"1\" angle=\"90\"/><translate y=\"-1\"/>") + "</scene>"));
    RenderSettings settings;
    settings.photonsPerPass = 5000;
    const auto result = renderGroups(scene, settings, std::vector<int>(64, 0), batches, 10).front();
    EXPECT_NEAR(result.mean, 1, 3 * result.standardError + 0.01) << "1 % for the finite kernel";
    EXPECT_LT(result.standardError, 0.02);
}

// Fog without a border, which nothing but the camera says it stands in: single scattering of a point's light, closed
// form sigma / (4 pi) integral of exp(-sigma (t + d)) / d^2 along the ray, d the distance to the point. A black ball
// aside, which says that it stands in the fog, changes nothing.
TEST(MediumRender, FogThatTheCameraStatesScatters) {
    const test::SceneFiles files;
    const Scene scene = loadScene(files.write("fog.xml", R"(<scene version="3.0.0">
    <medium id="fog" type="homogeneous"><float name="sigma_t" value="0.1"/><float name="albedo" value="1"/></medium>
    <shape type="sphere"><point name="center" x="50" y="0" z="0"/><float name="radius" value="0.1"/><bsdf type="diffuse">
        <rgb name="reflectance" value="0"/></bsdf><ref name="exterior" id="fog"/></shape>
    <integrator type="volpath"><integer name="max_depth" value="2"/></integrator>
    <sensor type="perspective"><float name="fov" value="0.1"/>
        <transform name="to_world"><lookat origin="0,0,0" target="0,0,1" up="0,1,0"/></transform>
        <ref name="medium" id="fog"/>
        <film type="hdrfilm"><integer name="width" value="16"/><integer name="height" value="16"/><rfilter type="box"/></film></sensor>
    <emitter type="point"><point name="position" x="0" y="2" z="0"/><rgb name="intensity" value="1"/></emitter></scene>)"));
    constexpr double sigma = 0.1, step = 1e-3, near = 0.01; // of near_clip, before which no fog is seen
    double expected = 0;
    for (double t = near + 0.5 * step; t < 100; t += step) {
        const double d = std::sqrt(t * t + 4);
        expected += sigma / (4 * 3.141592653589793) * std::exp(-sigma * (t - near + d)) / (d * d) * step;
    }
    RenderSettings settings;
    settings.photonsPerPass = 64;
    const auto result = renderGroups(scene, settings, std::vector<int>(256, 0), batches, 20).front();
    EXPECT_NEAR(result.mean, expected, 3 * result.standardError);
    EXPECT_LT(result.standardError, 0.02 * expected);
}

/// What fog that absorbs little sends back to one who looks away from a shining ball, which does not say what it stands
/// in; by 8 x 8 pixels.
MeanAndError fogOver(const char* border, const char* split, Variant variant, unsigned passes,
                     MediumRule rule = MediumRule::right) {
    const test::SceneFiles files;
    const Scene scene = loadScene(files.write("fog.xml", fmt::format(R"(<scene version="3.0.0">
    <medium id="fog" type="homogeneous"><float name="sigma_t" value="1"/><float name="albedo" value="0.95"/></medium>
    <integrator type="volpath"/>
    <sensor type="perspective"><float name="fov" value="40"/>
        <transform name="to_world"><lookat origin="0,0,0.8" target="0,0,2" up="0,1,0"/></transform>
        <ref name="medium" id="fog"/>
        <film type="hdrfilm"><integer name="width" value="8"/><integer name="height" value="8"/><rfilter type="box"/></film></sensor>
    {}
    <shape type="sphere"><float name="radius" value="0.5"/>
        <emitter type="area"><rgb name="radiance" value="1"/></emitter></shape></scene>)",
                                                                     border)));
    RenderSettings settings;
    settings.quasiSpecular = split;
    settings.quasiSpecularOverridesScene = true;
    settings.variant = variant;
    settings.photonsPerPass = 20000;
    settings.radiusScale = 3;
    settings.controlOptions += optionOf(rule);
    return renderGroups(scene, settings, std::vector<int>(64, 0), batches, passes).front();
}

// Without a border roulette ends paths that go far outside. It changes nothing: a ball of the same fog, six diffusion
// lengths about the scene, looks the same, by camera paths that follow every collision and by photons.
TEST(MediumRender, FogWithoutABorderIsThatOfALargeBall) {
    const char* const ball = R"(<shape type="sphere"><float name="radius" value="16"/><bsdf type="null"/>
        <ref name="interior" id="fog"/></shape>)";
    const auto alike = [](const MeanAndError& a, const MeanAndError& b) {
        return std::abs(a.mean - b.mean) < 3 * std::hypot(a.standardError, b.standardError);
    };
    const MeanAndError bounded = fogOver(ball, "all", Variant::alternative, 20),
                       followed = fogOver("", "all", Variant::alternative, 20),
                       open = fogOver("", "none", Variant::main, 20),
                       wrong = fogOver("", "none", Variant::main, 20, MediumRule::lossOutside);
    EXPECT_TRUE(alike(followed, bounded)) << followed.mean << " is not " << bounded.mean;
    EXPECT_TRUE(alike(open, bounded)) << open.mean << " is not " << bounded.mean;
    EXPECT_FALSE(alike(wrong, bounded)) << wrong.mean << " looks right";
    for (const MeanAndError& known : {bounded, open, followed})
        EXPECT_LT(known.standardError, 0.015 * known.mean) << "too noisy to decide anything";
}

} // namespace
} // namespace quasilux
