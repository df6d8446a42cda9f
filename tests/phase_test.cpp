// Phase functions: their formulas in double, normalisation, sampling against the density, and the split by a level.
// 101 chi-squared and z tests; false-alarm rate of the program 1e-4 (support/chi_squared.h).
#include "shared_types.h"
#include "support/chi_squared.h"
#include "support/test_kernels.h"

#include <algorithm>
#include <cmath>
#include <glm/glm.hpp>
#include <gtest/gtest.h>
#include <limits>
#include <numbers>

namespace quasilux {
namespace {

using glm::dvec3;
using std::numbers::pi;

constexpr float infinity = std::numeric_limits<float>::infinity();
constexpr size_t sampleCount = 200000;
constexpr SampleGrid grid{0, 1, 0, 1, 20, 16}; // cumulative probability of the cosine, azimuth in turns

/// A phase function in double, of 1 - cos, which does not lose the peak's digits.
struct Phase {
    unsigned id;
    float g;

    double value(double oneMinusCos) const {
        if (id == PHASE_ISOTROPIC) return 1 / (4 * pi);
        if (id == PHASE_RAYLEIGH) return 3 / (16 * pi) * (1 + (1 - oneMinusCos) * (1 - oneMinusCos));
        return (1 - double(g) * g) / (4 * pi) * std::pow(squaredDistance(oneMinusCos), -1.5);
    }
    /// Probability of a smaller cosine.
    double cdf(double oneMinusCos) const {
        const double c = 1 - oneMinusCos;
        if (id == PHASE_RAYLEIGH) return 0.5 + 0.375 * (c + c * c * c / 3);
        // Of HG, (1-g^2)/(2g) (1/d - 1/(1+g)) with d the root below; written so that g = 0 is no special case.
        const double d = std::sqrt(squaredDistance(oneMinusCos));
        return (1.0 - g) * (2 - oneMinusCos) / (d * (1 + double(g) + d));
    }
    double oneMinusCosAt(double probability) const {
        double lower = 0, upper = 2;
        for (int i = 0; i < 60; ++i) (cdf(0.5 * (lower + upper)) > probability ? lower : upper) = 0.5 * (lower + upper);
        return 0.5 * (lower + upper);
    }
    double meanCosine() const { return g; }
    std::string name() const { return "phase " + std::to_string(id) + ", g = " + std::to_string(g); }

private:
    double squaredDistance(double oneMinusCos) const {
        return std::pow(1 - double(g), 2) + 2 * double(g) * oneMinusCos;
    }
};

const std::vector<Phase>& phases() {
    static const std::vector<Phase> all{{PHASE_ISOTROPIC, 0}, {PHASE_RAYLEIGH, 0}, {PHASE_HG, 0.99f}, {PHASE_HG, 0.9f},
                                        {PHASE_HG, 0.5f},     {PHASE_HG, 1e-3f},   {PHASE_HG, 0},     {PHASE_HG, -0.5f},
                                        {PHASE_HG, -0.9f},    {PHASE_HG, -0.99f}};
    return all;
}

const std::vector<dvec3>& directions() {
    static const std::vector<dvec3> all{
        {0, 0, 1}, {0, 0, -1}, glm::normalize(dvec3(0.3, -0.8, 0.5)), glm::normalize(dvec3(-1, 1e-4, -1e-3))};
    return all;
}

struct Split {
    Phase phase;
    float level;
};

const std::vector<Split>& splits() {
    static const std::vector<Split> all{{{PHASE_HG, 0.9f}, 0.1f},     {{PHASE_HG, 0.9f}, 1},
                                        {{PHASE_HG, 0.99f}, 0.1f},    {{PHASE_HG, -0.9f}, 0.05f},
                                        {{PHASE_HG, 0.5f}, 0.1f},     {{PHASE_RAYLEIGH, 0}, 0.08f},
                                        {{PHASE_ISOTROPIC, 0}, 0.05f}};
    return all;
}

/// Per phase function and direction a chi-squared and a z test; per split a z test and two chi-squared ones.
int statisticalTests() { return static_cast<int>(2 * phases().size() * directions().size() + 3 * splits().size()); }

shared::Medium makeMedium(const Phase& phase, float level = infinity) {
    shared::Medium medium{};
    medium.phase = phase.id;
    medium.g = phase.g;
    medium.level = level;
    return medium;
}

Program& program() {
    static Program all = testProgram("phase.cl", "-DHAS_PHASE_ISOTROPIC -DHAS_PHASE_HG -DHAS_PHASE_RAYLEIGH");
    return all;
}

/// Runs a kernel (medium, numbers, result, count) over `count` work-items.
std::vector<float> runOver(Program& where, const std::string& kernel, const shared::Medium& medium,
                           const std::vector<float>& numbers, size_t count, size_t resultSize) {
    Buffer<shared::Medium> m(testDevice(), std::vector{medium}, "medium");
    Buffer<float> in(testDevice(), numbers, "numbers"), out(testDevice(), resultSize, "result");
    where.kernel(kernel).launch(count, m, in, out, cl_uint(count));
    return out.read();
}

std::vector<float> phaseValues(const Phase& phase, const std::vector<float>& cosines, Program& where = program()) {
    return runOver(where, "phaseValues", makeMedium(phase), cosines, cosines.size(), cosines.size());
}

/// Directions after scattering, as they come from the device.
std::vector<dvec3> scattered(const Phase& phase, dvec3 direction, const std::vector<float>& u,
                             Program& where = program()) {
    const size_t count = u.size() / 2;
    Buffer<shared::Medium> m(testDevice(), std::vector{makeMedium(phase)}, "medium");
    Buffer<float> in(testDevice(), u, "numbers"), out(testDevice(), 3 * count, "directions");
    where.kernel("sampleDirections")
        .launch(count, m, float(direction.x), float(direction.y), float(direction.z), in, out, cl_uint(count));
    const auto values = out.read();
    std::vector<dvec3> result(count);
    for (size_t i = 0; i < count; ++i) result[i] = {values[3 * i], values[3 * i + 1], values[3 * i + 2]};
    return result;
}

/// All cosines in steps of 1/64, and ever closer to both ends. A multiple of eight.
std::vector<float> cosines() {
    std::vector<float> all;
    for (int i = -63; i < 64; ++i) all.push_back(static_cast<float>(i) / 64);
    for (int k = 7; k <= 24; ++k)
        for (float sign : {-1.0f, 1.0f}) all.push_back(sign * (1 - std::ldexp(1.0f, -k)));
    all.push_back(-1);
    while (all.size() % 8 != 0) all.push_back(1);
    return all;
}

double oneMinusCos(dvec3 a, dvec3 b) { return 1 - glm::dot(glm::normalize(a), glm::normalize(b)); }

/// Coordinates of a scattered direction in `grid`, uniform if it is distributed as `phase`.
std::pair<double, double> coordinates(const Phase& phase, dvec3 direction, dvec3 after) {
    const dvec3 s =
        glm::normalize(glm::cross(direction, std::abs(direction.x) < 0.6 ? dvec3(1, 0, 0) : dvec3(0, 1, 0)));
    const dvec3 t = glm::cross(direction, s);
    const double turns = std::atan2(glm::dot(after, t), glm::dot(after, s)) / (2 * pi) + 0.5;
    return {phase.cdf(std::clamp(oneMinusCos(direction, after), 0.0, 2.0)), turns};
}

double uniformFit(const Phase& phase, dvec3 direction, const std::vector<dvec3>& after) {
    std::vector<uint64_t> counts(grid.cells() + 1);
    for (const dvec3& d : after) {
        const auto [s, turns] = coordinates(phase, direction, d);
        ++counts[grid.cell(s, turns)];
    }
    return chiSquaredPValue(counts, std::vector<double>(grid.cells(), 1.0 / grid.cells()));
}

TEST(PhaseFunctions, agreeWithTheirFormulas) {
    const auto c = cosines();
    for (const Phase& phase : phases()) {
        const auto values = phaseValues(phase, c);
        for (size_t i = 0; i < c.size(); ++i) {
            const double exact = phase.value(1 - double(c[i]));
            ASSERT_NEAR(values[i], exact, 1e-6 * exact) << phase.name() << " at " << c[i];
        }
    }
}

TEST(PhaseFunctions, eightAtOnceAreTheScalarOnes) {
    const auto c = cosines();
    for (const Phase& phase : phases()) {
        const auto single = phaseValues(phase, c);
        const auto eight = runOver(program(), "phaseValuesByEight", makeMedium(phase), c, c.size() / 8, c.size());
        for (size_t i = 0; i < c.size(); ++i)
            ASSERT_NEAR(eight[i], single[i], 3e-7 * single[i]) << phase.name() << " at " << c[i];
    }
}

TEST(PhaseFunctions, areTheSameWhereTheyAreTheOnlyOneCompiled) {
    const char* options[] = {"-DHAS_PHASE_ISOTROPIC", "-DHAS_PHASE_HG", "-DHAS_PHASE_RAYLEIGH"};
    const auto u = uniformNumbers(2 * 64, 41);
    for (const Phase& phase : {Phase{PHASE_ISOTROPIC, 0}, Phase{PHASE_HG, 0.9f}, Phase{PHASE_RAYLEIGH, 0}}) {
        Program alone = testProgram("phase.cl", options[phase.id]);
        const auto together = phaseValues(phase, cosines()), values = phaseValues(phase, cosines(), alone);
        for (size_t i = 0; i < values.size(); ++i) ASSERT_NEAR(values[i], together[i], 3e-7 * together[i]);
        const auto after = scattered(phase, directions()[2], u),
                   afterAlone = scattered(phase, directions()[2], u, alone);
        for (size_t i = 0; i < after.size(); ++i) ASSERT_NEAR(glm::distance(after[i], afterAlone[i]), 0, 1e-6);
    }
}

TEST(PhaseFunctions, integrateToTheirCumulativeProbabilityAndToOne) {
    // Midpoint rule over cells of equal probability, each in as many steps: the peak gets its share of them.
    const int cells = 50, steps = 256;
    for (const Phase& phase : phases()) {
        std::vector<float> c;
        std::vector<double> width;
        for (int cell = 0; cell < cells; ++cell) {
            const double from = phase.oneMinusCosAt(double(cell) / cells);
            const double to = phase.oneMinusCosAt(double(cell + 1) / cells);
            for (int i = 0; i < steps; ++i) {
                c.push_back(static_cast<float>(1 - (from + (to - from) * (i + 0.5) / steps)));
                width.push_back((from - to) / steps);
            }
        }
        const auto values = phaseValues(phase, c);
        double sum = 0;
        for (size_t i = 0; i < c.size(); ++i) {
            sum += 2 * pi * values[i] * width[i];
            if ((i + 1) % steps == 0) {
                ASSERT_NEAR(sum, static_cast<double>(i + 1) / (cells * steps), 1e-4) << phase.name();
            }
        }
        EXPECT_NEAR(sum, 1, 1e-4) << phase.name();
    }
}

TEST(PhaseSampling, followsTheDensity) {
    const auto u = uniformNumbers(2 * sampleCount, 42);
    for (const Phase& phase : phases())
        for (const dvec3& direction : directions())
            EXPECT_GT(uniformFit(phase, direction, scattered(phase, direction, u)),
                      significanceLevel(statisticalTests()))
                << phase.name() << " along " << direction.x << ' ' << direction.y << ' ' << direction.z;
}

TEST(PhaseSampling, negativeControlWrongDensityFails) {
    const auto u = uniformNumbers(2 * sampleCount, 42);
    const dvec3 direction = directions()[2];
    const auto wrongFit = [&](const Phase& phase, const Phase& wrong) {
        return uniformFit(wrong, direction, scattered(phase, direction, u));
    };
    for (float g : {0.99f, 0.5f, 0.02f, -0.9f})
        EXPECT_LT(wrongFit({PHASE_HG, g}, {PHASE_HG, -g}), significanceLevel(statisticalTests()))
            << "sign of g = " << g;
    EXPECT_LT(wrongFit({PHASE_HG, 0.9f}, {PHASE_HG, 0.897f}), significanceLevel(statisticalTests()));
    EXPECT_LT(wrongFit({PHASE_RAYLEIGH, 0}, {PHASE_ISOTROPIC, 0}), significanceLevel(statisticalTests()));
}

TEST(PhaseSampling, meanCosineIsG) {
    const auto u = uniformNumbers(2 * sampleCount, 43);
    for (const Phase& phase : phases())
        for (const dvec3& direction : directions()) {
            double sum = 0, sumOfSquares = 0;
            for (const dvec3& d : scattered(phase, direction, u)) {
                const double deviation = 1 - phase.meanCosine() - oneMinusCos(direction, d);
                sum += deviation;
                sumOfSquares += deviation * deviation;
            }
            const double mean = sum / sampleCount, error = std::sqrt(sumOfSquares) / sampleCount;
            EXPECT_GT(normalPValue(mean / error), significanceLevel(statisticalTests()))
                << phase.name() << ": off by " << mean;
        }
}

TEST(PhaseSampling, givesUnitVectorsAtTheEndsOfTheUnitIntervalToo) {
    auto u = uniformNumbers(2 * 1000, 44);
    const auto extreme = extremeNumbers(2);
    u.insert(u.end(), extreme.begin(), extreme.end());
    for (Phase phase : phases())
        for (float g : {phase.g, phase.id == PHASE_HG ? std::copysign(0.999999f, phase.g) : 0})
            for (const dvec3& direction : directions()) {
                phase.g = g;
                for (const dvec3& d : scattered(phase, direction, u))
                    ASSERT_NEAR(glm::length(d), 1, 3e-7) << phase.name();
            }
}

/// Directions sampled from a phase function, sorted by the kind of scattering that the device draws for each.
struct SortedEvents {
    std::vector<dvec3> diffuse, quasiSpecular;
};

SortedEvents sortEvents(const Split& split, dvec3 direction) {
    const auto after = scattered(split.phase, direction, uniformNumbers(2 * sampleCount, 45));
    std::vector<float> c;
    for (const dvec3& d : after) c.push_back(static_cast<float>(1 - oneMinusCos(direction, d)));
    const auto p = phaseValues(split.phase, c), u = uniformNumbers(sampleCount, 46);
    std::vector<float> numbers;
    for (size_t i = 0; i < sampleCount; ++i) numbers.insert(numbers.end(), {p[i], u[i]});
    const auto events =
        runOver(program(), "splitEvents", makeMedium(split.phase, split.level), numbers, sampleCount, 3 * sampleCount);
    SortedEvents sorted;
    for (size_t i = 0; i < sampleCount; ++i)
        (events[3 * i] == SCATTER_GENUINE_DIFFUSE ? sorted.diffuse : sorted.quasiSpecular).push_back(after[i]);
    return sorted;
}

/// Integral of min(p, level) (or, of the peak, p minus that) over each cell of `grid`.
std::vector<double> cellIntegrals(const Split& split, bool ofPeak) {
    std::vector<double> integrals(grid.cells());
    const int steps = 500 * grid.nu;
    for (int i = 0; i < steps; ++i) {
        const double s = (i + 0.5) / steps;
        const double diffuse = std::min(split.level / split.phase.value(split.phase.oneMinusCosAt(s)), 1.0);
        for (int row = 0; row < grid.nv; ++row)
            integrals[grid.cell(s, (row + 0.5) / grid.nv)] += (ofPeak ? 1 - diffuse : diffuse) / (steps * grid.nv);
    }
    return integrals;
}

double sumOf(const std::vector<double>& values) {
    double sum = 0;
    for (double v : values) sum += v;
    return sum;
}

/// p-value of the directions against the density whose integrals over the cells are in proportion to `integrals`.
double partFit(const Split& split, dvec3 direction, const std::vector<dvec3>& after, std::vector<double> integrals) {
    const double sum = sumOf(integrals);
    for (double& p : integrals) p /= sum;
    std::vector<uint64_t> counts(grid.cells() + 1);
    for (const dvec3& d : after) {
        const auto [s, turns] = coordinates(split.phase, direction, d);
        ++counts[grid.cell(s, turns)];
    }
    return chiSquaredPValue(counts, integrals);
}

TEST(PhaseSplit, eventsShareTheDensityAtTheLevel) {
    const dvec3 direction = directions()[2];
    const double level = significanceLevel(statisticalTests());
    for (const Split& split : splits()) {
        SCOPED_TRACE(split.phase.name() + ", level " + std::to_string(split.level));
        const SortedEvents events = sortEvents(split, direction);
        const auto diffuse = cellIntegrals(split, false), peak = cellIntegrals(split, true);
        const double share = sumOf(diffuse);
        EXPECT_NEAR(share + sumOf(peak), 1, 1e-9);
        const double found = static_cast<double>(events.diffuse.size()) / sampleCount;
        EXPECT_GT(normalPValue((found - share) / std::sqrt(share * (1 - share) / sampleCount)), level)
            << found << " instead of " << share;
        EXPECT_GT(partFit(split, direction, events.diffuse, diffuse), level);
        EXPECT_GT(partFit(split, direction, events.quasiSpecular, peak), level);
    }
}

TEST(PhaseSplit, negativeControlUnsplitDensityOrWrongLevelFails) {
    const dvec3 direction = directions()[2];
    const double level = significanceLevel(statisticalTests());
    const Split split = splits()[0], wrong{split.phase, 1.5f * split.level};
    const SortedEvents events = sortEvents(split, direction);
    EXPECT_LT(uniformFit(split.phase, direction, events.diffuse), level);
    EXPECT_LT(uniformFit(split.phase, direction, events.quasiSpecular), level);
    EXPECT_LT(partFit(split, direction, events.diffuse, cellIntegrals(wrong, false)), level);
    EXPECT_LT(partFit(split, direction, events.quasiSpecular, cellIntegrals(wrong, true)), level);
}

TEST(PhaseSplit, partsAddUpAndTheEndsOfTheLevelHaveOneKindOnly) {
    const std::vector<float> numbers{0.01f, 0,         0.05f, 0.5f, 0.05f,  1 - 0x1p-24f,
                                     3.0f,  0.016666f, 3.0f,  0.5f, 1600.f, 1 - 0x1p-24f};
    const size_t count = numbers.size() / 2;
    for (float level : {0.0f, 0.05f, infinity}) {
        const auto r =
            runOver(program(), "splitEvents", makeMedium({PHASE_HG, 0.99f}, level), numbers, count, 3 * count);
        for (size_t i = 0; i < count; ++i) {
            const float p = numbers[2 * i], u = numbers[2 * i + 1], diffuse = std::min(p, level);
            EXPECT_EQ(r[3 * i + 1], diffuse);
            EXPECT_EQ(r[3 * i + 2], p - diffuse);
            EXPECT_EQ(r[3 * i], u < diffuse / p ? SCATTER_GENUINE_DIFFUSE : SCATTER_QUASI_SPECULAR)
                << p << ' ' << u << ' ' << level;
        }
    }
}

TEST(PhaseSplit, namesTheKindsThatAMediumCanHave) {
    const auto kinds = [](float level) {
        Buffer<shared::Medium> m(testDevice(), std::vector{makeMedium({PHASE_HG, 0.5f}, level)}, "medium");
        Buffer<cl_uint> out(testDevice(), 1, "kinds");
        program().kernel("possibleScatterings").launch(1, m, out);
        return out.read()[0];
    };
    EXPECT_EQ(kinds(0), SCATTER_QUASI_SPECULAR);
    EXPECT_EQ(kinds(0.1f), SCATTER_QUASI_SPECULAR | SCATTER_GENUINE_DIFFUSE);
    EXPECT_EQ(kinds(infinity), SCATTER_GENUINE_DIFFUSE);
}

} // namespace
} // namespace quasilux
