// Homogeneous media: free flight against its mixture density, unbiased by channel, finite at the extremes;
// transmittance; the medium beyond a surface. 110 chi-squared and z tests; false-alarm rate of the program 1e-4
// (support/chi_squared.h).
#include "shared_types.h"
#include "support/chi_squared.h"
#include "support/test_kernels.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <glm/glm.hpp>
#include <gtest/gtest.h>
#include <limits>

namespace quasilux {
namespace {

using glm::dvec3;

constexpr float infinity = std::numeric_limits<float>::infinity();
constexpr size_t sampleCount = 200000;

struct FlightCase {
    std::string name;
    dvec3 sigma, throughput;
    float tMax;

    bool grey() const { return sigma.x == sigma.y && sigma.y == sigma.z; }
    dvec3 share() const { return throughput / (throughput.x + throughput.y + throughput.z); }
    /// Probability of a collision before `t`.
    double cdf(double t) const {
        double sum = 0;
        for (int k = 0; k < 3; ++k)
            if (sigma[k] > 0) sum -= share()[k] * std::expm1(-sigma[k] * t);
        return sum;
    }
};

const std::vector<FlightCase>& flightCases() {
    static const std::vector<FlightCase> all{
        {"grey", {2, 2, 2}, {1, 1, 1}, 0.7f},
        {"grey, coloured path", {0.5, 0.5, 0.5}, {0.9, 0.1, 0.4}, 3},
        {"grey, without end", {3, 3, 3}, {1, 1, 1}, infinity},
        {"grey, thin", {1e-3, 1e-3, 1e-3}, {1, 1, 1}, 1},
        {"grey, deep", {1000, 1000, 1000}, {1, 1, 1}, 1},
        {"chromatic", {0.5, 1, 2}, {1, 1, 1}, 1.5f},
        {"chromatic, coloured path", {3, 0.3, 1}, {0.2, 1, 0.6}, 2},
        {"chromatic, without end", {0.5, 1, 8}, {1, 0.5, 1}, infinity},
        {"far apart", {0.01, 1, 100}, {1, 1, 1}, 1},
        {"thin", {5e-4, 1e-3, 2e-3}, {1, 1, 1}, 1},
        {"deep", {500, 1000, 2000}, {1, 1, 1}, 1},
        {"clear in one channel", {1, 0, 2}, {1, 1, 1}, 1},
        {"clear in one channel, without end", {1, 0, 2}, {1, 0.5, 1}, infinity},
        {"a channel without light", {1, 4, 0.2}, {1, 0, 2}, 1},
    };
    return all;
}

/// Per case a chi-squared test; in each chromatic one by channel two moments of the collisions and the escapes.
int statisticalTests() {
    int tests = 0;
    for (const FlightCase& c : flightCases()) tests += c.grey() ? 4 : 10;
    return tests;
}

shared::Medium makeMedium(dvec3 sigma) {
    shared::Medium medium{};
    medium.sigmaT = {static_cast<float>(sigma.x), static_cast<float>(sigma.y), static_cast<float>(sigma.z)};
    return medium;
}

Program& program(bool chromatic) {
    static Program grey = testProgram("medium.cl"), coloured = testProgram("medium.cl", "-DHAS_CHROMATIC_MEDIA");
    return chromatic ? coloured : grey;
}

struct Flight {
    double distance;
    bool collided;
    dvec3 weight;
};

std::vector<Flight> sampleFlights(bool chromatic, const FlightCase& c, const std::vector<float>& u) {
    const size_t count = u.size() / 2;
    Buffer<shared::Medium> m(testDevice(), std::vector{makeMedium(c.sigma)}, "medium");
    Buffer<float> in(testDevice(), u, "numbers"), out(testDevice(), 5 * count, "flights");
    program(chromatic)
        .kernel("sampleFlights")
        .launch(count, m, float(c.throughput.x), float(c.throughput.y), float(c.throughput.z), c.tMax, in, out,
                cl_uint(count));
    const auto r = out.read();
    std::vector<Flight> flights(count);
    for (size_t i = 0; i < count; ++i)
        flights[i] = {r[5 * i], r[5 * i + 1] != 0, {r[5 * i + 2], r[5 * i + 3], r[5 * i + 4]}};
    return flights;
}

std::vector<Flight> sampleFlights(const FlightCase& c, uint64_t seed) {
    return sampleFlights(!c.grey(), c, uniformNumbers(2 * sampleCount, seed));
}

/// p-value of the distances of collisions, and of their number, against the density of `assumed`.
double distanceFit(const FlightCase& assumed, const std::vector<Flight>& flights) {
    const double all = assumed.cdf(assumed.tMax);
    const SampleGrid grid{0, all, 0, 1, 50, 1};
    std::vector<uint64_t> counts(grid.cells() + 1);
    for (const Flight& f : flights)
        ++counts[f.collided ? grid.cell(std::min(assumed.cdf(f.distance), all), 0.5) : grid.cells()];
    return chiSquaredPValue(counts, std::vector<double>(grid.cells(), all / grid.cells()));
}

TEST(FreeFlight, followsTheMixtureDensity) {
    for (const FlightCase& c : flightCases())
        EXPECT_GT(distanceFit(c, sampleFlights(c, 51)), significanceLevel(statisticalTests())) << c.name;
}

TEST(FreeFlight, negativeControlDensityOfOneChannelFails) {
    const FlightCase& c = flightCases()[5];
    FlightCase wrong = c;
    wrong.sigma = dvec3(c.sigma.y);
    EXPECT_LT(distanceFit(wrong, sampleFlights(c, 51)), significanceLevel(statisticalTests()));
    wrong = c;
    wrong.throughput = {1, 1, 1.3};
    EXPECT_LT(distanceFit(wrong, sampleFlights(c, 51)), significanceLevel(statisticalTests()));
}

/// What a flight contributes to one quantity of one channel, per unit of the channel's throughput before it.
using Measure = std::function<double(const Flight&)>;

/// Two-sided p-value of the mean of weight times `measure` in channel k.
double meanFit(const std::vector<Flight>& flights, int k, const Measure& measure, double exact) {
    double sum = 0, sumOfSquares = 0;
    for (const Flight& f : flights) {
        const double value = f.weight[k] * measure(f);
        sum += value;
        sumOfSquares += value * value;
    }
    const auto n = static_cast<double>(flights.size());
    const double mean = sum / n, error = std::sqrt(std::max(sumOfSquares / n - mean * mean, 0.0) / n);
    // 1e-6 for rounding, where the values hardly vary, and for contributions too rare to be met.
    return normalPValue(std::max(std::abs(mean - exact) - 1e-6, 0.0) / std::max(error, 1e-12));
}

double escape(const Flight& f) { return f.collided ? 0 : 1; }
double collision(const Flight& f) { return f.collided ? 1 : 0; }
double attenuated(const Flight& f) { return f.collided ? std::exp(-2 * f.distance) : 0; }

double exactEscape(double sigma, double tMax) { return sigma > 0 ? std::exp(-sigma * tMax) : 1; }
/// Integral of sigma exp(-sigma t) exp(-a t) up to tMax.
double exactCollision(double sigma, double tMax, double a) {
    return sigma > 0 ? -sigma / (sigma + a) * std::expm1(-(sigma + a) * tMax) : 0;
}

/// The least p-value over the channels that carry light.
double leastFit(const FlightCase& c, const std::vector<Flight>& flights) {
    double least = 1;
    for (int k = 0; k < (c.grey() ? 1 : 3); ++k) {
        if (c.throughput[k] == 0) continue;
        least = std::min({least, meanFit(flights, k, escape, exactEscape(c.sigma[k], c.tMax)),
                          meanFit(flights, k, collision, exactCollision(c.sigma[k], c.tMax, 0)),
                          meanFit(flights, k, attenuated, exactCollision(c.sigma[k], c.tMax, 2))});
    }
    return least;
}

TEST(FreeFlight, isUnbiasedInEachChannel) {
    for (const FlightCase& c : flightCases())
        EXPECT_GT(leastFit(c, sampleFlights(c, 52)), significanceLevel(statisticalTests())) << c.name;
}

/// The flights with their weights as other densities would give them: `density(channel)` by distance and collision.
std::vector<Flight> reweighted(const FlightCase& c, std::vector<Flight> flights,
                               const std::function<double(const dvec3&, size_t)>& density) {
    for (size_t i = 0; i < flights.size(); ++i) {
        Flight& f = flights[i];
        const dvec3 transmitted = glm::exp(-c.sigma * f.distance),
                    values = f.collided ? c.sigma * transmitted : transmitted;
        f.weight = values / density(values, i);
    }
    return flights;
}

/// Channel that the kernel draws the i-th distance from.
int chosenChannel(const FlightCase& c, const std::vector<float>& u, size_t i) {
    const dvec3 share = c.share();
    return u[2 * i + 1] < share.x ? 0 : (u[2 * i + 1] < share.x + share.y ? 1 : 2);
}

double largestThroughput(const FlightCase& c, const std::vector<Flight>& flights) {
    double largest = 0;
    for (const Flight& f : flights)
        for (int k = 0; k < 3; ++k) largest = std::max(largest, f.weight[k] * c.throughput[k]);
    return largest / (c.throughput.x + c.throughput.y + c.throughput.z);
}

TEST(FreeFlight, throughputStaysBelowTheSumOfItsChannels) {
    for (const FlightCase& c : flightCases()) {
        if (c.grey()) {
            for (const Flight& f : sampleFlights(c, 53)) ASSERT_EQ(f.weight, dvec3(1)) << c.name;
        } else {
            EXPECT_LT(largestThroughput(c, sampleFlights(c, 53)), 1 + 1e-6) << c.name;
        }
    }
}

TEST(FreeFlight, negativeControlOtherDensitiesThanTheMixtureFail) {
    // Where each channel can collide, the chosen channel's density alone is unbiased too, but has no bound.
    const FlightCase &farApart = flightCases()[8], &clearInOne = flightCases()[11], &coloured = flightCases()[6];
    const auto u = uniformNumbers(2 * sampleCount, 52);
    const auto byChosen = [&](const FlightCase& c) {
        return reweighted(c, sampleFlights(c, 52),
                          [&](const dvec3& values, size_t i) { return values[chosenChannel(c, u, i)]; });
    };
    EXPECT_GT(largestThroughput(farApart, byChosen(farApart)), 10);
    EXPECT_LT(leastFit(clearInOne, byChosen(clearInOne)), significanceLevel(statisticalTests()));
    const auto equalShares = reweighted(coloured, sampleFlights(coloured, 52), [](const dvec3& values, size_t) {
        return (values.x + values.y + values.z) / 3;
    });
    EXPECT_LT(leastFit(coloured, equalShares), significanceLevel(statisticalTests()));
    // The control of the controls: the mixture itself, by the same road, passes.
    const auto mixture = reweighted(coloured, sampleFlights(coloured, 52),
                                    [&](const dvec3& values, size_t) { return glm::dot(values, coloured.share()); });
    EXPECT_GT(leastFit(coloured, mixture), significanceLevel(statisticalTests()));
}

TEST(FreeFlight, chromaticKernelsTreatGreyMediaAlike) {
    const auto u = uniformNumbers(2 * 1000, 54);
    for (const FlightCase& c : flightCases()) {
        if (!c.grey()) continue;
        const auto plain = sampleFlights(false, c, u), chromatic = sampleFlights(true, c, u);
        for (size_t i = 0; i < plain.size(); ++i) {
            ASSERT_EQ(plain[i].collided, chromatic[i].collided);
            ASSERT_EQ(plain[i].distance, chromatic[i].distance);
            for (int k = 0; k < 3; ++k) ASSERT_NEAR(chromatic[i].weight[k], 1, 1e-6);
        }
    }
}

TEST(FreeFlight, isFiniteAtTheExtremes) {
    const auto u = extremeNumbers(2);
    const std::vector<dvec3> sigmas{{0, 0, 0},        {0, 0, 1},        {1, 0, 0},     {1e-3, 1, 1e3},
                                    {1e6, 1e-6, 1e6}, {1e-30, 1, 1e30}, {1e3, 1e3, 0}, {5, 5, 5}};
    const std::vector<dvec3> throughputs{{1, 1, 1}, {1, 0, 0},        {0, 0, 1},
                                         {0, 0, 0}, {1e-30, 1, 1e30}, {1, 1e-30, 1e-20}};
    for (const dvec3& sigma : sigmas)
        for (const dvec3& throughput : throughputs)
            for (float tMax : {1e-6f, 1.0f, 1e6f, 1e30f, infinity}) {
                const FlightCase c{"", sigma, throughput, tMax};
                for (const Flight& f : sampleFlights(true, c, u)) {
                    ASSERT_TRUE(f.distance >= 0 && f.distance <= tMax);
                    ASSERT_EQ(f.collided, f.distance < tMax);
                    ASSERT_TRUE(sigma != dvec3(0) || !f.collided);
                    for (int k = 0; k < 3; ++k) {
                        ASSERT_TRUE(std::isfinite(f.weight[k]) && f.weight[k] >= 0)
                            << sigma[0] << ' ' << sigma[1] << ' ' << sigma[2] << " to " << tMax;
                        ASSERT_LE(f.weight[k] * throughput[k],
                                  (throughput.x + throughput.y + throughput.z) * (1 + 1e-6));
                    }
                }
            }
    for (double sigma : {0.0, 1e-3, 1e3})
        for (float tMax : {1e-6f, 1.0f, infinity})
            for (const Flight& f : sampleFlights(false, {"", dvec3(sigma), dvec3(1), tMax}, u)) {
                ASSERT_TRUE(f.distance >= 0 && f.distance <= tMax);
                ASSERT_EQ(f.weight, dvec3(1));
            }
}

std::vector<dvec3> transmittances(bool chromatic, dvec3 sigma, const std::vector<float>& distances) {
    Buffer<shared::Medium> m(testDevice(), std::vector{makeMedium(sigma)}, "medium");
    Buffer<float> in(testDevice(), distances, "distances"), out(testDevice(), 3 * distances.size(), "transmittances");
    program(chromatic).kernel("transmittances").launch(distances.size(), m, in, out, cl_uint(distances.size()));
    const auto r = out.read();
    std::vector<dvec3> result;
    for (size_t i = 0; i < distances.size(); ++i) result.emplace_back(r[3 * i], r[3 * i + 1], r[3 * i + 2]);
    return result;
}

TEST(Transmittance, isTheExponential) {
    const std::vector<float> distances{0, 1e-6f, 1e-3f, 0.1f, 1, 5, 20, 80};
    for (const dvec3& sigma : {dvec3(1), dvec3(1e-3), dvec3(0.25, 1, 0), dvec3(0, 0, 0)}) {
        const bool grey = sigma.x == sigma.y;
        const auto values = transmittances(!grey, sigma, distances);
        for (size_t i = 0; i < distances.size(); ++i)
            for (int k = 0; k < 3; ++k) {
                const double depth = double(float(sigma[k])) * distances[i], exact = std::exp(-depth);
                // Of the exponential, and of its argument's rounding.
                ASSERT_NEAR(values[i][k], exact, (3e-7 + 2e-7 * depth) * exact) << sigma[k] << " over " << distances[i];
            }
    }
}

TEST(Transmittance, isOneWithoutExtinctionAndZeroWithItOverInfiniteDistances) {
    EXPECT_EQ(transmittances(true, {0, 1, 1e3}, {infinity})[0], dvec3(1, 0, 0));
    EXPECT_EQ(transmittances(false, dvec3(0), {infinity})[0], dvec3(1));
    EXPECT_LT(transmittances(false, dvec3(1e-3), {infinity})[0].x, 1e-37);
    EXPECT_LT(transmittances(false, dvec3(1), {1e3f})[0].x, 1e-37);
}

std::vector<cl_uint> mediaBeyond(unsigned interior, unsigned exterior, unsigned current) {
    shared::Shape shape{};
    shape.interior = interior;
    shape.exterior = exterior;
    Buffer<shared::Shape> s(testDevice(), std::vector{shape}, "shape");
    Buffer<cl_uint> out(testDevice(), 4, "media");
    program(false).kernel("mediaBeyond").launch(1, s, cl_uint(current), out);
    return out.read();
}

TEST(MediumBeyond, isTheOneOnThatSideOrTheSameAsBefore) {
    EXPECT_EQ(mediaBeyond(4, 7, 9), (std::vector<cl_uint>{7, 4, 1, 1}));
    EXPECT_EQ(mediaBeyond(4, MEDIUM_NONE, 9), (std::vector<cl_uint>{MEDIUM_NONE, 4, 0, 1}));
    EXPECT_EQ(mediaBeyond(MEDIUM_UNCHANGED, MEDIUM_UNCHANGED, 9), (std::vector<cl_uint>{9, 9, 1, 1}));
    EXPECT_EQ(mediaBeyond(MEDIUM_UNCHANGED, MEDIUM_UNCHANGED, MEDIUM_NONE),
              (std::vector<cl_uint>{MEDIUM_NONE, MEDIUM_NONE, 0, 0}));
}

} // namespace
} // namespace quasilux
