// The film's compensated sums, and the lattice that spreads the samples of a pixel.
//
// False alarms: the chi-squared tests together raise one with probability 1e-4 (support/chi_squared.h).
#include "render/film_layout.h"
#include "support/chi_squared.h"
#include "support/test_kernels.h"

#include <cmath>
#include <gtest/gtest.h>
#include <random>

namespace quasilux {
namespace {

const FilmLayout layout{false, true};

constexpr int chiSquaredTests = 8; // upper bound of their number in this program

const std::string options = "-DBVH_STACK_SIZE=32 -DPHOTON_CLASSES=8u";

struct Float2 {
    float x, y;
};
struct Float4 {
    float x, y, z, w;
};

// In launches of a few thousand samples each: drivers end a work-item that takes too long.
std::vector<float> addSamples(const std::vector<Float4>& samples, unsigned pixels) {
    Program program = testProgram("film.cl", options);
    Buffer<Float4> input(testDevice(), samples, "samples");
    Buffer<float> film(testDevice(), size_t(pixels) * layout.floatsPerPixel(), "film");
    film.fill(0);
    const unsigned ofPixel = unsigned(samples.size()) / pixels, atOnce = 20'000;
    for (unsigned first = 0; first < ofPixel; first += atOnce)
        program.kernel("addSamples")
            .launch(pixels, input, film, pixels, ofPixel, first, std::min(ofPixel, first + atOnce), layout.bits());
    return film.read();
}

/// Values over seven decades, as a pixel with rare bright samples sees them.
std::vector<Float4> wildSamples(unsigned count, unsigned seed) {
    std::mt19937 random(seed);
    std::lognormal_distribution<float> value(0, 2);
    std::vector<Float4> samples;
    for (unsigned k = 0; k < count; ++k) samples.push_back({value(random), 1e-3f * value(random), 0.1f, 0});
    return samples;
}

/// The compensated sum `at` in a pixel.
double sumOf(const std::vector<float>& film, unsigned pixel, size_t at, unsigned channel) {
    return valueOfSum(film.data() + pixel * layout.floatsPerPixel() + at, channel);
}

size_t componentSum(unsigned component) { return FILM_COMPONENT_SUMS(layout.bits()) + component * FILM_SUM_FLOATS; }

TEST(Film, MillionSamplesAreSummedAsInDouble) {
    const auto samples = wildSamples(1'000'000, 1);
    const auto film = addSamples(samples, 1);
    for (unsigned channel = 0; channel < 3; ++channel) {
        double sum = 0, squares = 0, all = 0, totalSquares = 0;
        float plain = 0;
        for (const Float4& s : samples) {
            const float value = (&s.x)[channel], total = value + value * 0.5f;
            sum += value;
            squares += double(value) * value;
            all += total;
            totalSquares += total * total;
            plain += value;
        }
        EXPECT_NEAR(sumOf(film, 0, componentSum(LIGHT_DIFFUSE), channel) / sum, 1, 1e-8);
        EXPECT_NEAR(sumOf(film, 0, componentSum(FILM_EMISSION), channel) / (sum / 2), 1, 1e-8);
        EXPECT_NEAR(sumOf(film, 0, FILM_TOTAL_SUM, channel) / all, 1, 1e-8);
        EXPECT_NEAR(sumOf(film, 0, FILM_TOTAL_SQUARES, channel) / totalSquares, 1, 1e-8);
        const size_t ofClass = FILM_CLASS_SQUARES(layout.bits()) + LIGHT_DIFFUSE * FILM_SUM_FLOATS;
        EXPECT_NEAR(sumOf(film, 0, ofClass, channel) / squares, 1, 1e-7);
        EXPECT_EQ(sumOf(film, 0, componentSum(LIGHT_CAUSTIC), channel), 0);
        EXPECT_GT(std::abs(plain / sum - 1), 1e-6) << "control: floats alone would do";
    }
}

TEST(Film, HalvesMergeToTheWhole) {
    const auto samples = wildSamples(200'000, 2);
    const auto whole = addSamples(samples, 1), halves = addSamples(samples, 2); // two pixels share the samples
    for (const size_t at :
         {componentSum(LIGHT_DIFFUSE), componentSum(FILM_EMISSION), size_t(FILM_TOTAL_SUM), size_t(FILM_TOTAL_SQUARES)})
        for (unsigned channel = 0; channel < 3; ++channel) {
            const auto merged = float(sumOf(halves, 0, at, channel) + sumOf(halves, 1, at, channel));
            const auto once = float(sumOf(whole, 0, at, channel));
            EXPECT_LE(std::abs(merged - once), std::nextafter(once, INFINITY) - once);
        }
}

std::vector<Float2> latticePoints(unsigned count, unsigned mode, unsigned first, Float2 shift) {
    Program program = testProgram("film.cl", options);
    Buffer<Float2> points(testDevice(), count, "points");
    program.kernel("latticePoints").launch(count, points, count, mode, first, shift);
    return points.read();
}

std::vector<uint64_t> histogram(const std::vector<Float2>& points, const SampleGrid& grid) {
    std::vector<uint64_t> counts(size_t(grid.cells()) + 1);
    for (const Float2& p : points) ++counts[size_t(grid.cell(p.x, p.y))];
    return counts;
}

const SampleGrid unitSquare{0, 1, 0, 1, 16, 16};

TEST(Lattice, AShiftedPointIsUniform) {
    // One point of the sequence, its shift another in every pass: independent uniform points.
    const std::vector<double> even(size_t(unitSquare.cells()), 1.0 / unitSquare.cells());
    for (const unsigned first : {0u, 2u}) {
        const auto points = latticePoints(100'000, 2, first, {0, 0});
        EXPECT_GT(chiSquaredPValue(histogram(points, unitSquare), even), significanceLevel(chiSquaredTests));
        for (const Float2& p : points) EXPECT_TRUE(p.x >= 0 && p.x < 1 && p.y >= 0 && p.y < 1);
    }
}

/// Pearson's statistic per degree of freedom of points against the uniform density: 1 for random ones.
double unevenness(const std::vector<Float2>& points) {
    const auto counts = histogram(points, unitSquare);
    const double expected = double(points.size()) / unitSquare.cells();
    double sum = 0;
    for (int k = 0; k < unitSquare.cells(); ++k) sum += std::pow(double(counts[size_t(k)]) - expected, 2) / expected;
    return sum / (unitSquare.cells() - 1);
}

TEST(Lattice, PointsAreSpreadBetterThanRandom) {
    for (const Float2 shift : {Float2{0, 0}, Float2{0.9999999f, 0.3f}})
        EXPECT_LT(unevenness(latticePoints(4096, 0, 0, shift)), 0.2);
    for (const unsigned first : {0u, 2u}) EXPECT_LT(unevenness(latticePoints(4096, 1, first, {0, 0})), 0.5);
    const auto numbers = uniformNumbers(2 * 4096, 3);
    std::vector<Float2> random;
    for (size_t k = 0; k < numbers.size(); k += 2) random.push_back({numbers[k], numbers[k + 1]});
    EXPECT_GT(unevenness(random), 0.7); // control
}

} // namespace
} // namespace quasilux
