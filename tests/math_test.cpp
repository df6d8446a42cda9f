// Errors of the kernels' elementary functions against double, and the geometry helpers of kernels/math.clh.
#include "shared_types.h"
#include "support/test_kernels.h"

#include <cmath>
#include <functional>
#include <glm/glm.hpp>
#include <gtest/gtest.h>
#include <random>

namespace quasilux {
namespace {

using shared::Packed3;

enum Function : cl_uint { Log2, Exp2, Log1p, Expm1Neg, SinTwoPi, CosTwoPi, Atan2Upper, Pow };

Program& program() {
    static Program built = testProgram("math.cl");
    return built;
}

std::vector<float> evaluate(Function function, const std::vector<float>& x, std::vector<float> y = {}) {
    y.resize(x.size());
    Buffer<float> xs(testDevice(), x, "x"), ys(testDevice(), y, "y"), result(testDevice(), x.size(), "result");
    program().kernel("evaluateFunction").launch(x.size(), cl_uint(function), xs, ys, result, cl_uint(x.size()));
    return result.read();
}

std::vector<float> evenly(double from, double to, int count = 200000) {
    std::vector<float> x(count);
    for (int i = 0; i < count; ++i) x[i] = static_cast<float>(from + (to - from) * i / (count - 1));
    return x;
}

std::vector<float> logarithmically(double from, double to) {
    std::vector<float> x = evenly(std::log(from), std::log(to));
    for (float& value : x) value = std::exp(value);
    return x;
}

/// Largest of |result - exact| / scale(x).
double largestError(const std::vector<float>& x, const std::vector<float>& result,
                    const std::function<double(double)>& exact, const std::function<double(double)>& scale) {
    double largest = 0;
    for (size_t i = 0; i < x.size(); ++i) {
        const double error = std::abs(result[i] - exact(x[i])) / scale(x[i]);
        if (!(error <= largest)) largest = error; // takes NaN too
    }
    return largest;
}

double relativeError(Function function, const std::vector<float>& x, const std::function<double(double)>& exact) {
    return largestError(x, evaluate(function, x), exact,
                        [&](double v) { return std::max(std::abs(exact(v)), 1e-300); });
}

TEST(Polynomials, log2) {
    const auto exact = [](double x) { return std::log2(x); };
    const auto scale = [](double x) { return std::max(std::abs(std::log2(x)), std::min(1.0, std::abs(x - 1))); };
    for (const auto& x : {logarithmically(1.2e-38, 3e38), evenly(0.5, 2.0)}) {
        std::vector<float> notOne;
        for (float v : x)
            if (v != 1) notOne.push_back(v);
        EXPECT_LT(largestError(notOne, evaluate(Log2, notOne), exact, scale), 2e-7);
    }
    EXPECT_EQ(evaluate(Log2, {1.0f})[0], 0.0f);
}

TEST(Polynomials, exp2) {
    const auto exact = [](double x) { return std::exp2(x); };
    EXPECT_LT(relativeError(Exp2, evenly(-126, 127.99), exact), 2e-7);
    EXPECT_LT(relativeError(Exp2, evenly(-1, 1), exact), 2e-7);
    const auto ends = evaluate(Exp2, {0.0f, -1e30f, -200.0f, 128.0f, 1e30f});
    EXPECT_EQ(ends[0], 1.0f);
    EXPECT_EQ(ends[1], 0.0f);
    EXPECT_EQ(ends[2], 0.0f);
    EXPECT_TRUE(std::isinf(ends[3]) && std::isinf(ends[4]));
}

TEST(Polynomials, log1pIsRelativelyAccurate) {
    const auto exact = [](double x) { return std::log1p(x); };
    EXPECT_LT(relativeError(Log1p, logarithmically(1e-30, 1e30), exact), 4e-7);
    std::vector<float> negative = logarithmically(1e-30, 0.9999999);
    for (float& x : negative) x = -x;
    negative.push_back(-(1 - 0x1p-24f));
    EXPECT_LT(relativeError(Log1p, negative, exact), 4e-7);
    EXPECT_EQ(evaluate(Log1p, {0.0f})[0], 0.0f);
}

TEST(Polynomials, expm1NegIsRelativelyAccurate) {
    const auto exact = [](double x) { return -std::expm1(-x); };
    EXPECT_LT(relativeError(Expm1Neg, logarithmically(1e-30, 1e3), exact), 3e-7);
    EXPECT_EQ(evaluate(Expm1Neg, {0.0f})[0], 0.0f);
}

TEST(Polynomials, sineAndCosine) {
    const double twoPi = 2 * std::acos(-1.0);
    const auto one = [](double) { return 1.0; };
    const auto x = evenly(-1, 1);
    EXPECT_LT(largestError(
                  x, evaluate(SinTwoPi, x), [&](double u) { return std::sin(twoPi * u); }, one),
              2e-7);
    EXPECT_LT(largestError(
                  x, evaluate(CosTwoPi, x), [&](double u) { return std::cos(twoPi * u); }, one),
              2e-7);
    EXPECT_LT(relativeError(SinTwoPi, logarithmically(1e-20, 0.125), [&](double u) { return std::sin(twoPi * u); }),
              2.5e-7);
}

// The same polynomials: only what the compiler fuses may differ.
TEST(Polynomials, eightAtATimeAgreeWithOne) {
    const auto positive = logarithmically(1e-30, 1e30), turns = evenly(-1, 1), exponents = evenly(-120, 120);
    const std::vector<float> powers(positive.size(), 1.0f / 3);
    for (const auto& [function, x] : {std::pair(Log2, positive),
                                      {Exp2, exponents},
                                      {Log1p, positive},
                                      {SinTwoPi, turns},
                                      {CosTwoPi, turns},
                                      {Pow, positive}}) {
        const auto one = evaluate(function, x, powers);
        // Logarithms and cosines cross 0 away from 0; there only the error for 1 is promised.
        const bool relative = function != Log2 && function != CosTwoPi && function != SinTwoPi;
        const auto allowed = [&](float v) { return 4e-7f * (relative ? std::abs(v) : std::max(1.0f, std::abs(v))); };
        Buffer<float> xs(testDevice(), x, "x"), ys(testDevice(), powers, "y"), result(testDevice(), x.size(), "result");
        program()
            .kernel("evaluateFunction8")
            .launch(x.size() / 8, cl_uint(function), xs, ys, result, cl_uint(x.size() / 8));
        const auto eight = result.read();
        for (size_t i = 0; i < x.size(); ++i)
            ASSERT_NEAR(eight[i], one[i], allowed(one[i])) << "function " << function << " of " << x[i];
    }
}

TEST(Polynomials, atan2OfTheUpperHalfPlane) {
    std::vector<float> x, y;
    for (float r : logarithmically(1e-20, 1e20)) {
        x.insert(x.end(), {1.0f, -1.0f, r, -r});
        y.insert(y.end(), {r, r, 1.0f, 1.0f});
    }
    const auto angle = evaluate(Atan2Upper, x, y);
    double largest = 0;
    for (size_t i = 0; i < x.size(); ++i) {
        const double exact = std::atan2(double(y[i]), double(x[i]));
        largest = std::max(largest, std::abs(angle[i] - exact) / exact);
    }
    EXPECT_LT(largest, 3e-7);
    EXPECT_EQ(evaluate(Atan2Upper, {0.0f}, {0.0f})[0], 0.0f);
}

TEST(Polynomials, powLosesWithTheSizeOfTheLogarithm) {
    std::vector<float> x, y;
    for (float base : logarithmically(1e-6, 1e3))
        for (float exponent : {0.0f, 0.45f, 2.2f}) {
            x.push_back(base);
            y.push_back(exponent);
        }
    const auto power = evaluate(Pow, x, y);
    for (size_t i = 0; i < x.size(); ++i) {
        const double exact = std::pow(double(x[i]), double(y[i]));
        ASSERT_NEAR(power[i] / exact, 1, 2e-7 * std::max(1.0, std::abs(std::log2(exact)))) << x[i] << "^" << y[i];
    }
}

/// Random unit vectors, the axes, and vectors close to -z, where frames go wrong.
std::vector<Packed3> unitVectors() {
    std::mt19937 engine(1);
    std::normal_distribution<double> normal;
    std::vector<Packed3> vectors{{1, 0, 0}, {-1, 0, 0}, {0, 1, 0},           {0, -1, 0},
                                 {0, 0, 1}, {0, 0, -1}, {0, 0, -0.99999994f}};
    for (double tilt : {1e-7, 1e-4, 1e-2}) vectors.push_back({float(tilt), 0, -float(std::sqrt(1 - tilt * tilt))});
    for (int i = 0; i < 10000; ++i) {
        const glm::dvec3 v = glm::normalize(glm::dvec3(normal(engine), normal(engine), normal(engine)));
        vectors.push_back({float(v.x), float(v.y), float(v.z)});
    }
    return vectors;
}

glm::dvec3 wide(const Packed3& p) { return {p.x, p.y, p.z}; }

TEST(Frame, isRightHandedAndOrthonormalForEveryNormal) {
    const auto normals = unitVectors();
    Buffer<Packed3> in(testDevice(), normals, "normals"), out(testDevice(), 4 * normals.size(), "frames");
    program().kernel("makeFrames").launch(normals.size(), in, out, cl_uint(normals.size()));
    const auto frames = out.read();
    for (size_t i = 0; i < normals.size(); ++i) {
        const glm::dvec3 s = wide(frames[4 * i]), t = wide(frames[4 * i + 1]), n = wide(frames[4 * i + 2]);
        ASSERT_NEAR(glm::length(s), 1, 5e-7);
        ASSERT_NEAR(glm::length(t), 1, 5e-7);
        ASSERT_NEAR(glm::dot(s, t), 0, 5e-7);
        ASSERT_NEAR(glm::dot(s, n), 0, 5e-7);
        ASSERT_NEAR(glm::length(glm::cross(s, t) - n), 0, 1e-6);
        ASSERT_NEAR(glm::length(wide(frames[4 * i + 3]) - glm::dvec3(1, 2, 3)), 0, 4e-6);
    }
}

TEST(OffsetRayOrigin, movesALittleToTheSideOfTheNormalAtEveryScale) {
    std::vector<Packed3> points, normals;
    for (float scale : {0.0f, 1e-4f, 0.03f, 1.0f, 100.0f, 1e5f})
        for (const Packed3& n : unitVectors()) {
            points.push_back({scale, -scale, 0.5f * scale});
            normals.push_back(n);
        }
    Buffer<Packed3> in(testDevice(), points, "points"), ns(testDevice(), normals, "normals");
    Buffer<Packed3> out(testDevice(), points.size(), "moved");
    program().kernel("offsetOrigins").launch(points.size(), in, ns, out, cl_uint(points.size()));
    const auto moved = out.read();
    for (size_t i = 0; i < points.size(); ++i) {
        const double shift = glm::dot(wide(moved[i]) - wide(points[i]), wide(normals[i]));
        const double size = std::abs(points[i].x);
        ASSERT_GE(shift, size * 0x1p-23) << size; // more than half a unit in the last place, less than ten
        ASSERT_LE(shift, size * 0x1p-19) << size;
    }
}

TEST(Octahedral, roundTripKeepsDirections) {
    const auto vectors = unitVectors();
    Buffer<Packed3> in(testDevice(), vectors, "vectors"), out(testDevice(), vectors.size(), "decoded");
    program().kernel("octahedralRoundTrip").launch(vectors.size(), in, out, cl_uint(vectors.size()));
    const auto decoded = out.read();
    for (size_t i = 0; i < vectors.size(); ++i) {
        ASSERT_LT(glm::length(wide(decoded[i]) - wide(vectors[i])), 7e-5);
        if (i < 6) {
            ASSERT_EQ(wide(decoded[i]), wide(vectors[i])) << "an axis must stay exact";
        }
    }
}

TEST(Colour, luminanceIsRec709) {
    const std::vector<shared::Rgb> rgb{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {2, 2, 2}};
    Buffer<shared::Rgb> in(testDevice(), rgb, "colours");
    Buffer<float> out(testDevice(), 2 * rgb.size(), "luminances");
    program().kernel("colours").launch(rgb.size(), in, out, cl_uint(rgb.size()));
    const auto values = out.read();
    EXPECT_FLOAT_EQ(values[0], 0.2126f);
    EXPECT_FLOAT_EQ(values[2], 0.7152f);
    EXPECT_FLOAT_EQ(values[4], 0.0722f);
    EXPECT_FLOAT_EQ(values[6], 2.0f);
    EXPECT_EQ(values[1], 1.0f);
    EXPECT_EQ(values[7], 2.0f);
}

} // namespace
} // namespace quasilux
