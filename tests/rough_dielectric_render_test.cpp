// Rough glass in the renderer, against closed forms: a sky of radiance 1 seen in one rough interface, which is the sum
// of the lobe's shares, and in a ball, which solves a linear equation (support/rough_interface.h). Photons, emitter
// sampling and sampled paths must all give it, and every split between quasi-specular and genuine diffuse.
//
// False alarms: within 3 standard errors (from 10 batches: two-sided Student t, 1.5 % a case) plus 0.5 % for the
// density radius; the seeds are fixed, so a case that passes goes on passing.
#include "bsdf/lobe_list.h"
#include "support/render_statistics.h"
#include "support/rough_interface.h"
#include "support/scene_files.h"
#include "support/shared_features.h"

#include <cmath>
#include <fmt/format.h>

namespace quasilux {
namespace {

constexpr unsigned resolution = 16, batches = 10;
constexpr float eta = 1.5f, alpha = 0.3f;

struct Method {
    const char* name;
    unsigned bdd;
    Variant variant;
    const char* quasiSpecular;
    DirectLight direct;
    bool ggx = false; // or Beckmann's distribution
    bool genericKernels = false;
};
std::string label(const testing::TestParamInfo<Method>& info) {
    return std::string(info.param.name) + (info.param.ggx ? "Ggx" : "Beckmann");
}

MeanAndError render(const Scene& scene, const Method& method, double radiusScale, unsigned passesPerBatch = 8) {
    RenderSettings settings;
    settings.bdd = method.bdd;
    settings.variant = method.variant;
    settings.quasiSpecular = method.quasiSpecular;
    settings.quasiSpecularOverridesScene = true;
    settings.direct = method.direct;
    settings.genericKernels = method.genericKernels;
    settings.furtherFeatures = test::surfaceFeatures();
    settings.photonsPerPass = 30000;
    settings.radiusScale = radiusScale;
    return renderGroups(scene, settings, std::vector<int>(resolution * resolution, 0), batches, passesPerBatch).front();
}

double allowed(const MeanAndError& result, double truth) { return 3 * result.standardError + 0.005 * truth; }

std::string glass(bool ggx, const std::string& more = "") {
    return fmt::format(R"(<bsdf type="roughdielectric"><float name="int_ior" value="{}"/>
            <float name="ext_ior" value="1"/><float name="alpha" value="{}"/>
            <string name="distribution" value="{}"/>{}</bsdf>)",
                       eta, alpha, ggx ? "ggx" : "beckmann", more);
}

/// A shape in surroundings of radiance 1; the camera looks at the origin from `origin` and covers 2 `halfWidth`.
Scene loadUnderSky(const std::string& shape, const std::string& bsdf, const std::string& origin, double halfWidth) {
    test::SceneFiles files;
    return loadScene(files.write(
        "scene.xml", fmt::format(R"(<scene version="3.0.0"><sensor type="orthographic"><transform name="to_world">
            <scale x="{0}" y="{0}"/><lookat origin="{1}" target="0,0,0" up="0,1,0"/></transform>
            <film type="hdrfilm"><rfilter type="box"/><integer name="width" value="{2}"/>
            <integer name="height" value="{2}"/></film></sensor>
            <emitter type="constant"><rgb name="radiance" value="1"/></emitter>
            <shape type="{3}">{4}</shape></scene>)",
                                 halfWidth, origin, resolution, shape, bsdf)));
}

shared::Lobe lobeSeenFrom(bool front, bool ggx) {
    return makeInterface(ggx ? LOBE_GGXDIELECTRIC : LOBE_BECKMANNDIELECTRIC, front ? eta : 1 / eta, alpha, alpha);
}

const char* seenFrom(bool front) { return front ? "3,0,4" : "3,0,-4"; }

/// Of the lobe that is met from this side, under the cosine 0.8 of seenFrom.
InterfaceShares sharesOf(bool front, bool ggx) { return interfaceShares(lobeSeenFrom(front, ggx), {0.6, 0, 0.8}); }

/// Mean of the ball's radiance over a square of this half width about its centre.
double ballRadiance(bool ggx, double halfWidth) {
    const BallRadiance radiance(lobeSeenFrom(true, ggx));
    constexpr int steps = 6;
    double sum = 0;
    for (int y = 0; y < steps; ++y)
        for (int x = 0; x < steps; ++x) {
            const double px = halfWidth * (x + 0.5) / steps, py = halfWidth * (y + 0.5) / steps;
            sum += radiance(std::sqrt(1 - px * px - py * py));
        }
    return sum / (steps * steps);
}

class RoughGlass : public testing::TestWithParam<Method> {
protected:
    const Method& method() const { return GetParam(); }
    bool ggx() const { return GetParam().ggx; }
};

// A rectangle, in front of which lies air, behind it glass.
TEST_P(RoughGlass, InterfaceShowsTheSkyAsItsLobeSharesIt) {
    for (const bool front : {true, false}) {
        const auto result = render(loadUnderSky("rectangle", glass(ggx()), seenFrom(front), 0.3), method(), 1);
        const auto shares = sharesOf(front, ggx());
        const double truth = shares.reflected + shares.transmitted;
        EXPECT_NEAR(result.mean, truth, allowed(result, truth)) << "front " << front << " " << result.standardError;
        EXPECT_LT(result.standardError, 0.015 * truth) << "too noisy to decide anything";
        // Negative controls: refraction without 1 / eta^2, and light from one side only.
        const double wrong = shares.reflected + (front ? eta * eta : 1 / (eta * eta)) * shares.transmitted;
        EXPECT_GT(std::abs(result.mean - wrong), allowed(result, wrong));
        EXPECT_GT(std::abs(result.mean - shares.transmitted), allowed(result, truth));
        EXPECT_GT(std::abs(result.mean - shares.reflected), allowed(result, truth));
    }
}

TEST_P(RoughGlass, BallHasTheRadianceOfItsEquation) {
    constexpr double halfWidth = 0.6;
    static const double truths[] = {ballRadiance(false, halfWidth), ballRadiance(true, halfWidth)};
    const double truth = truths[ggx()];
    const auto result = render(loadUnderSky("sphere", glass(ggx()), "0,0,5", halfWidth), method(), 0.5);
    EXPECT_NEAR(result.mean, truth, allowed(result, truth)) << result.standardError;
    EXPECT_LT(result.standardError, 0.015 * truth) << "too noisy to decide anything";
    // GGX loses 18 % by single scattering, Beckmann 3 %: the equation and not the lossless ball is what is seen.
    if (ggx()) {
        EXPECT_GT(std::abs(result.mean - 1), allowed(result, 1));
    }
}

// The two parts under textures of their own: a chequerboard of two equal colours is a factor.
TEST_P(RoughGlass, PartsAreTintedApart) {
    const std::string textures = R"(<texture type="checkerboard" name="specular_reflectance">
        <rgb name="color0" value="0.9"/><rgb name="color1" value="0.9"/></texture>
        <texture type="checkerboard" name="specular_transmittance">
        <rgb name="color0" value="0.3"/><rgb name="color1" value="0.3"/></texture>)";
    const auto result = render(loadUnderSky("rectangle", glass(ggx(), textures), seenFrom(true), 0.3), method(), 1);
    const auto shares = sharesOf(true, ggx());
    const double truth = 0.9 * shares.reflected + 0.3 * shares.transmitted;
    EXPECT_NEAR(result.mean, truth, allowed(result, truth)) << result.standardError;
    const double swapped = 0.3 * shares.reflected + 0.9 * shares.transmitted;
    EXPECT_GT(std::abs(result.mean - swapped), allowed(result, swapped));
}

// A Lambert lobe beside the glass takes light from its own side only.
TEST_P(RoughGlass, BesideItALambertLobeStaysOneSided) {
    const std::string blend =
        R"(<bsdf type="blendbsdf"><bsdf type="diffuse"><rgb name="reflectance" value="0.8"/></bsdf>)" + glass(ggx()) +
        R"(<float name="weight" value="0.25"/></bsdf>)";
    for (const bool front : {true, false}) {
        const auto result = render(loadUnderSky("rectangle", blend, seenFrom(front), 0.3), method(), 1);
        const auto shares = sharesOf(front, ggx());
        const double truth = (front ? 0.75 * 0.8 : 0) + 0.25 * (shares.reflected + shares.transmitted);
        EXPECT_NEAR(result.mean, truth, allowed(result, truth)) << "front " << front << " " << result.standardError;
    }
}

constexpr auto emitters = DirectLight::emitters;
constexpr auto photons = DirectLight::photons;
// Both distributions under emitter sampling, photons and a split: what else they differ in, rough_dielectric_test
// knows.
INSTANTIATE_TEST_SUITE_P(Methods, RoughGlass,
                         testing::Values(Method{"StandardBdd0", 0, Variant::main, "none", emitters},
                                         Method{"StandardBdd0Photons", 0, Variant::main, "none", photons, true},
                                         Method{"StandardBdd1Photons", 1, Variant::main, "none", photons},
                                         Method{"GenericBdd1Photons", 1, Variant::main, "none", photons, true, true},
                                         Method{"StandardBdd60", 60, Variant::main, "none", emitters, true},
                                         Method{"QuasiSpecular", 0, Variant::main, "all", emitters, true},
                                         Method{"QuasiSpecularPhotons", 0, Variant::main, "all", photons},
                                         Method{"QuasiSpecularAlternative", 0, Variant::alternative, "all", emitters}),
                         label);

/// Light through a ball of rough glass onto a grey floor, seen beside and through the ball.
MeanAndError renderFloor(const Method& method, float transmittance = 1) {
    test::SceneFiles files;
    const auto scene = loadScene(files.write("scene.xml", fmt::format(R"(<scene version="3.0.0">
        <sensor type="perspective"><float name="fov" value="35"/>
        <transform name="to_world"><lookat origin="0,1.5,2.5" target="0,-0.4,0" up="0,1,0"/></transform>
        <film type="hdrfilm"><rfilter type="box"/><integer name="width" value="{0}"/>
        <integer name="height" value="{0}"/></film></sensor>
        <shape type="rectangle"><bsdf type="diffuse"><rgb name="reflectance" value="0.8"/></bsdf>
        <transform name="to_world"><rotate x="1" angle="-90"/><translate y="-0.7"/></transform></shape>
        <shape type="rectangle"><emitter type="area"><rgb name="radiance" value="1"/></emitter>
        <transform name="to_world"><scale value="1.5"/><rotate x="1" angle="90"/><translate y="2"/></transform></shape>
        <shape type="sphere"><float name="radius" value="0.5"/><bsdf type="roughdielectric" id="glass">
        <float name="alpha" value="0.1"/><float name="specular_transmittance" value="{1}"/></bsdf></shape></scene>)",
                                                                      resolution, transmittance)));
    return render(scene, method, 0.5, 30);
}

// Forward, backward and split transport agree where photons that the glass has sent on land on another surface. Within
// 3.5 combined standard errors (two-sided, Student t with about 18 degrees of freedom: 0.3 % a case) plus 0.5 % for the
// density radius.
TEST(RoughGlassOverAFloor, IsTheSameForwardBackwardAndSplit) {
    const auto backward = renderFloor({"", 20, Variant::main, "none", emitters});
    const auto bound = [&](const MeanAndError& other) {
        return 3.5 * std::hypot(backward.standardError, other.standardError) + 0.005 * backward.mean;
    };
    EXPECT_LT(backward.standardError, 0.01 * backward.mean) << "too noisy to decide anything";
    for (const Method& method : {Method{"forward", 0, Variant::main, "none", emitters},
                                 Method{"forward, direct light too", 0, Variant::main, "none", photons},
                                 Method{"split", 0, Variant::main, "glass", emitters},
                                 Method{"split, further", 2, Variant::alternative, "glass", photons}}) {
        const auto other = renderFloor(method);
        EXPECT_NEAR(other.mean, backward.mean, bound(other)) << method.name;
        EXPECT_LT(other.standardError, 0.015 * other.mean) << method.name << ": too noisy to decide anything";
    }
    const auto darker = renderFloor({"", 0, Variant::main, "none", emitters}, 0.8f);
    EXPECT_GT(std::abs(darker.mean - backward.mean), bound(darker)) << "light through the ball must matter";
}

} // namespace
} // namespace quasilux
