// Guided emission (docs/method/learning.md): the tree of numbers, openings found from rays, and that means do not
// depend on any of it.
//
// False alarms: flux and radiance are held to 4 standard errors of 10 or 12 batches (Student t: 0.3 % a case); the
// seeds are fixed.
#include "learn/aims.h"
#include "learn/guide.h"
#include "learn/guide_tree.h"
#include "learn/importance.h"
#include "learn/openings.h"
#include "prepare/pack.h"
#include "render/renderer.h"
#include "scene/color.h"
#include "support/render_statistics.h"
#include "support/scene_files.h"
#include "support/stored_photons.h"
#include "support/wrong_learning.h"
#include "support/wrong_rules.h"

#include <algorithm>
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

// --- openings ---

// Rays in a cone about (0.3, 1, 0.2) through places of a rectangle; `spread`: from anywhere in a ball of radius 50.
std::vector<UsefulRay> raysThrough(const glm::dvec3& centre, double halfX, double halfZ, size_t count, bool spread) {
    std::mt19937 random(3);
    std::uniform_real_distribution<double> number(-1, 1);
    std::vector<UsefulRay> rays;
    for (size_t k = 0; k < count; ++k) {
        UsefulRay ray;
        ray.direction = glm::normalize(glm::dvec3(number(random), 1.5, number(random)));
        const glm::dvec3 place = spread ? 50.0 * glm::dvec3(number(random), number(random), number(random))
                                        : centre + glm::dvec3(halfX * number(random), 0, halfZ * number(random));
        ray.position = place - 70.0 * ray.direction;
        ray.weight = 1;
        rays.push_back(ray);
    }
    return rays;
}

TEST(Openings, TwoWindowsAreFound) {
    auto rays = raysThrough({2, 0, 1.5}, 0.6, 0.6, 2000, false);
    for (const auto& ray : raysThrough({8, 0, 1.5}, 0.5, 0.7, 1500, false)) rays.push_back(ray);
    for (const auto& ray : raysThrough({}, 0, 0, 500, true)) rays.push_back(ray);
    const auto openings = findOpenings(rays, 100, {}, 8);
    ASSERT_GE(openings.size(), 2u);
    EXPECT_LT(glm::distance(openings[0].centre, glm::dvec3(2, 0, 1.5)), 0.3);
    EXPECT_LT(glm::distance(openings[1].centre, glm::dvec3(8, 0, 1.5)), 0.3);
    for (size_t k = 0; k < 2; ++k) {
        EXPECT_LT(openings[k].halfU, 1.2);
        EXPECT_LT(openings[k].halfV, 1.2);
    }
    // Known ones are not found again. Control: rays from everywhere come through none.
    for (const Opening& other : findOpenings(rays, 100, openings, 8))
        EXPECT_GT(glm::distance(other.centre, openings[0].centre), 1);
    EXPECT_TRUE(findOpenings(raysThrough({}, 0, 0, 2000, true), 50, {}, 8).empty());
}

// Rays from outside through a window of 1.6 x 1.2 in the plane y = 0, turned by this angle in it.
std::vector<UsefulRay> raysThroughWindow(double turn, size_t count, std::mt19937& random) {
    std::uniform_real_distribution<double> number(-1, 1);
    std::vector<UsefulRay> rays(count);
    for (auto& ray : rays) {
        const double u = 0.8 * number(random), v = 0.6 * number(random);
        const glm::dvec3 place(std::cos(turn) * u - std::sin(turn) * v, 0, std::sin(turn) * u + std::cos(turn) * v);
        ray.position = glm::dvec3(20 * number(random), 15, 10 * number(random));
        ray.direction = glm::normalize(place - ray.position);
        ray.weight = 1;
    }
    return rays;
}

// Photons through what an opening leaves out of its window are heavy, so an upright window must not be taken for one
// that is turned a little, and one that is turned not for an upright one. No chance: seeds are fixed.
TEST(Openings, WindowsKeepTheirAxes) {
    for (const double turn : {0.0, 0.6})
        for (unsigned seed = 1; seed <= 10; ++seed) {
            std::mt19937 random(seed);
            const auto openings = findOpenings(raysThroughWindow(turn, 2000, random), 20, {}, 1);
            ASSERT_EQ(openings.size(), 1u);
            const glm::dvec3 across(std::cos(turn), 0, std::sin(turn));
            const double along = std::abs(glm::dot(openings[0].axisU, across)),
                         other = std::abs(glm::dot(openings[0].axisV, across));
            EXPECT_GT(std::max(along, other), turn == 0 ? 1 - 1e-9 : 0.99) << "seed " << seed;
            const auto rays = raysThroughWindow(turn, 10000, random);
            EXPECT_LT(std::ranges::count_if(rays, [&](const auto& ray) { return !openings[0].holds(ray); }), 10);
        }
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

// Nearly all photons go through two openings, some of them through both. `apart`: they know of each other.
Sources throughOpenings(const EmitterTables& emitters, bool apart) {
    Opening window{{0.2, 0.1, 0}, {1, 0, 0}, {0, 0.8, 0.6}, 0.4, 0.3}, facing{{-0.1, 0.2, 0.1}};
    facing.halfU = facing.halfV = 0.25;
    facing.faces = true;
    Sources all;
    for (unsigned e = 0; e < emitters.emitters.size(); ++e) {
        const auto first = static_cast<unsigned>(all.sources.size());
        for (const auto& source :
             {openingSource(e, first, window), openingSource(e, first, facing), plainSource(e, first)}) {
            SourceBox whole{static_cast<unsigned>(all.sources.size()), {}};
            whole.box.probability = source.halfU > 0 ? 0.4 : 0.2;
            all.boxes.push_back(whole);
            all.sources.push_back(source);
            if (!apart) all.sources.back().first = whole.source;
        }
    }
    return all;
}

// scenes/furnace_split.xml: flux by class is known (photon_trace_test.cpp). Difference in standard errors.
double directFlux(PhotonRule rule, const std::function<Sources(const EmitterTables&)>& learn) {
    DeviceScene flat = flattenScene(projectScene("furnace_split.xml"));
    const Sources all = learn(flat.emitters);
    LearnedTables learned;
    learned.guide = makeGuideTables(flat.emitters, all.sources, all.boxes);
    learned.guide.isGuided = true;
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

// Rays from all over a wall to a place whose surroundings matter ever less: aimed photons are as dense, ring by ring,
// as they are.
std::vector<bool> noneWasted(const std::vector<shared::ImportancePath>& paths) {
    return std::vector<bool>(paths.size() * IMPORTANCE_VERTICES);
}

TEST(Aims, SquaresAboutAPlaceFollowItsRays) {
    std::mt19937 random(3);
    std::uniform_real_distribution<double> number;
    std::vector<shared::ImportancePath> paths(20000);
    for (auto& path : paths) {
        path = {};
        const double away = 0.02 * std::pow(100, number(random)), turn = 2 * std::numbers::pi * number(random);
        path.vertices[0].position = {float(away * std::cos(turn)), float(away * std::sin(turn)), 0};
        path.vertices[1].position = {float(20 * number(random) - 10), float(20 * number(random) - 10), 8};
        path.vertices[0].weight = path.vertices[1].weight = path.vertices[1].found = 1;
    }
    const auto sets = findAims(paths, std::vector<double>(paths.size(), 1), noneWasted(paths), {}, 10);
    ASSERT_FALSE(sets.empty());
    EXPECT_GT(sets[0].openings.size(), 3u);
    EXPECT_LT(glm::length(sets[0].openings[0].centre), 0.1);
    const auto densityAt = [&](double away) {
        UsefulRay ray;
        ray.position = {0, 0, 8};
        ray.direction = glm::normalize(glm::dvec3(away, 0, -8));
        return sets[0].density(ray);
    };
    // Rays lie as densely as 1 / distance^2; squares follow to a factor of 2 or so.
    for (const double away : {0.1, 0.2, 0.4}) {
        EXPECT_GT(densityAt(away) / densityAt(2 * away), 1.9);
        EXPECT_LT(densityAt(away) / densityAt(2 * away), 8);
    }
}

// All that comes by a place comes through a window that is known: once that is taken, no ray passes the place any more, and
// what is left goes elsewhere.
TEST(Aims, APlaceWhoseRaysAreTakenIsNone) {
    std::mt19937 random(4);
    std::uniform_real_distribution<double> number(-1, 1);
    std::vector<shared::ImportancePath> paths(20000);
    for (size_t k = 0; k < paths.size(); ++k) {
        auto& path = paths[k] = {};
        const double away = 0.5 * std::sqrt(std::abs(number(random))), turn = std::numbers::pi * number(random);
        const bool here = k % 2 == 0;
        path.vertices[0].position = here
                                        ? shared::Packed3{float(away * std::cos(turn)), float(away * std::sin(turn)), 0}
                                        : shared::Packed3{float(9 * number(random)), float(9 * number(random)), -40};
        path.vertices[1].position = {float(3 * number(random)), float(3 * number(random)), here ? 50.0f : -20.0f};
        path.vertices[0].weight = path.vertices[1].weight = path.vertices[1].found = 1;
    }
    const Opening window{{0, 0, 2}, {1, 0, 0}, {0, 1, 0}, 0.5, 0.5};
    const std::vector<double> weights(paths.size(), 1);
    ASSERT_FALSE(findAims(paths, weights, noneWasted(paths), {}, 50).empty())
        << "the place is found where no window is known";
    const auto sets = findAims(paths, weights, noneWasted(paths), {window}, 50);
    ASSERT_FALSE(sets.empty());
    for (const auto& set : sets) ASSERT_FALSE(set.openings.empty());
    EXPECT_EQ(sets[0].openings[0].halfU, window.halfU) << "the window is taken first";
}

// A patch of ground in the sun lights a room through a window. Light from outside comes to all of the patch, which
// nothing is to be aimed at; and most of what is scattered brings nothing.
TEST(Aims, FindTheWindowBeforeAPatchOfGroundInTheSun) {
    std::mt19937 random(5);
    std::uniform_real_distribution<double> number(-1, 1);
    std::vector<shared::ImportancePath> paths(20000);
    for (size_t k = 0; k < paths.size(); ++k) {
        auto& path = paths[k] = {};
        const glm::dvec3 inside(2 * number(random), 2 + 2 * number(random), 1.5 * number(random));
        const glm::dvec3 ground(4 * number(random), -4 + 3 * number(random), -1.5);
        const glm::dvec3 window(0.5 * number(random), 0, 0.5 * number(random));
        const bool isLit = k % 10 == 0;
        path.vertices[0].position = pack(isLit ? window + 0.5 * (window - ground) : inside);
        path.vertices[1].position = pack(isLit ? ground : glm::dvec3(inside.y, 2 + inside.x, inside.z));
        path.vertices[0].weight = path.vertices[1].weight = 1;
        path.vertices[1].found = isLit;
    }
    const Opening patch{{0, -4, -1.5}, {1, 0, 0}, {0, 1, 0}, 5, 4};
    const auto sets = findAims(paths, std::vector<double>(paths.size(), 1), noneWasted(paths), {patch}, 20);
    ASSERT_EQ(sets.size(), 1u);
    EXPECT_LT(glm::length(sets[0].openings[0].centre), 0.4);
    UsefulRay ray;
    ray.position = {1, -6, -1.5};
    ray.direction = glm::normalize(-ray.position);
    EXPECT_GT(sets[0].density(ray), 10);
}

// A room with a window, and ground before it. Nine ways in ten lead from one surface of the room to another; the others
// come from the ground, where few photons that are scattered find the window.
std::vector<shared::ImportancePath> roomAndGround(unsigned seed) {
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> number(-1, 1);
    const auto ofRoom = [&] { return glm::dvec3(2 * number(random), 2 + 1.9 * number(random), 1.4 * number(random)); };
    std::vector<shared::ImportancePath> paths(20000);
    for (size_t k = 0; k < paths.size(); ++k) {
        auto& path = paths[k] = {};
        glm::dvec3 from = ofRoom(), to = ofRoom();
        if (k % 10 == 0) {
            const glm::dvec3 window(0.8 * number(random), 0, 0.6 * number(random));
            from = {8 * number(random), -5 + 4 * number(random), -1.5};
            to = window + (0.1 + 0.9 * std::abs(number(random))) * (window - from) / std::abs(from.y);
        }
        path.vertices[0].position = pack(to);
        path.vertices[1].position = pack(from);
        path.vertices[0].weight = path.vertices[1].weight = path.vertices[1].found = 1;
    }
    return paths;
}

// As findImportanceCells has them, of cells of side 1.
struct UnitCells {
    std::vector<uint32_t> keys;
    std::vector<float> sizes;

    explicit UnitCells(const std::vector<shared::ImportancePath>& paths) {
        for (const auto& path : paths)
            for (const auto& vertex : path.vertices) {
                const auto& p = vertex.position;
                const auto cell = [](float x) { return static_cast<uint32_t>(std::floor(x) + 32); };
                keys.insert(keys.end(), 2, 1 + cell(p.x) + 64 * (cell(p.y) + 64 * cell(p.z)));
                sizes.push_back(1);
            }
    }
};

TEST(Aims, FindAWindowAmongWaysWithinARoom) {
    for (unsigned seed = 1; seed <= 10; ++seed) {
        const auto paths = roomAndGround(seed);
        const std::vector<double> weights(paths.size(), 1);
        const UnitCells cells(paths);
        const auto isWasted = wastedScattering(paths, weights, cells.keys, cells.sizes);
        for (size_t k = 0; k < paths.size(); ++k)
            ASSERT_EQ(isWasted[k * IMPORTANCE_VERTICES + 1], k % 10 == 0) << "on the ground alone";
        const auto sets = findAims(paths, weights, isWasted, {}, 20);
        ASSERT_FALSE(sets.empty());
        ASSERT_FALSE(sets[0].openings[0].faces);
        EXPECT_LT(4 * sets[0].openings[0].halfU * sets[0].openings[0].halfV, 2 * 1.6 * 1.2);
        size_t missed = 0;
        for (size_t k = 0; k < paths.size(); k += 10) missed += !(sets[0].density(*scatteredRay(paths[k], 1)) > 0);
        EXPECT_LT(missed, 40u) << "of 2000, seed " << seed;
        // Control: where nobody knows which light is wasted, ways within the room decide.
        for (const auto& set : findAims(paths, weights, noneWasted(paths), {}, 20)) EXPECT_TRUE(set.openings[0].faces);
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

Scene furnaceRoom() {
    const auto inside = [](const std::string& scale, const std::string& translate) {
        return wall(scale, translate, 0.1, 0.9);
    };
    test::SceneFiles files;
    return loadScene(files.write(
        "scene.xml",
        R"(<scene version="3.0.0"><integrator type="path"/><sensor type="perspective"><float name="fov" value="65"/>
        <transform name="to_world"><lookat origin="2,0.3,1.5" target="2,3,1" up="0,0,1"/></transform>
        <film type="hdrfilm"><rfilter type="box"/><integer name="width" value="16"/><integer name="height" value="16"/></film></sensor>
        <emitter type="constant"><rgb name="radiance" value="1"/></emitter>)" +
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
