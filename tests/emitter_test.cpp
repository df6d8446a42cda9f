// Emitters: do directions and photons follow their densities, does the light that arrives agree with closed forms, and
// what happens close to, behind and far from the light. 49 statistical tests; false-alarm rate of the program 1e-4.
#include "support/chi_squared.h"
#include "support/emitter_cases.h"
#include "support/float_rounding.h"

#include <cmath>
#include <gtest/gtest.h>
#include <numbers>

namespace quasilux {
namespace {

using glm::dvec3;
using shared::Emitter;
using std::numbers::pi;

constexpr int statisticalTests = 59;
constexpr size_t sampleCount = 100000;

/// Points around the light of 0.5 x 0.5 at z = 1 that shines upwards: (x, y, height above its plane).
struct Receiver {
    const char* name;
    dvec3 point;
};
const Receiver receivers[] = {{"ordinary", {0.3, -0.2, 1.7}},
                              {"close above", {0.1, 0.05, 1.01}},
                              {"close to the edge", {0.26, 0.1, 1.01}},
                              {"above a corner", {0.25, 0.25, 1.1}},
                              {"grazing", {2.0, 0.7, 1.01}},
                              {"very close", {0.02, 0.03, 1.0001}},
                              {"beside, very low", {0.3, 0.1, 1.001}},
                              {"just not far", {0, 40, 50}},
                              {"far", {300, -200, 400}},
                              {"very far", {3000, 1000, 2000}}};

/// Ordinary light, a light rotated in space, and a thin one.
Emitter lights(int kind) {
    if (kind == 0) return makeRectangle({-0.25, -0.25, 1}, {0.5, 0, 0}, {0, 0.5, 0});
    const dvec3 u = glm::normalize(dvec3(1, 2, -0.5)), v = glm::normalize(glm::cross(u, dvec3(0.3, -1, 0.8)));
    return makeRectangle({10, -5, 3}, 0.5 * u, 0.02 * v);
}

dvec3 wide(const shared::Packed3& p) { return {p.x, p.y, p.z}; }

/// p-value of the sampled points on the rectangle, in shares of its sides, against `densityOf`'s density.
double rectangleFit(const Emitter& sampled, const Emitter& densityOf, dvec3 from) {
    const SampleGrid grid{0, 1, 0, 1, 12, 12};
    const dvec3 origin = wide(sampled.origin), u = wide(sampled.edgeU), v = wide(sampled.edgeV),
                n = wide(sampled.normal);
    std::vector<uint64_t> counts(grid.cells() + 1);
    for (const SampledEmitter& s : sampleDirections({sampled}, {}, from, uniformNumbers(3 * sampleCount, 3))) {
        const dvec3 p = from + s.distance * s.direction - origin;
        // Rounding may put a point next to the edge; clamping brings it back, far misses stay outside.
        const double a = glm::dot(p, u) / glm::dot(u, u), b = glm::dot(p, v) / glm::dot(v, v);
        const auto clamped = [](double x) { return x > -1e-3 && x < 1 + 1e-3 ? std::min(std::max(x, 0.0), 1.0) : x; };
        ++counts[s.valid ? grid.cell(clamped(a), clamped(b)) : grid.cells()];
    }
    const auto points = gridQuadrature(grid, 48);
    std::vector<dvec3> positions;
    for (const QuadraturePoint& q : points) positions.push_back(origin + q.u * u + q.v * v);
    const auto pdfs = directionPdfs({densityOf}, 0, from, positions, std::vector(positions.size(), n));
    std::vector<double> probabilities(grid.cells());
    for (size_t i = 0; i < points.size(); ++i) {
        const dvec3 offset = positions[i] - from;
        const double distance = glm::length(offset);
        const double solidAnglePerArea = -glm::dot(offset, n) / (distance * distance * distance);
        probabilities[points[i].cell] += pdfs[i] * solidAnglePerArea * sampled.area * points[i].weight;
    }
    return chiSquaredPValue(counts, probabilities);
}

/// Solid angle by the four-corner formula in long double.
double exactSolidAngle(const Emitter& light, dvec3 from) {
    const dvec3 corner = wide(light.origin) - from, u = wide(light.edgeU), v = wide(light.edgeV);
    const long double h = -glm::dot(corner, wide(light.normal));
    const long double x[] = {glm::dot(corner, u) / glm::length(u),
                             glm::dot(corner, u) / glm::length(u) + glm::length(u)};
    const long double y[] = {glm::dot(corner, v) / glm::length(v),
                             glm::dot(corner, v) / glm::length(v) + glm::length(v)};
    const auto part = [&](int i, int j) {
        return std::atan2(x[i] * y[j], h * std::sqrt(x[i] * x[i] + y[j] * y[j] + h * h));
    };
    return static_cast<double>(part(1, 1) - part(0, 1) - part(1, 0) + part(0, 0));
}

TEST(RectangleEmitter, directionsFollowTheDensityFromEverywhere) {
    for (const Receiver& r : receivers) {
        if (r.point.z < 1.0005) continue; // the peak falls between the grid's points; see the next test
        EXPECT_GT(rectangleFit(lights(0), lights(0), r.point), significanceLevel(statisticalTests)) << r.name;
    }
    const Emitter rotated = lights(1);
    const dvec3 centre = wide(rotated.origin) + 0.5 * (wide(rotated.edgeU) + wide(rotated.edgeV));
    for (double height : {0.005, 0.1, 3.0}) {
        const dvec3 from = centre + height * wide(rotated.normal) + 0.3 * wide(rotated.edgeU);
        EXPECT_GT(rectangleFit(rotated, rotated, from), significanceLevel(statisticalTests)) << height;
    }
}

TEST(RectangleEmitter, closeDirectionsAreUniformOverTheHemisphere) {
    const SampleGrid grid{0.1, 1, -pi, pi, 12, 16}; // cosine, azimuth
    for (double h : {1e-4, 1e-3, 0.01}) {
        const dvec3 from = roundToFloat(dvec3(0.02, -0.03, 1 + h));
        std::vector<uint64_t> counts(grid.cells() + 1);
        for (const SampledEmitter& s : sampleDirections({lights(0)}, {}, from, uniformNumbers(3 * sampleCount, 12)))
            ++counts[grid.cell(std::min(-s.direction.z, 1.0), std::atan2(s.direction.y, s.direction.x))];
        const double solidAngle = 0.9 * 2 * pi / grid.cells();
        const std::vector<double> probabilities(grid.cells(), solidAngle / exactSolidAngle(lights(0), from));
        EXPECT_GT(chiSquaredPValue(counts, probabilities), significanceLevel(statisticalTests)) << h;
    }
}

TEST(RectangleEmitter, negativeControlDensityOfAShiftedLightFails) {
    Emitter shifted = lights(0);
    shifted.origin.z += 0.05f;
    EXPECT_LT(rectangleFit(lights(0), shifted, receivers[0].point), significanceLevel(statisticalTests));
}

TEST(RectangleEmitter, densityIsOneOverTheSolidAngle) {
    for (const Receiver& r : receivers) {
        // Receiver as the kernel gets it, in float; the light's height above it is then known to half a unit in the
        // last place.
        const dvec3 from = roundToFloat(r.point);
        for (const SampledEmitter& s : sampleDirections({lights(0)}, {}, from, extremeNumbers(3))) {
            ASSERT_TRUE(s.valid) << r.name;
            const bool far = glm::length(from) > 100;
            ASSERT_NEAR(s.pdf * exactSolidAngle(lights(0), from), 1, far ? 5e-3 : 1e-4) << r.name;
        }
    }
}

TEST(RectangleEmitter, samplesLieOnTheLightAtTheEndsOfTheUnitInterval) {
    const Emitter light = lights(0);
    for (const Receiver& r : receivers)
        for (const SampledEmitter& s : sampleDirections({light}, {}, r.point, extremeNumbers(3))) {
            const dvec3 p = r.point + s.distance * s.direction;
            const double slack = 1e-6 * (1 + glm::length(r.point));
            ASSERT_NEAR(glm::length(s.direction), 1, 1e-6);
            ASSERT_NEAR(p.z, 1, slack) << r.name;
            ASSERT_LT(std::max(std::abs(p.x), std::abs(p.y)), 0.25 + slack) << r.name;
            ASSERT_TRUE(std::isfinite(s.pdf) && s.pdf > 0 && std::isfinite(s.radianceOverPdf.x)) << r.name;
        }
}

TEST(RectangleEmitter, isDarkFromBehindAndFromItsPlane) {
    for (const dvec3 from : {dvec3(0, 0, 0.99), dvec3(3, 4, -50), dvec3(1, 0, 1), dvec3(0.1, 0.1, 1)}) {
        for (const SampledEmitter& s : sampleDirections({lights(0)}, {}, from, extremeNumbers(3)))
            EXPECT_FALSE(s.valid);
        EXPECT_EQ(directionPdfs({lights(0)}, 0, from, {{0.1, -0.1, 1}}, {{0, 0, 1}})[0], 0);
    }
}

/// Mean over samples of radianceOverPdf times the cosine at a receiver that faces along `normal`, with its z score.
void expectIrradiance(const std::vector<Emitter>& emitters, const std::vector<shared::EmitterTriangle>& triangles,
                      dvec3 from, dvec3 normal, double exact, const char* what) {
    double sum = 0, squares = 0;
    for (const SampledEmitter& s : sampleDirections(emitters, triangles, from, uniformNumbers(3 * sampleCount, 4))) {
        const double e = s.valid ? s.radianceOverPdf.y * std::max(glm::dot(s.direction, normal), 0.0) : 0;
        sum += e;
        squares += e * e;
    }
    const double mean = sum / sampleCount,
                 deviation = std::sqrt(std::max(squares / sampleCount - mean * mean, 0.0) / sampleCount);
    const double z = std::max(std::abs(mean - exact) - 2e-6 * exact, 0.0) / (deviation + 1e-7 * exact);
    EXPECT_GT(normalPValue(z), significanceLevel(statisticalTests)) << what << ": " << mean << " instead of " << exact;
}

/// Irradiance of a receiver parallel to a rectangle under its corner, by the textbook configuration factor.
double cornerFactor(double a, double b, double h) {
    const double x = a / h, y = b / h;
    return (x / std::sqrt(1 + x * x) * std::atan(y / std::sqrt(1 + x * x)) +
            y / std::sqrt(1 + y * y) * std::atan(x / std::sqrt(1 + y * y))) /
           2;
}

TEST(RectangleEmitter, irradianceAgreesWithTheConfigurationFactor) {
    for (double h : {1e-4, 0.01, 0.1, 1.0, 30.0, 200.0}) {
        const double height = roundToFloat(1 + h) - 1; // of the point as the kernel gets it
        expectIrradiance({lights(0)}, {}, {-0.25, -0.25, 1 + h}, {0, 0, -1}, cornerFactor(0.5, 0.5, height), "corner");
        expectIrradiance({lights(0)}, {}, {0, 0, 1 + h}, {0, 0, -1}, 4 * cornerFactor(0.25, 0.25, height), "centre");
    }
}

TEST(SphereEmitter, irradianceFromOutsideAndInside) {
    const double r = 0.5;
    for (double d : {0.50001, 0.51, 1.0, 30.0, 3000.0}) {
        const double distance = roundToFloat(d);
        expectIrradiance({makeSphere({0, 0, 0}, r, 1)}, {}, {d, 0, 0}, {-1, 0, 0}, pi * r * r / (distance * distance),
                         "outside");
    }
    for (const dvec3 from : {dvec3(0, 0, 0), dvec3(0.1, 0.2, -0.3), dvec3(0.4, 0, 0.2)})
        expectIrradiance({makeSphere({0, 0, 0}, r, -1)}, {}, from, {0, 0, 1}, pi, "inside");
}

TEST(SphereEmitter, coneIsUniformAndItsPointsLieOnTheSphere) {
    const dvec3 centre(1, 2, 3);
    const double r = 0.25;
    const Emitter sphere = makeSphere(centre, r, 1);
    for (double d : {0.2505, 0.3, 2.0, 100.0}) {
        const dvec3 axis = glm::normalize(dvec3(-1, 0.3, 0.5)), from = centre - d * axis;
        const dvec3 s0 = glm::normalize(glm::cross(axis, dvec3(0, 0, 1))), t0 = glm::cross(axis, s0);
        const double oneMinusCosMax = r * r / (d * d) / (1 + std::sqrt(1 - r * r / (d * d)));
        const SampleGrid grid{0, 1, -pi, pi, 8, 12};
        std::vector<uint64_t> counts(grid.cells() + 1);
        for (const SampledEmitter& s : sampleDirections({sphere}, {}, from, uniformNumbers(3 * sampleCount, 5))) {
            const dvec3 offset = s.direction - axis;
            const double share = 0.5 * glm::dot(offset, offset) / oneMinusCosMax;
            // At 100 units the cone is 0.0025 wide: its rim is known to 1e-4 of its width.
            const double u = share < 1 + 1e-3 ? std::min(share, 1.0) : share;
            ++counts[s.valid ? grid.cell(u, std::atan2(glm::dot(s.direction, t0), glm::dot(s.direction, s0)))
                             : grid.cells()];
            ASSERT_NEAR(glm::length(from + s.distance * s.direction - centre), r, 3e-6 * (1 + d));
            ASSERT_NEAR(s.pdf * 2 * pi * oneMinusCosMax, 1, 1e-3);
        }
        EXPECT_GT(chiSquaredPValue(counts, std::vector<double>(grid.cells(), 1.0 / grid.cells())),
                  significanceLevel(statisticalTests))
            << d;
    }
}

TEST(SphereEmitter, outwardSphereIsDarkFromInside) {
    for (const SampledEmitter& s :
         sampleDirections({makeSphere({0, 0, 0}, 0.5, 1)}, {}, {0.1, 0, 0}, extremeNumbers(3)))
        EXPECT_FALSE(s.valid);
}

TEST(TriangleEmitter, agreesWithARectangleOfTheSameShape) {
    const auto [mesh, triangles] =
        makeTriangles({{{-0.25, -0.25, 1}, {0.5, 0, 0}, {0, 0.5, 0}}, {{0.25, 0.25, 1}, {-0.5, 0, 0}, {0, -0.5, 0}}});
    for (double h : {0.1, 1.0, 30.0})
        expectIrradiance({mesh}, triangles, {-0.25, -0.25, 1 + h}, {0, 0, -1},
                         cornerFactor(0.5, 0.5, roundToFloat(1 + h) - 1), "triangles");
    for (const SampledEmitter& s : sampleDirections({mesh}, triangles, {0, 0, 0.5}, extremeNumbers(3)))
        EXPECT_FALSE(s.valid) << "behind";
}

TEST(PointEmitter, followsTheInverseSquareLaw) {
    const auto s = sampleDirections({makePoint({0, 0, 2})}, {}, {0, 0, 5}, {0.3f, 0.1f, 0.9f})[0];
    EXPECT_TRUE(s.valid);
    EXPECT_FLOAT_EQ(float(s.distance), 3);
    EXPECT_FLOAT_EQ(float(s.radianceOverPdf.x), 1.0f / 9);
    EXPECT_EQ(s.direction, dvec3(0, 0, -1));
    EXPECT_EQ(s.pdf, 0);
    EXPECT_FALSE(sampleDirections({makePoint({0, 0, 2})}, {}, {0, 0, 2}, {0.3f, 0.1f, 0.9f})[0].valid);
}

TEST(ConstantEmitter, everyPlaneReceivesPiTimesItsRadiance) {
    const Emitter sky = makeConstant({1, 2, 3}, 2);
    for (const dvec3 normal : {dvec3(0, 0, 1), dvec3(0, 0, -1), glm::normalize(dvec3(1, -2, 0.5))})
        expectIrradiance({sky}, {}, {0.3, 2, 4}, normal, pi, "sky");
}

TEST(ConstantEmitter, directionsAreUniformAndFollowTheDensity) {
    const SampleGrid sphere{-1, 1, -pi, pi, 12, 12};
    std::vector<uint64_t> counts(sphere.cells() + 1);
    Emitter sky = makeConstant({0, 0, 0}, 1);
    for (const SampledEmitter& s : sampleDirections({sky}, {}, {0, 0, 0}, uniformNumbers(3 * sampleCount, 13))) {
        ++counts[sphere.cell(std::min(std::max(s.direction.z, -1.0), 1.0), std::atan2(s.direction.y, s.direction.x))];
        ASSERT_TRUE(s.valid && std::isinf(s.distance));
        ASSERT_NEAR(s.pdf * 4 * pi, 1, 1e-6);
    }
    EXPECT_GT(chiSquaredPValue(counts, std::vector<double>(sphere.cells(), 1.0 / sphere.cells())),
              significanceLevel(statisticalTests));
    sky.selectionProbability = 0.25f;
    EXPECT_NEAR(directionPdfs({sky}, 0, {0, 0, 0}, {{0, 0, 9}}, {{0, 0, -1}})[0] * 16 * pi, 1, 1e-6);
}

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

/// One emitter of each kind, chosen with unequal probabilities.
struct Mixture {
    std::vector<Emitter> emitters;
    std::vector<shared::EmitterTriangle> triangles;
};

Mixture mixture() {
    auto [mesh, triangles] = makeTriangles({{{0, 0, 5}, {1, 0, 0}, {0, 1, 0}}, {{4, 0, 5}, {0, 2, 0}, {1, 0, 1}}});
    Mixture m{{lights(0), mesh, makeSphere({-3, 0, 2}, 0.5, 1), makePoint({0, 3, 2})}, triangles};
    setSelection(m.emitters, {0.1, 0.4, 0.3, 0.2});
    return m;
}

TEST(EmitterSelection, sampledDensityIsThatOfTheChosenEmitter) {
    const Mixture m = mixture();
    const dvec3 from(0.2, 0.1, 9);
    const auto numbers = uniformNumbers(3 * 4000, 6);
    const auto samples = sampleDirections(m.emitters, m.triangles, from, numbers);
    const dvec3 mesh[] = {{0, 0, 1}, glm::normalize(glm::cross(dvec3(0, 2, 0), dvec3(1, 0, 1)))};
    size_t compared = 0;
    for (size_t i = 0; i < samples.size(); ++i) {
        const SampledEmitter& s = samples[i];
        if (!s.valid) continue;
        const float u = numbers[3 * i];
        const unsigned index = u < 0.1f ? 0 : u < 0.5f ? 1 : u < 0.8f ? 2 : 3;
        const dvec3 p = from + s.distance * s.direction;
        const dvec3 normals[] = {{0, 0, 1}, mesh[p.x > 2], glm::normalize(p - dvec3(-3, 0, 2)), -s.direction};
        const double pdf = directionPdfs(m.emitters, index, from, {p}, {normals[index]})[0];
        ASSERT_NEAR(s.pdf, pdf, 1e-4 * pdf) << "emitter " << index;
        if (index < 3) {
            ASSERT_NEAR(s.radianceOverPdf.x * s.pdf, 1, 1e-5);
        }
        if (++compared == 400) break;
    }
    EXPECT_EQ(compared, 400u);
}

TEST(EmitterSelection, negativeControlForgottenSelectionProbabilityShows) {
    Mixture m = mixture();
    const dvec3 from(0.2, 0.1, 9);
    const double right = directionPdfs(m.emitters, 0, from, {{0, 0, 1}}, {{0, 0, 1}})[0];
    m.emitters[0].selectionProbability = 1;
    EXPECT_NEAR(directionPdfs(m.emitters, 0, from, {{0, 0, 1}}, {{0, 0, 1}})[0] / right, 10, 1e-4);
}

TEST(EmittedPhotons, carryTheFluxOfAllEmittersAndFollowTheSelection) {
    const Mixture m = mixture();
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
    const Emitter light = lights(1);
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
