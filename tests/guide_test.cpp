// Guided emission (docs/method/learning.md): the tree of numbers, and that means do not depend on what was learned.
//
// False alarms: flux and radiance are held to 4 standard errors of 10 or 12 batches (Student t: 0.3 % a case); the
// seeds are fixed.
#include "learn/aims.h"
#include "learn/guide.h"
#include "learn/guide_tree.h"
#include "learn/openings.h"
#include "prepare/media.h"
#include "prepare/pack.h"
#include "render/renderer.h"
#include "scene/color.h"
#include "support/render_statistics.h"
#include "support/scene_files.h"
#include "support/stored_photons.h"
#include "support/wrong_learning.h"
#include "support/wrong_rules.h"

#include <cmath>
#include <functional>
#include <gtest/gtest.h>
#include <numbers>
#include <random>

namespace quasilux {
namespace {

using test::PhotonRule;

// --- the tree ---

bool holds(const GuideBox& box, const std::array<float, emissionDimensions>& u) {
    for (size_t d = 0; d < emissionDimensions; ++d)
        if (u[d] < box.lower[d] || u[d] >= box.lower[d] + box.size[d]) return false;
    return true;
}

// Beside emitters that are 1e9 times as strong, in any order: each has random numbers of its own, multiples of 2^-24,
// and its photons weigh as these say.
TEST(GuideTables, WeakEmittersAreNotLost) {
    const auto point = [](double intensity) {
        return "<emitter type=\"point\"><rgb name=\"intensity\" value=\"" + std::to_string(intensity) +
               "\"/></emitter>";
    };
    const std::string strong = point(1e9), weak = point(1);
    for (const std::string& body : {strong + weak, weak + strong, strong + weak + strong + weak + weak}) {
        const test::SceneFiles files;
        const Scene scene = loadScene(files.write("scene.xml", test::sceneWith(body)));
        const GuideTables guide = plainGuide(flattenEmitters(scene, placeMedia(scene)));
        ASSERT_EQ(guide.leaves.size(), scene.pointEmitters.size());
        double below = 0;
        for (const auto& leaf : guide.leaves) {
            const double numbers = 0x1p24 * (leaf.cdf - below);
            EXPECT_EQ(numbers, std::round(numbers));
            EXPECT_GE(numbers, 1);
            EXPECT_NEAR(leaf.weight * (leaf.cdf - below), 1, 1e-6);
            below = leaf.cdf;
        }
        EXPECT_EQ(below, 1);
    }
}

TEST(GuideTree, LeavesFillTheCubeOnce) {
    const auto leaves = buildGuideTree(samplesWithin(0.1, 5000), {});
    double volume = 0, probability = 0;
    for (const auto& leaf : leaves) {
        volume += leaf.box.volume();
        probability += leaf.box.probability;
        EXPECT_GT(leaf.box.probability, 0);
    }
    EXPECT_NEAR(volume, 1, 1e-9);
    EXPECT_NEAR(probability, 1, 1e-9);
    for (const auto& point : samplesWithin(0.5, 1000))
        EXPECT_EQ(
            std::count_if(leaves.begin(), leaves.end(), [&](const auto& leaf) { return holds(leaf.box, point.u); }), 1);
}

TEST(GuideTree, FollowsTheSamplesAndNothingElse) {
    const auto leaves = buildGuideTree(samplesWithin(0.1, 5000), {});
    double within = 0;
    for (const auto& leaf : leaves)
        if (leaf.box.lower[1] > 0.29 && leaf.box.lower[1] + leaf.box.size[1] < 0.41) within += leaf.box.probability;
    EXPECT_GT(within, 0.7) << "a hundredth of the cube has all samples";
    EXPECT_GT(guideGain(leaves, {}), 30);
    // Controls: of even samples, and of none, nothing is learned.
    std::mt19937 random(2);
    std::uniform_real_distribution<float> number;
    auto even = samplesWithin(0.1, 5000);
    for (auto& sample : even)
        for (float& u : sample.u) u = number(random);
    EXPECT_LT(guideGain(buildGuideTree(even, {}), {}), 1.1);
    EXPECT_EQ(buildGuideTree({}, {}).size(), 1u);
}

// --- means ---

struct Sources {
    std::vector<shared::GuideSource> sources;
    std::vector<SourceBox> boxes;
};

// Photons begin nearly all in a hundredth of the numbers.
Sources inCorners(const EmitterTables& emitters) {
    Sources all;
    for (unsigned e = 0; e < emitters.emitters.size(); ++e) {
        for (const auto& leaf : buildGuideTree(samplesWithin(0.1, 3000), {})) all.boxes.push_back({e, leaf.box});
        all.sources.push_back(plainSource(e, e));
    }
    return all;
}

// Photons of each emitter go through these openings, `ofEach` of them, and the rest anyhow. `apart`: openings know of
// each other.
Sources through(const EmitterTables& emitters, const std::vector<Opening>& openings, double ofEach, double rest,
                bool apart = true) {
    Sources all;
    for (unsigned e = 0; e < emitters.emitters.size(); ++e) {
        const auto first = static_cast<unsigned>(all.sources.size());
        const auto add = [&](shared::GuideSource source, double probability) {
            SourceBox whole{static_cast<unsigned>(all.sources.size()), {}};
            whole.box.probability = probability;
            if (!apart) source.first = whole.source;
            all.boxes.push_back(whole);
            all.sources.push_back(source);
        };
        for (const Opening& opening : openings) add(openingSource(e, first, opening), ofEach);
        add(plainSource(e, first), rest);
    }
    return all;
}

// Nearly all photons go through two openings, some of them through both.
Sources throughOpenings(const EmitterTables& emitters, bool apart) {
    Opening window{{0.2, 0.1, 0}, {1, 0, 0}, {0, 0.8, 0.6}, 0.4, 0.3}, facing{{-0.1, 0.2, 0.1}};
    facing.halfU = facing.halfV = 0.25;
    facing.faces = true;
    return through(emitters, {window, facing}, 0.4, 0.2, apart);
}

// Nine of ten photons go through a pinhole, and carry a billionth of what the others do.
Sources throughAPinhole(const EmitterTables& emitters) {
    return through(emitters, {Opening{{0.2, 0.1, 0}, {1, 0, 0}, {0, 0.8, 0.6}, 1e-5, 1e-5}}, 0.9, 0.1);
}

// scenes/furnace_split.xml: flux by class is known (photon_trace_test.cpp). Difference in standard errors. `typical`:
// factor on the flux by which the range of what is stored is chosen.
double directFlux(PhotonRule rule, const std::function<Sources(const EmitterTables&)>& learn, double typical = 1) {
    DeviceScene flat = flattenScene(projectScene("furnace_split.xml"));
    const Sources all = learn(flat.emitters);
    LearnedTables learned;
    learned.guide = makeGuideTables(flat.emitters, all.sources, all.boxes);
    learned.guide.isGuided = true;
    learned.guide.typicalFlux *= typical;
    setLearned(flat, learned);
    RenderSettings settings;
    settings.direct = DirectLight::photons;
    settings.controlOptions += optionOf(rule);
    const MeanAndError result = directShareOfFlux(flat, settings);
    return (result.mean - 1) / result.standardError;
}

TEST(GuidedMean, FluxIsThatOfPlainEmissionWhateverWasLearned) {
    EXPECT_LT(std::abs(directFlux(PhotonRule::right, inCorners)), 4);
    EXPECT_GT(std::abs(directFlux(PhotonRule::missingGuideWeight, inCorners)), 4) << "negative control";
}

TEST(GuidedMean, EachRayThroughOpeningsIsEmittedOnce) {
    const auto apart = [](const EmitterTables& emitters) { return throughOpenings(emitters, true); };
    const auto twice = [](const EmitterTables& emitters) { return throughOpenings(emitters, false); };
    EXPECT_LT(std::abs(directFlux(PhotonRule::right, apart)), 4);
    EXPECT_GT(directFlux(PhotonRule::right, twice), 4) << "negative control: rays through both, and plain ones, again";
}

TEST(GuidedMean, HeavyPhotonsKeepTheirFlux) {
    EXPECT_LT(std::abs(directFlux(PhotonRule::right, throughAPinhole)), 4);
    EXPECT_LT(directFlux(PhotonRule::right, throughAPinhole, 0x1p-12), -4) << "negative control: most are cut";
}

const AimSet squareAboveTheFloor{{Opening{{0, -0.98, 0}, {1, 0, 0}, {0, 0, 1}, 0.3, 0.3}}, {1}};
AimSet squaresAboutAPlace() {
    AimSet set{{}, {0.2, 0.5, 0.3}};
    for (const double half : {0.15, 0.3, 0.9})
        set.openings.push_back({{0, -0.97, 0}, {1, 0, 0}, {0, 1, 0}, half, half, true});
    return set;
}

// Half of the scattered photons are aimed just above the floor of a cube with even light. Share of the light that was
// scattered before which arrives on the floor there, over the square's share of the area; 10 or more standard errors
// separate 1 from 2.
MeanAndError lightBelowAims(PhotonRule rule, const std::vector<AimSet>& aims) {
    DeviceScene flat = flattenScene(projectScene("furnace_split.xml"));
    LearnedTables learned;
    learned.guide = plainGuide(flat.emitters);
    learned.aims = aimTable(aims);
    setLearned(flat, learned);
    RenderSettings settings;
    settings.emission = Emission::guided;
    settings.controlOptions += optionOf(rule);
    PhotonTracing tracing;
    tracing.radius = 0.1f;
    std::vector<double> ratio;
    for (const auto& pass : tracePhotons(flat, settings, tracing)) {
        double all = 0, below = 0;
        for (const StoredPhoton& photon : pass[LIGHT_DIFFUSE]) {
            all += mean(photon.flux);
            if (photon.y < -0.999f && std::abs(photon.x) < 0.3f && std::abs(photon.z) < 0.3f)
                below += mean(photon.flux);
        }
        ratio.push_back(below / all / (0.6 * 0.6 / 24));
    }
    return meanAndError(ratio);
}

TEST(GuidedMean, AimedPhotonsBringNoMoreLightThere) {
    for (const auto& aims : {std::vector{squareAboveTheFloor}, std::vector{squaresAboutAPlace()},
                             std::vector{squaresAboutAPlace(), squareAboveTheFloor}}) {
        const MeanAndError right = lightBelowAims(PhotonRule::right, aims);
        EXPECT_NEAR(right.mean, 1, 4 * right.standardError);
        EXPECT_LT(right.standardError, 0.02) << "too noisy to decide anything";
        EXPECT_GT(lightBelowAims(PhotonRule::missingAimWeight, aims).mean, 2) << "negative control";
    }
}

// A room with a window on a site, where everything emits what it absorbs and the sky has radiance 1: radiance is 1
// everywhere.
std::string wall(const std::string& scale, const std::string& translate, double emitted, double reflectance) {
    return "<shape type=\"cube\"><transform name=\"to_world\"><scale value=\"" + scale + "\"/><translate value=\"" +
           translate + "\"/></transform><bsdf type=\"diffuse\"><rgb name=\"reflectance\" value=\"" +
           std::to_string(reflectance) + "\"/></bsdf><emitter type=\"area\"><rgb name=\"radiance\" value=\"" +
           std::to_string(emitted) + "\"/></emitter></shape>";
}

constexpr auto lookIntoTheRoom =
    R"(<sensor type="perspective"><float name="fov" value="65"/>
        <transform name="to_world"><lookat origin="2,0.3,1.5" target="2,3,1" up="0,0,1"/></transform>
        <film type="hdrfilm"><rfilter type="box"/><integer name="width" value="16"/><integer name="height" value="16"/></film></sensor>)";

Scene furnaceRoom(const std::string& sensor = lookIntoTheRoom) {
    const auto inside = [](const std::string& scale, const std::string& translate) {
        return wall(scale, translate, 0.1, 0.9);
    };
    test::SceneFiles files;
    return loadScene(files.write(
        "scene.xml", R"(<scene version="3.0.0"><integrator type="path"/>)" + sensor +
                         R"(<emitter type="constant"><rgb name="radiance" value="1"/></emitter>)" +
                         inside("2.2,1.7,0.1", "2,1.5,-0.1") + inside("2.2,1.7,0.1", "2,1.5,2.9") +
                         inside("0.1,1.7,1.4", "-0.1,1.5,1.4") + inside("0.1,1.7,1.4", "4.1,1.5,1.4") +
                         inside("2,0.1,1.4", "2,3.1,1.4") + inside("0.7,0.1,1.4", "0.7,-0.1,1.4") +
                         inside("0.7,0.1,1.4", "3.3,-0.1,1.4") + inside("0.6,0.1,0.45", "2,-0.1,0.45") +
                         inside("0.6,0.1,0.35", "2,-0.1,2.45") + wall("10,10,0.1", "0,0,-0.4", 0.8, 0.2) + "</scene>"));
}

MeanAndError renderRoom(PhotonRule rule) {
    RenderSettings settings;
    settings.emission = Emission::guided;
    settings.photonsPerPass = 16'000;
    settings.controlOptions += optionOf(rule);
    return renderGroups(furnaceRoom(), settings, std::vector<int>(256, 0), 10, 8).front();
}

/// Is radiance 1, and known well enough to say so? Missing weights move the mean, or leave it to a few photons.
bool isOne(const MeanAndError& found) {
    return std::abs(found.mean - 1) < 4 * found.standardError + 0.005 && found.standardError < 0.01;
}

TEST(GuidedMean, ARoomOfAFurnaceIsAsBrightAsItsSky) {
    const MeanAndError right = renderRoom(PhotonRule::right);
    EXPECT_TRUE(isOne(right)) << right.mean << " +- " << right.standardError;
    for (const PhotonRule rule : {PhotonRule::missingGuideWeight, PhotonRule::missingSplitWeight}) {
        const MeanAndError wrong = renderRoom(rule);
        EXPECT_FALSE(isOne(wrong)) << "negative control " << static_cast<int>(rule) << ": " << wrong.mean << " +- "
                                   << wrong.standardError;
    }
}

// At single points paths are few, and all that comes from the sky goes through these points: as openings they would
// take nearly all photons, which bring nothing.
TEST(GuidedMean, PointsOfAMeterHaveTheirLight) {
    std::string points;
    for (const char* place : {"1.2,2.2,0.8", "2.9,2.6,0.8", "3.2,0.7,1.6"})
        points += std::string("<?quasilux illuminance-grid origin=\"") + place +
                  "\" edge-u=\"0.1,0,0\" edge-v=\"0,0.1,0\" nx=\"1\" ny=\"1\"?>";
    const Scene scene = furnaceRoom(points);
    RenderSettings settings;
    settings.emission = Emission::guided;
    settings.photonsPerPass = 16'000;
    Renderer renderer(testDevice(), scene, settings);
    for (unsigned pass = 0; pass < 48; ++pass) renderer.renderPass(pass);
    EXPECT_EQ(renderer.counters().clipped, 0u);
    const FilmImage image = renderer.develop();
    for (size_t k = 0; k < image.radiance.size(); ++k) {
        EXPECT_NEAR(image.radiance[k], std::numbers::pi, 4 * image.standardError[k] + 0.005 * std::numbers::pi);
        EXPECT_LT(image.standardError[k], 0.01 * std::numbers::pi) << "too noisy to decide anything";
    }
}

/// Photons of a point beside a cube of fog carry the point's power, whatever was learned. Flux by passes is even to
/// 0.1 %, as leaves are chosen evenly; with an opening at the point itself it was 15 to 4,000 times as large.
TEST(GuidedMean, APointHasItsPower) {
    test::SceneFiles files;
    const Scene scene = loadScene(files.write(
        "scene.xml",
        R"(<scene version="3.0.0"><integrator type="volpath"/><sensor type="perspective"><float name="fov" value="40"/>
        <transform name="to_world"><lookat origin="0,-5,2" target="0,0,0" up="0,0,1"/></transform>
        <film type="hdrfilm"><rfilter type="box"/><integer name="width" value="32"/><integer name="height" value="32"/></film></sensor>
        <emitter type="point"><point name="position" x="0" y="-3" z="4"/><rgb name="intensity" value="30"/></emitter>
        <shape type="cube"><bsdf type="null"/><medium name="interior" type="homogeneous"><float name="sigma_t" value="2"/>
        <float name="albedo" value="0.8"/></medium></shape></scene>)"));
    for (const unsigned seed : {1u, 2u, 5u}) {
        RenderSettings settings;
        settings.emission = Emission::guided;
        settings.photonsPerPass = 20'000;
        settings.energyBalance = true;
        settings.seed = seed;
        Renderer renderer(testDevice(), scene, settings);
        EXPECT_TRUE(renderer.report().learned.isGuided);
        for (unsigned pass = 0; pass < 8; ++pass) renderer.renderPass(pass);
        const double power = 8 * 4 * std::numbers::pi * 30;
        EXPECT_NEAR(renderer.counters().energy->emitted, power, 0.01 * power) << "seed " << seed;
    }
}

} // namespace
} // namespace quasilux
