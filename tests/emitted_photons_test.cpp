// Photons of emitters: position, direction and flux follow the emitter's area, radiance and selection. 14 statistical
// tests; false-alarm rate of the program 1e-4.
#include "support/chi_squared.h"
#include "support/emitter_cases.h"

#include <cmath>
#include <gtest/gtest.h>
#include <numbers>

namespace quasilux {
namespace {

using glm::dvec3;
using shared::Emitter;
using std::numbers::pi;

constexpr int statisticalTests = 14;
constexpr size_t sampleCount = 100000;

/// Where photons of a sky meet a sphere within the scene, each with the flux that it stands for: points (cosine to an
/// axis) and angles of incidence (squared cosine) by cell, and the total flux over the one expected, with its z score.
struct SphereInSky {
    std::vector<uint64_t> points, angles;
    double zScore;
};
SphereInSky lightSphere(dvec3 centre, double radius, double expectedFlux) {
    const SampleGrid grid{-1, 1, -pi, pi, 8, 8}, square{0, 1, -pi, pi, 8, 8};
    SphereInSky result{std::vector<uint64_t>(grid.cells() + 1), std::vector<uint64_t>(square.cells() + 1), 0};
    double flux = 0;
    size_t hits = 0;
    for (const EmittedParticle& p :
         samplePhotons({makeConstant({1, 2, 3}, 2)}, {}, uniformNumbers(5 * sampleCount, 14))) {
        const dvec3 toCentre = centre - p.position;
        const double along = glm::dot(toCentre, p.direction),
                     h2 = radius * radius - glm::dot(toCentre, toCentre) + along * along;
        if (h2 <= 0) continue;
        const dvec3 n = (p.position + (along - std::sqrt(h2)) * p.direction - centre) / radius;
        const double cosine = -glm::dot(n, p.direction), phi = std::atan2(n.y, n.x);
        ++result.points[grid.cell(std::min(std::max(n.z, -1.0), 1.0), phi)];
        ++result.angles[square.cell(std::min(cosine * cosine, 1.0), phi)];
        flux += p.flux.y / sampleCount;
        ++hits;
    }
    const double share = double(hits) / sampleCount;
    result.zScore = std::abs(flux / expectedFlux - 1) / std::sqrt((1 - share) / hits);
    return result;
}

// In a uniform sky a sphere receives pi L everywhere, cosine-distributed, wherever it lies in the scene.
TEST(ConstantEmitter, photonsLightASphereEvenly) {
    for (const auto& [centre, radius] : {std::pair(dvec3(1, 2, 3), 2.0), {dvec3(1.5, 2.5, 2.5), 1.0}}) {
        const double flux = pi * 4 * pi * radius * radius;
        const SphereInSky lit = lightSphere(centre, radius, flux);
        const std::vector<double> uniform(64, 1.0 / 64);
        EXPECT_GT(chiSquaredPValue(lit.points, uniform), significanceLevel(statisticalTests));
        EXPECT_GT(chiSquaredPValue(lit.angles, uniform), significanceLevel(statisticalTests));
        // All photons meet a sphere as large as the scene: nothing is random then.
        if (radius == 1) {
            EXPECT_GT(normalPValue(lit.zScore), significanceLevel(statisticalTests));
            EXPECT_LT(normalPValue(lightSphere(centre, radius, 1.05 * flux).zScore),
                      significanceLevel(statisticalTests))
                << "negative control: power wrong by 5 %";
        }
    }
}

TEST(DirectionalEmitter, photonsAreEvenAcrossTheBeam) {
    const dvec3 along = glm::normalize(dvec3(1, -2, 3)), s = glm::normalize(glm::cross(along, dvec3(0, 0, 1))),
                t = glm::cross(along, s), centre(5, 6, 7);
    const SampleGrid disc{0, 1, -pi, pi, 12, 12}; // squared radius, azimuth
    std::vector<uint64_t> counts(disc.cells() + 1);
    for (const EmittedParticle& p :
         samplePhotons({makeDirectional(along, centre, 2)}, {}, uniformNumbers(5 * sampleCount, 15))) {
        const dvec3 offset = (p.position - centre) / 2.0;
        const double x = glm::dot(offset, s), y = glm::dot(offset, t);
        ++counts[disc.cell(std::min(x * x + y * y, 1.0), std::atan2(y, x))];
        ASSERT_LT(glm::length(p.direction - along), 1e-6);
        ASSERT_NEAR(glm::dot(offset, along), -1, 1e-5) << "starts before everything in the scene";
        ASSERT_NEAR(p.flux.y, 4 * pi, 1e-5);
    }
    EXPECT_GT(chiSquaredPValue(counts, std::vector<double>(disc.cells(), 1.0 / disc.cells())),
              significanceLevel(statisticalTests));
}

TEST(EmittedPhotons, carryTheFluxOfAllEmittersAndFollowTheSelection) {
    const EmitterMixture m = mixedEmitters();
    const auto photons = samplePhotons(m.emitters, m.triangles, uniformNumbers(5 * sampleCount, 7));
    std::vector<uint64_t> counts(4);
    const double power[] = {pi * 0.25, pi * m.emitters[1].area, pi * 4 * pi * 0.25, 4 * pi};
    for (const EmittedParticle& p : photons) {
        ++counts.at(p.emitter);
        ASSERT_NEAR(p.flux.x * m.emitters[p.emitter].selectionProbability / power[p.emitter], 1, 1e-5);
        ASSERT_NEAR(glm::length(p.direction), 1, 1e-6);
        ASSERT_GT(glm::dot(p.direction, p.normal), 0);
    }
    EXPECT_GT(chiSquaredPValue(counts, {0.1, 0.4, 0.3, 0.2}), significanceLevel(statisticalTests));
}

TEST(EmittedPhotons, areUniformByAreaAndCosineDistributed) {
    const Emitter light = testRectangle(1);
    const dvec3 u = wide(light.edgeU), v = wide(light.edgeV), n = wide(light.normal), s = glm::normalize(u),
                t = glm::cross(n, s);
    const SampleGrid square{0, 1, 0, 1, 16, 16};
    std::vector<uint64_t> positions(square.cells() + 1), directions(positions), both(positions);
    const auto inUnit = [](double x) { return x > -1e-4 && x < 1 + 1e-4 ? std::min(std::max(x, 0.0), 1.0) : x; };
    for (const EmittedParticle& p : samplePhotons({light}, {}, uniformNumbers(5 * sampleCount, 8))) {
        const dvec3 offset = p.position - wide(light.origin);
        const double a = inUnit(glm::dot(offset, u) / glm::dot(u, u)), b = inUnit(glm::dot(offset, v) / glm::dot(v, v));
        const double cos2 = std::min(glm::dot(p.direction, n) * glm::dot(p.direction, n), 1.0);
        const double phi = std::atan2(glm::dot(p.direction, t), glm::dot(p.direction, s)) / (2 * pi) + 0.5;
        ++positions[square.cell(a, b)];
        ++directions[square.cell(cos2, phi)];
        ++both[square.cell(a, cos2)];
    }
    const std::vector<double> uniform(square.cells(), 1.0 / square.cells());
    for (const auto& counts : {positions, directions, both})
        EXPECT_GT(chiSquaredPValue(counts, uniform), significanceLevel(statisticalTests));
}

TEST(EmittedPhotons, coverTheSphereAndTheTrianglesEvenly) {
    const SampleGrid square{-1, 1, -pi, pi, 12, 12};
    const std::vector<double> uniform(square.cells(), 1.0 / square.cells());
    std::vector<uint64_t> onSphere(square.cells() + 1), fromPoint(onSphere);
    for (const EmittedParticle& p :
         samplePhotons({makeSphere({0, 0, 0}, 1, 1)}, {}, uniformNumbers(5 * sampleCount, 9)))
        ++onSphere[square.cell(std::min(std::max(p.position.z, -1.0), 1.0), std::atan2(p.position.y, p.position.x))];
    for (const EmittedParticle& p : samplePhotons({makePoint({0, 0, 0})}, {}, uniformNumbers(5 * sampleCount, 10)))
        ++fromPoint[square.cell(std::min(std::max(p.direction.z, -1.0), 1.0),
                                std::atan2(p.direction.y, p.direction.x))];
    EXPECT_GT(chiSquaredPValue(onSphere, uniform), significanceLevel(statisticalTests));
    EXPECT_GT(chiSquaredPValue(fromPoint, uniform), significanceLevel(statisticalTests));

    // Triangles of areas 1 and 3 side by side; in (b1 + b2)^2 and b2 / (b1 + b2) each is covered evenly.
    const auto [mesh, triangles] =
        makeTriangles({{{0, 0, 0}, {2, 0, 0}, {0, 1, 0}}, {{5, 0, 0}, {2, 0, 0}, {0, 3, 0}}});
    const SampleGrid grid{0, 2, 0, 1, 16, 8};
    std::vector<uint64_t> counts(grid.cells() + 1);
    for (const EmittedParticle& p : samplePhotons({mesh}, triangles, uniformNumbers(5 * sampleCount, 11))) {
        const int which = p.position.x >= 5;
        const double b1 = (p.position.x - 5 * which) / 2, b2 = p.position.y / (1 + 2 * which),
                     sum = std::min(b1 + b2, 0.999999999);
        ++counts[grid.cell(which + sum * sum, sum > 0 ? std::min(b2 / sum, 1.0) : 0)];
    }
    std::vector<double> shares(grid.cells());
    for (int i = 0; i < grid.cells(); ++i) shares[i] = (i % 16 < 8 ? 0.25 : 0.75) / 64;
    EXPECT_GT(chiSquaredPValue(counts, shares), significanceLevel(statisticalTests));
}

} // namespace
} // namespace quasilux
