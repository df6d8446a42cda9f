// Emitters as seen from a point: do sampled directions follow their densities, does the light that arrives agree with
// closed forms, and what happens close to, behind and far from the light. False-alarm rate of the program 1e-4.
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

constexpr int statisticalTests = 47;
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
        EXPECT_GT(rectangleFit(testRectangle(0), testRectangle(0), r.point), significanceLevel(statisticalTests))
            << r.name;
    }
    const Emitter rotated = testRectangle(1);
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
        for (const SampledEmitter& s :
             sampleDirections({testRectangle(0)}, {}, from, uniformNumbers(3 * sampleCount, 12)))
            ++counts[grid.cell(std::min(-s.direction.z, 1.0), std::atan2(s.direction.y, s.direction.x))];
        const double solidAngle = 0.9 * 2 * pi / grid.cells();
        const std::vector<double> probabilities(grid.cells(), solidAngle / exactSolidAngle(testRectangle(0), from));
        EXPECT_GT(chiSquaredPValue(counts, probabilities), significanceLevel(statisticalTests)) << h;
    }
}

TEST(RectangleEmitter, negativeControlDensityOfAShiftedLightFails) {
    Emitter shifted = testRectangle(0);
    shifted.origin.z += 0.05f;
    EXPECT_LT(rectangleFit(testRectangle(0), shifted, receivers[0].point), significanceLevel(statisticalTests));
}

TEST(RectangleEmitter, densityIsOneOverTheSolidAngle) {
    for (const Receiver& r : receivers) {
        // Receiver as the kernel gets it, in float; the light's height above it is then known to half a unit in the
        // last place.
        const dvec3 from = roundToFloat(r.point);
        for (const SampledEmitter& s : sampleDirections({testRectangle(0)}, {}, from, extremeNumbers(3))) {
            ASSERT_TRUE(s.valid) << r.name;
            const bool far = glm::length(from) > 100;
            ASSERT_NEAR(s.pdf * exactSolidAngle(testRectangle(0), from), 1, far ? 5e-3 : 1e-4) << r.name;
        }
    }
}

TEST(RectangleEmitter, samplesLieOnTheLightAtTheEndsOfTheUnitInterval) {
    const Emitter light = testRectangle(0);
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
        for (const SampledEmitter& s : sampleDirections({testRectangle(0)}, {}, from, extremeNumbers(3)))
            EXPECT_FALSE(s.valid);
        EXPECT_EQ(directionPdfs({testRectangle(0)}, 0, from, {{0.1, -0.1, 1}}, {{0, 0, 1}})[0], 0);
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
        expectIrradiance({testRectangle(0)}, {}, {-0.25, -0.25, 1 + h}, {0, 0, -1}, cornerFactor(0.5, 0.5, height),
                         "corner");
        expectIrradiance({testRectangle(0)}, {}, {0, 0, 1 + h}, {0, 0, -1}, 4 * cornerFactor(0.25, 0.25, height),
                         "centre");
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

TEST(DirectionalEmitter, comesFromOneDirectionWithItsIrradiance) {
    const dvec3 along = glm::normalize(dvec3(1, -2, 3));
    const auto s = sampleDirections({makeDirectional(along, {5, 6, 7}, 2)}, {}, {4, 6, 7}, {0.3f, 0.1f, 0.9f})[0];
    EXPECT_TRUE(s.valid && std::isinf(s.distance));
    EXPECT_LT(glm::length(s.direction + along), 1e-7);
    EXPECT_FLOAT_EQ(float(s.radianceOverPdf.x), 1);
    EXPECT_EQ(s.pdf, 0);
    expectIrradiance({makeDirectional(along, {5, 6, 7}, 2)}, {}, {4, 6, 7}, {0, 0, -1}, along.z, "beam");
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

TEST(EmitterSelection, sampledDensityIsThatOfTheChosenEmitter) {
    const EmitterMixture m = mixedEmitters();
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
    EmitterMixture m = mixedEmitters();
    const dvec3 from(0.2, 0.1, 9);
    const double right = directionPdfs(m.emitters, 0, from, {{0, 0, 1}}, {{0, 0, 1}})[0];
    m.emitters[0].selectionProbability = 1;
    EXPECT_NEAR(directionPdfs(m.emitters, 0, from, {{0, 0, 1}}, {{0, 0, 1}})[0] / right, 10, 1e-4);
}

} // namespace
} // namespace quasilux
