// What photons are aimed at (docs/method/learning.md): openings found from rays, and sets of them found from importance
// paths. No chance: seeds are fixed.
#include "learn/aims.h"
#include "learn/importance.h"
#include "learn/openings.h"
#include "prepare/pack.h"

#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>
#include <numbers>
#include <random>

namespace quasilux {
namespace {

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

// Rays from outside that all end in one place, as at a meter of one point, come through no opening there: a photon
// through it serves nothing, and others would have little chance. Control: where they go on beyond it, it is a pinhole.
TEST(Openings, AreNotWhereRaysEnd) {
    std::mt19937 random(4);
    const glm::dvec3 end(0.3, 3, -0.4);
    auto rays = raysThroughWindow(0, 2000, random);
    for (auto& ray : rays) {
        ray.direction = glm::normalize(end - (ray.position - ray.position.y / ray.direction.y * ray.direction));
        ray.position = end;
    }
    for (const Opening& opening : findOpenings(rays, 20, {}, 4)) EXPECT_GT(glm::distance(opening.centre, end), 0.5);
    for (auto& ray : rays) ray.position += 5.0 * ray.direction;
    const auto pinholes = findOpenings(rays, 20, {}, 1);
    ASSERT_EQ(pinholes.size(), 1u);
    EXPECT_LT(glm::distance(pinholes[0].centre, end), 0.1);
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

// --- aims ---

std::vector<bool> noneWasted(const std::vector<shared::ImportancePath>& paths) {
    return std::vector<bool>(paths.size() * IMPORTANCE_VERTICES);
}

// Rays from all over a wall to a place whose surroundings matter ever less: aimed photons are as dense, ring by ring,
// as they are.
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

} // namespace
} // namespace quasilux
