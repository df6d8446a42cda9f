// The camera map is the photon map turned round: from the same seed both orders trace the same paths and make the same
// density estimates, so images agree but for rounding, in every feature of the law. Where they do not round alike: the
// camera map holds packed normals, directions of the camera and reaches of borders, the photon map packed directions of
// photons. A photon on the very border of a region may then count in one order only.
#include "support/render_statistics.h"
#include "support/scene_files.h"
#include "support/shared_features.h"
#include "support/test_kernels.h"
#include "support/wrong_rules.h"

#include <cmath>
#include <cstring>
#include <fmt/format.h>
#include <gtest/gtest.h>
#include <numeric>

namespace quasilux {
namespace {

using test::LawRule;

constexpr unsigned passes = 2;

struct Rendered {
    FilmImage image;
    RenderCounters counters;
};

Rendered render(const Scene& scene, RenderSettings settings, MapOrder map, unsigned workGroupSize = 64) {
    settings.map = map;
    settings.furtherFeatures = test::sharedFeatures(scene);
    Renderer renderer(testDevice(workGroupSize), scene, settings);
    for (unsigned pass = 0; pass < passes; ++pass) renderer.renderPass(pass);
    return {renderer.develop(), renderer.counters()};
}

/// Sum of absolute differences over the sum of `a`.
double difference(const std::vector<float>& a, const std::vector<float>& b) {
    double sum = 0, apart = 0;
    for (size_t k = 0; k < std::max(a.size(), b.size()); ++k) { // a component without light is empty
        const double x = a.empty() ? 0 : a[k], y = b.empty() ? 0 : b[k];
        sum += x;
        apart += std::abs(x - y);
    }
    return sum > 0 ? apart / sum : apart;
}

RenderSettings settingsOf(unsigned bdd, Variant variant, const std::string& quasiSpecular, DirectLight direct) {
    RenderSettings settings;
    settings.bdd = bdd;
    settings.variant = variant;
    settings.quasiSpecular = quasiSpecular;
    settings.quasiSpecularOverridesScene = true;
    settings.direct = direct;
    settings.photonsPerPass = 20'000;
    return settings;
}

Scene cornell() { return projectScene("cornell_phong.xml", {{"resolution", "24"}}); }

/// So thick that photons are thinned.
Scene thickSlab() {
    return projectScene("slab.xml", {{"sigma_t", "7.5"}, {"albedo", "1"}, {"g", "0.6"}, {"resolution", "12"}});
}

Scene thinSlab() {
    return projectScene("slab.xml", {{"sigma_t", "0.7"}, {"albedo", "0.9"}, {"g", "0.6"}, {"resolution", "24"}});
}

Scene fromXml(const std::string& shapes, const std::string& more = "") {
    test::SceneFiles files;
    return loadScene(files.write("scene.xml", fmt::format(R"(<scene version="3.0.0">{}
        <sensor type="perspective"><float name="fov" value="40"/>
        <transform name="to_world"><lookat origin="0,1.5,2.5" target="0,-0.4,0" up="0,1,0"/></transform>
        <film type="hdrfilm"><rfilter type="box"/><integer name="width" value="24"/>
        <integer name="height" value="24"/></film></sensor>
        <shape type="rectangle"><emitter type="area"><rgb name="radiance" value="2,1,0.5"/></emitter>
        <transform name="to_world"><scale value="0.5"/><rotate x="1" angle="90"/><translate y="1.2"/></transform></shape>
        <shape type="rectangle"><bsdf type="diffuse"><texture type="checkerboard" name="reflectance">
        <rgb name="color0" value="0.9,0.5,0.1"/><rgb name="color1" value="0.2,0.4,0.8"/>
        <transform name="to_uv"><scale x="4" y="4"/></transform></texture></bsdf>
        <transform name="to_world"><scale value="1.5"/><rotate x="1" angle="-90"/><translate y="-0.7"/></transform></shape>
        {}</scene>)",
                                                          more, shapes)));
}

std::string ball(const std::string& bsdf) {
    return R"(<shape type="sphere"><float name="radius" value="0.5"/>)" + bsdf + "</shape>";
}

Scene mirrorBall() { return fromXml(ball(R"(<bsdf type="conductor"><string name="material" value="none"/></bsdf>)")); }
Scene glossyBall() {
    return fromXml(ball(R"(<bsdf type="phong" id="glossy"><float name="exponent" value="60"/>
        <rgb name="diffuse_reflectance" value="0.3"/><rgb name="specular_reflectance" value="0.6,0.3,0.2"/></bsdf>)"));
}
Scene shallowBall() {
    return fromXml(ball(R"(<bsdf type="roughconductor"><float name="alpha" value="0.2"/></bsdf>)"),
                   R"(<integrator type="path"><integer name="max_depth" value="4"/></integrator>)");
}
Scene roughGlassBall() {
    return fromXml(ball(R"(<bsdf type="roughdielectric"><float name="alpha" value="0.2"/>
        <texture type="checkerboard" name="specular_reflectance"><rgb name="color0" value="0.9"/>
        <rgb name="color1" value="0.3"/></texture>
        <texture type="checkerboard" name="specular_transmittance"><rgb name="color0" value="0.4"/>
        <rgb name="color1" value="0.8"/></texture></bsdf>)"));
}

struct Case {
    const char* name;
    Scene (*scene)();
    unsigned bdd;
    Variant variant;
    const char* quasiSpecular;
    DirectLight direct = DirectLight::emitters;
    bool genericKernels = false;
};

class MapOrders : public testing::TestWithParam<Case> {
protected:
    static RenderSettings settings() {
        const Case& c = GetParam();
        auto result = settingsOf(c.bdd, c.variant, c.quasiSpecular, c.direct);
        result.genericKernels = c.genericKernels;
        return result;
    }
};

constexpr double tolerance = 1e-4; // found: at most 4e-5, and 2e-4 of the standard error

TEST_P(MapOrders, Agree) {
    const Scene scene = GetParam().scene();
    const auto photons = render(scene, settings(), MapOrder::photons);
    const auto camera = render(scene, settings(), MapOrder::camera);

    ASSERT_FALSE(photons.counters.photonsStored.empty()) << "nothing was taken by density estimation";
    EXPECT_LT(difference(photons.image.radiance, camera.image.radiance), tolerance);
    EXPECT_LT(difference(photons.image.standardError, camera.image.standardError), 4 * tolerance);
    for (size_t k = 0; k < FILM_COMPONENTS; ++k)
        EXPECT_LT(difference(photons.image.components[k].radiance, camera.image.components[k].radiance), 4 * tolerance)
            << componentName(unsigned(k));
    EXPECT_TRUE(camera.counters.photonsStored.empty());
    EXPECT_FALSE(camera.counters.cameraPointsStored.empty());
    for (const RenderCounters& counters : {photons.counters, camera.counters})
        EXPECT_EQ(counters.nonFinite + counters.overflows + counters.clipped + counters.cutPaths, 0u);
    EXPECT_EQ(photons.counters.photonsEmitted, camera.counters.photonsEmitted);
}

constexpr auto byPhotons = DirectLight::photons;
constexpr auto mainVariant = Variant::main, alternative = Variant::alternative;
INSTANTIATE_TEST_SUITE_P(
    Features, MapOrders,
    testing::Values(Case{"Cornell", cornell, 0, mainVariant, "auto"},
                    Case{"CornellDirectPhotons", cornell, 1, mainVariant, "auto", byPhotons},
                    Case{"CornellAlternative", cornell, 1, alternative, "all", byPhotons},
                    Case{"CornellNone", cornell, 0, mainVariant, "none", byPhotons},
                    Case{"CornellGeneric", cornell, 0, mainVariant, "auto", byPhotons, true},
                    Case{"MirrorBall", mirrorBall, 0, mainVariant, "auto"},
                    Case{"GlossyBallStandard", glossyBall, 0, mainVariant, "none", byPhotons},
                    Case{"GlossyBall", glossyBall, 0, mainVariant, "glossy.specular", byPhotons},
                    Case{"DepthLimit", shallowBall, 1, mainVariant, "none", byPhotons},
                    Case{"RoughGlass", roughGlassBall, 0, mainVariant, "none", byPhotons},
                    Case{"RoughGlassQuasiSpecular", roughGlassBall, 1, mainVariant, "all", byPhotons},
                    Case{"SlabStandard", thinSlab, 0, mainVariant, "none"},
                    Case{"SlabQuasiSpecular", thinSlab, 0, mainVariant, "all"},
                    Case{"SlabAlternative", thinSlab, 0, alternative, "all"},
                    Case{"SlabLevel", thinSlab, 1, mainVariant, "level:0.1"},
                    Case{"ThickSlab", thickSlab, 0, mainVariant, "level:0.1"},
                    Case{"SlabGeneric", thinSlab, 0, mainVariant, "level:0.1", DirectLight::emitters, true}),
    [](const auto& row) { return std::string(row.param.name); });

// Negative control: a wrong reading of the law in one of them shows.
TEST(MapOrdersDiffer, UnderAWrongLaw) {
    for (const auto& scene : {cornell(), thinSlab()}) {
        const auto settings = settingsOf(1, mainVariant, "level:0.1", DirectLight::emitters);
        auto wrong = settings;
        wrong.controlOptions += optionOf(LawRule::diffuseAtEveryHit);
        EXPECT_GT(difference(render(scene, settings, MapOrder::photons).image.radiance,
                             render(scene, wrong, MapOrder::camera).image.radiance),
                  50 * tolerance);
    }
}

TEST(MapOrdersDiffer, WithAnotherSeed) {
    const auto settings = settingsOf(0, mainVariant, "auto", DirectLight::emitters);
    auto other = settings;
    other.seed = 2;
    EXPECT_GT(difference(render(cornell(), settings, MapOrder::photons).image.radiance,
                         render(cornell(), other, MapOrder::camera).image.radiance),
              50 * tolerance);
}

// Bits, not values: a NaN must show.
void expectSameBits(const std::vector<float>& a, const std::vector<float>& b) {
    EXPECT_TRUE(a.size() == b.size() && std::memcmp(a.data(), b.data(), a.size() * sizeof(float)) == 0);
}

TEST(CameraMap, GivesTheSameBitsWhateverTheScheduling) {
    for (const auto& scene : {cornell(), thinSlab()}) {
        const auto settings = settingsOf(1, mainVariant, "level:0.1", byPhotons);
        const auto expected = render(scene, settings, MapOrder::camera).image;
        for (const unsigned size : {64u, 1u, 7u, 256u}) {
            const auto image = render(scene, settings, MapOrder::camera, size).image;
            expectSameBits(expected.radiance, image.radiance);
            expectSameBits(expected.standardError, image.standardError);
            for (size_t k = 0; k < FILM_COMPONENTS; ++k)
                expectSameBits(expected.components[k].radiance, image.components[k].radiance);
        }
    }
}

// What the map takes: of a medium whose scattering is all quasi-specular the main variant takes light at the first
// collision of a path only, the alternative one at each.
TEST(CameraMap, HoldsOneVolumePointPerPathInTheMainVariant) {
    const auto points = [](Variant variant) {
        const auto settings = settingsOf(0, variant, "all", DirectLight::emitters);
        return render(thinSlab(), settings, MapOrder::camera).counters;
    };
    const auto main = points(Variant::main), other = points(Variant::alternative);
    const uint64_t paths = 24 * 24 * passes;
    EXPECT_LE(main.cameraPointsStored.at("volume caustic"), paths);
    EXPECT_GT(main.cameraPointsStored.at("volume caustic"), paths / 2);
    EXPECT_GT(other.cameraPointsStored.at("volume caustic"), 2 * main.cameraPointsStored.at("volume caustic"));
    EXPECT_GT(main.storedBytes, 0u);
}

} // namespace
} // namespace quasilux
