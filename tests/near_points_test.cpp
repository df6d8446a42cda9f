// Direct light of emitters without size near a camera path in a medium (kernels/medium_near_points.clh): what a ray
// through a ball of fog gets by one scattering, against its integral along the ray.
//
// A case passes within 4 standard errors of 20 batches (two-sided Student t: 0.08 % a case) and 0.3 %; seeds are fixed.
// A standard error above 1.5 % decides nothing and fails: of samples at collisions alone it is 10 % and more.
#include "support/render_statistics.h"
#include "support/scene_files.h"
#include "support/shared_features.h"
#include "support/test_kernels.h"
#include "support/vol_files.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <fmt/format.h>
#include <numbers>

namespace quasilux {
namespace {

using std::numbers::pi;
using Point = std::array<double, 3>;
using Rgb = std::array<double, 3>;

constexpr double radius = 2; // of the ball of fog about the origin
constexpr Rgb luminance{0.212671, 0.715160, 0.072169};

struct Lamp {
    Point position;
    double intensity;
    double height = -1;   ///< of a luminaire along z about the position; a point emitter if below 0
    double spot = 0;      ///< degrees from the axis +x, beyond which a spot sends nothing; half of it is its beam
    double projector = 0; ///< degrees between the sides of a square picture about the axis +x

    /// Share of the intensity in a direction from the lamp.
    double share(double x, double y, double z) const {
        const double aside = std::hypot(y, z);
        if (spot > 0) return std::clamp((spot - std::atan2(aside, x) * 180 / pi) / (spot / 2), 0.0, 1.0);
        if (projector == 0) return 1;
        const double side = x * std::tan(projector / 2 * pi / 180), cosine = x / std::hypot(x, aside);
        return std::max(std::abs(y), std::abs(z)) <= side ? std::pow(cosine, -3) : 0;
    }
};

struct Case {
    const char* name;
    double beside; ///< the ray runs along z at this x
    std::vector<Lamp> lamps;
    Rgb extinction{0.4, 0.4, 0.4};
    double g = 0;
    double wall = 2 * radius; ///< z of a black wall across the ray
    const char* further = ""; ///< of the scene
    double slope = 0;         ///< extinction varies along z: by 1 + slope z / radius
};
void PrintTo(const Case& c, std::ostream* out) { *out << c.name; }

/// By the angle about the lamp, in which the integrand is smooth.
double ofLamp(const Case& c, const Lamp& lamp, double extinction) {
    const double entry = -std::sqrt(radius * radius - c.beside * c.beside), exit = std::min(c.wall, -entry);
    const auto [x, y, z] = lamp.position;
    const double across = std::hypot(c.beside - x, y);
    const double from = std::atan((entry - z) / across), to = std::atan((exit - z) / across);
    constexpr int steps = 20000;
    double sum = 0;
    for (int k = 0; k < steps; ++k) {
        const double angle = from + (to - from) * (k + 0.5) / steps, along = across * std::tan(angle);
        const double distance = across / std::cos(angle); // of the lamp
        const double cosine = -along / distance;          // between the light and the way to the camera
        const double phase = (1 - c.g * c.g) / (4 * pi * std::pow(1 + c.g * c.g - 2 * c.g * cosine, 1.5));
        // dz = distance^2 / across d(angle), which takes the inverse square of the distance away
        const double at = z + along, before = at - entry; // on the ray
        const double density = 1 + c.slope * at / radius;
        const double depth = before * (1 + c.slope * (at + entry) / 2 / radius) +
                             distance * (1 + c.slope * (at + z) / 2 / radius); // both ways are straight
        sum += lamp.share(c.beside - x, -y, along) * phase * density * std::exp(-extinction * depth) / across;
    }
    return lamp.intensity * extinction * sum * (to - from) / steps;
}

double expected(const Case& c) {
    constexpr int places = 200; // of a luminaire
    double sum = 0;
    for (const Lamp& lamp : c.lamps)
        for (int place = 0; place < (lamp.height > 0 ? places : 1); ++place)
            for (size_t k = 0; k < 3; ++k) {
                Lamp point = lamp;
                if (lamp.height > 0) {
                    point.position[2] += lamp.height * ((place + 0.5) / places - 0.5);
                    point.intensity /= places;
                }
                sum += luminance[k] * ofLamp(c, point, c.extinction[k]);
            }
    return sum;
}

/// Of one candela in all directions, a rod of this height or a point.
std::string luminaireFile(double height) {
    return fmt::format("IESNA:LM-63-2002\nTILT=NONE\n1 -1 1 2 1 1 2 0 0 {}\n1 1 0\n0 180\n0\n1 1\n", height);
}

Scene sceneOf(const Case& c) {
    test::SceneFiles files;
    std::string lamps;
    for (const auto& [p, intensity, height, spot, projector] : c.lamps)
        if (spot > 0 || projector > 0)
            lamps += fmt::format(
                R"(<emitter type="{}"><rgb name="{}" value="{}"/>{}<transform name="to_world"><lookat
                origin="{},{},{}" target="{},{},{}" up="0,0,1"/></transform></emitter>)",
                spot > 0 ? "spot" : "projector", spot > 0 ? "intensity" : "irradiance",
                spot > 0 ? intensity : intensity / pi,
                spot > 0
                    ? fmt::format(R"(<float name="cutoff_angle" value="{}"/><float name="beam_width" value="{}"/>)",
                                  spot, spot / 2)
                    : fmt::format(R"(<float name="fov" value="{}"/>)", projector),
                p[0], p[1], p[2], p[0] + 1, p[1], p[2]);
        else if (height < 0)
            lamps += fmt::format(R"(<emitter type="point"><point name="position" x="{}" y="{}" z="{}"/>
            <rgb name="intensity" value="{}"/></emitter>)",
                                 p[0], p[1], p[2], intensity);
        else
            lamps += fmt::format(
                R"(<emitter type="quasilux_ies"><string name="filename" value="{}"/><float name="lumens" value="{}"/>
                <transform name="to_world"><translate x="{}" y="{}" z="{}"/></transform></emitter>)",
                files.write(fmt::format("lamp{}.ies", height), luminaireFile(height)), 4 * pi * 683 * intensity, p[0],
                p[1], p[2]);
    const std::string wall =
        fmt::format(R"(<shape type="disk"><transform name="to_world"><scale value="0.2"/><translate x="{}" z="{}"/>
            </transform><bsdf type="twosided"><bsdf type="diffuse"><rgb name="reflectance" value="0"/></bsdf></bsdf></shape>)",
                    c.beside, c.wall);
    std::string medium = fmt::format(R"(type="homogeneous"><rgb name="sigma_t" value="{},{},{}"/>)", c.extinction[0],
                                     c.extinction[1], c.extinction[2]);
    if (c.slope != 0) {
        const auto least = float(1 - c.slope), most = float(1 + c.slope); // at z = -radius and radius
        const float end = 2 * radius;
        medium = fmt::format(
            R"(type="heterogeneous"><volume name="sigma_t" type="gridvolume"><string name="filename" value="{}"/>
            <boolean name="use_grid_bbox" value="true"/></volume><float name="scale" value="{}"/>)",
            files.write("slope.vol", test::volFile({1, 1, 2}, 1, {least, most}, {-end, -end, -end, end, end, end})),
            c.extinction[0]);
    }
    return loadScene(files.write(
        "scene.xml",
        fmt::format(
            R"(<scene version="3.0.0"><integrator type="volpath"><integer name="max_depth" value="2"/></integrator>
        <sensor type="orthographic"><transform name="to_world"><scale x="1e-4" y="1e-4"/><translate x="{}" z="-3"/></transform>
        <film type="hdrfilm"><rfilter type="box"/><integer name="width" value="16"/><integer name="height" value="16"/></film></sensor>
        <shape type="sphere"><float name="radius" value="{}"/><bsdf type="null"/><medium name="interior" {}
        <float name="albedo" value="1"/>
        <phase type="hg"><float name="g" value="{}"/></phase></medium></shape>{}{}{}</scene>)",
            c.beside, radius, medium, c.g, lamps, wall, c.further)));
}

/// Of all cases: one program serves them all.
std::shared_ptr<const Features> featuresOfAll() {
    static const auto shared = [] {
        Features some = *test::mediumFeatures();
        some.emitterTypes = {EMITTER_POINT, EMITTER_SPOT, EMITTER_PROJECTOR, EMITTER_GONIOGRAM, EMITTER_CONSTANT};
        for (const auto ability : {&Features::chromaticMedia, &Features::heterogeneousMedia, &Features::directInMedia,
                                   &Features::depthLimit, &Features::sharingMedia})
            some.*ability = true;
        return std::make_shared<const Features>(some);
    }();
    return shared;
}

MeanAndError measure(const Scene& scene, const std::string& split, const std::string& options = "") {
    RenderSettings settings;
    settings.quasiSpecular = split;
    settings.quasiSpecularOverridesScene = true;
    settings.variant = Variant::alternative;
    settings.photonsPerPass = 1000;
    settings.furtherFeatures = featuresOfAll();
    settings.controlOptions += options;
    const std::vector<int> group(size_t(scene.sensor.width) * scene.sensor.height, 0);
    return renderGroups(scene, settings, group, 20, 16).front();
}

MeanAndError measure(const Case& c, const std::string& split, const std::string& options = "") {
    return measure(sceneOf(c), split, options);
}

class NearPoints : public testing::TestWithParam<Case> {};
TEST_P(NearPoints, BringWhatTheIntegralAlongTheRayHas) {
    const double truth = expected(GetParam());
    for (const char* split : {"all", "level:0.1"}) {
        const auto result = measure(GetParam(), split);
        EXPECT_NEAR(result.mean, truth, 4 * result.standardError + 0.003 * truth)
            << split << ", standard error " << result.standardError;
        EXPECT_LT(result.standardError, 0.015 * truth) << "too noisy to decide anything";
    }
    const auto twice = measure(GetParam(), "all", " -DNEAR_POINTS_RULE=1");
    EXPECT_GT(twice.mean, truth + 4 * twice.standardError + 0.003 * truth) << "control: at collisions, too";
}

const Lamp lamp{{0, 0, 0.3}, 2};

INSTANTIATE_TEST_SUITE_P(
    Rays, NearPoints,
    testing::Values(Case{"Close", 0.02, {lamp}}, //
                    Case{"AtSomeDistance", 0.5, {lamp}, {0.4, 0.4, 0.4}, 0.6},
                    Case{"Coloured", 0.1, {lamp}, {0.3, 1.2, 0.1}, -0.3},
                    Case{"EndsAtAWall", 0.1, {lamp}, {0.4, 0.4, 0.4}, 0.3, 0.35},
                    Case{"TwoLamps", 0.1, {lamp, {{0.2, 0.3, -0.8}, 0.7}}},
                    Case{"Luminaires", 0.1, {{{0, 0, 0.3}, 2, 0.5}, {{-0.3, 0, -0.5}, 0.7, 0}}},
                    Case{"BesideASky",
                         0.1,
                         {lamp},
                         {0.4, 0.4, 0.4},
                         0,
                         2 * radius,
                         R"(<emitter type="constant"><rgb name="radiance" value="1e-4"/></emitter>)"},
                    Case{"Spot", 0.3, {{{-0.2, 0.05, 0.3}, 2, -1, 20}}},
                    Case{"NarrowSpot", 0.3, {{{-0.2, 0.001, 0.3}, 2, -1, 0.3}}},
                    Case{"WideSpotAndAPoint", 0.3, {{{-0.2, 0.05, 0.3}, 2, -1, 120}, lamp}},
                    Case{"SpotBeyondReachOfPoints", 0.5, {{{-1.2, 0.1, 0.3}, 2, -1, 12}}, {1, 1, 1}, 0.5},
                    Case{"Projector", 0.3, {{{-0.2, 0.05, 0.3}, 2, -1, 0, 40}}},
                    Case{"DenserBehind", 0.1, {lamp}, {0.4, 0.4, 0.4}, 0, 2 * radius, "", 0.8},
                    Case{"ThinnerBehind", 0.1, {lamp}, {0.4, 0.4, 0.4}, 0.6, 2 * radius, "", -0.8}),
    [](const auto& row) { return std::string(row.param.name); });

/// From 64 on a tree chooses among emitters. All but one lie behind the ray's beginning, and outside the fog.
TEST(NearPointsOfMany, BringWhatTheIntegralHas) {
    Case c{"Many", 0.1, {lamp}};
    const double truth = expected(c);
    for (int k = 0; k < 80; ++k) c.lamps.push_back({{0, 40.0 + k, -40}, 1e-6});
    const auto result = measure(c, "all");
    EXPECT_NEAR(result.mean, truth, 4 * result.standardError + 0.003 * truth);
    EXPECT_LT(result.standardError, 0.015 * truth) << "too noisy to decide anything";
}

/// Whether one is near depends on which one the tree chooses; what a path draws after that, such as its flight, must not.
/// Behind a mirror a ray passes fog that scatters nothing, half of the lamps being points near it, and meets an emitter: what
/// comes of it is the transmittance.
TEST(NearPointsOfMany, LeaveFurtherFlightsAlone) {
    constexpr double extinction = 0.4;
    std::string lamps;
    for (int k = 0; k < 40; ++k) // of points, and as many that are none
        lamps += fmt::format(R"(<emitter type="point"><point name="position" value="1,{0},-1"/></emitter>
            <shape type="rectangle"><transform name="to_world"><scale value="0.02"/><rotate y="1" angle="90"/>
            <translate x="-1" y="{1}" z="-1"/></transform><emitter type="area"><rgb name="radiance" value="20000"/></emitter>
            </shape>)",
                             0.1 + 0.002 * k, 0.05 * k - 1);
    test::SceneFiles files;
    const Scene scene = loadScene(files.write("scene.xml", fmt::format(
                                                               R"(<scene version="3.0.0"><integrator type="volpath"/>
        <sensor type="orthographic"><transform name="to_world"><scale x="1e-4" y="1e-4"/><translate x="0.1" z="-3"/></transform>
        <film type="hdrfilm"><rfilter type="box"/><integer name="width" value="16"/><integer name="height" value="16"/></film></sensor>
        <shape type="sphere"><float name="radius" value="{}"/><bsdf type="null"/><medium name="interior" type="homogeneous">
        <rgb name="sigma_t" value="{}"/><float name="albedo" value="1e-9"/></medium></shape>
        <shape type="rectangle"><transform name="to_world"><scale value="0.2"/><rotate y="1" angle="135"/>
        <translate x="0.1" z="-1"/></transform><bsdf type="conductor"><string name="material" value="none"/></bsdf></shape>
        <shape type="rectangle"><transform name="to_world"><scale value="0.2"/><rotate y="1" angle="-90"/>
        <translate x="2.5" z="-1"/></transform><emitter type="area"/></shape>{}</scene>)",
                                                               radius, extinction, lamps)));
    const double within = std::sqrt(radius * radius - 0.01) - 1 + std::sqrt(radius * radius - 1) - 0.1; // of the fog
    const double truth = std::exp(-extinction * within);
    const auto differs = [&](const MeanAndError& found) {
        return std::abs(found.mean - truth) > 4 * found.standardError + 0.003 * truth;
    };
    const auto result = measure(scene, "all");
    EXPECT_FALSE(differs(result)) << result.mean << " +- " << result.standardError << " instead of " << truth;
    EXPECT_LT(result.standardError, 0.015 * truth) << "too noisy to decide anything";
    const auto wrong = measure(scene, "all", " -DNEAR_POINTS_RULE=2");
    EXPECT_TRUE(differs(wrong)) << "control: numbers are drawn again";
}

} // namespace
} // namespace quasilux
