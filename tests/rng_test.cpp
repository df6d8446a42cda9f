// The kernels' random numbers: known values, uniformity in one and two dimensions, and independence of the launch.
// 27 chi-squared tests; false-alarm rate of the program 1e-4 (support/chi_squared.h).
#include "support/chi_squared.h"
#include "support/test_kernels.h"

#include <algorithm>
#include <cmath>
#include <complex>
#include <gtest/gtest.h>
#include <numbers>

namespace quasilux {
namespace {

constexpr int tests = 27;
constexpr size_t sequences = 7; // of a pixel (kernels/rng.cl)
constexpr int mostWaves = 6;

Program& program() {
    static Program built = testProgram("rng.cl");
    return built;
}

std::vector<float> draw(uint64_t seed, unsigned pass, unsigned stream, unsigned firstPath, unsigned paths,
                        unsigned dimensions) {
    Buffer<float> result(testDevice(), size_t{paths} * dimensions, "numbers");
    program().kernel("draw").launch(paths, cl_ulong(seed), cl_uint(pass), cl_uint(stream), cl_uint(firstPath),
                                    cl_uint(dimensions), result, cl_uint(paths));
    return result.read();
}

double uniformPValue1(const std::vector<float>& numbers) {
    std::vector<uint64_t> counts(256);
    for (float u : numbers) ++counts.at(static_cast<size_t>(u * 256));
    return chiSquaredPValue(counts, std::vector<double>(256, 1.0 / 256));
}

template <typename Pair>
double uniformPValue2(size_t count, Pair pair) {
    std::vector<uint64_t> counts(64 * 64);
    for (size_t i = 0; i < count; ++i) {
        const auto [u, v] = pair(i);
        ++counts.at(static_cast<size_t>(v * 64) * 64 + static_cast<size_t>(u * 64));
    }
    return chiSquaredPValue(counts, std::vector<double>(64 * 64, 1.0 / (64 * 64)));
}

TEST(Rng, mixIsSplitmix64) {
    // First outputs of the reference generator seeded with 0.
    const std::vector<uint64_t> weyl{0x9e3779b97f4a7c15, 0x3c6ef372fe94f82a};
    Buffer<uint64_t> in(testDevice(), weyl, "input"), out(testDevice(), weyl.size(), "mixed");
    program().kernel("mixNumbers").launch(weyl.size(), in, out, cl_uint(weyl.size()));
    EXPECT_EQ(out.read(), (std::vector<uint64_t>{0xe220a8397b1dcdaf, 0x6e789e6aa1b965f4}));
}

TEST(Rng, staysBelowOneAndHas24Bits) {
    const auto numbers = draw(7, 0, 0, 0, 1 << 16, 64);
    float largest = 0;
    for (float u : numbers) {
        ASSERT_TRUE(u >= 0 && u < 1);
        ASSERT_EQ(u * 0x1p24f, static_cast<float>(static_cast<uint32_t>(u * 0x1p24f)));
        largest = std::max(largest, u);
    }
    EXPECT_GT(largest, 1 - 0x1p-20f);
}

TEST(Rng, isUniformInEveryArgument) {
    const unsigned n = 1 << 18;
    for (uint64_t seed : {uint64_t{0}, uint64_t{1}, ~uint64_t{0}}) {
        EXPECT_GT(uniformPValue1(draw(seed, 0, 0, 0, n, 1)), significanceLevel(tests)) << "over paths, seed " << seed;
        EXPECT_GT(uniformPValue1(draw(seed, 3, 1, 0xfffffff0u - n, n, 1)), significanceLevel(tests)) << "late paths";
        EXPECT_GT(uniformPValue1(draw(seed, 3, 1, 12345, 64, n / 64)), significanceLevel(tests)) << "over dimensions";
    }
    std::vector<float> overPasses, overStreams;
    for (unsigned i = 0; i < 4096; ++i) {
        for (float u : draw(0, i, 0, 0, 64, 1)) overPasses.push_back(u);
        for (float u : draw(0, 0, i, 0, 64, 1)) overStreams.push_back(u);
    }
    EXPECT_GT(uniformPValue1(overPasses), significanceLevel(tests));
    EXPECT_GT(uniformPValue1(overStreams), significanceLevel(tests));
}

TEST(Rng, neighboursAreIndependent) {
    const unsigned n = 1 << 18;
    const auto expectIndependent = [&](const std::vector<float>& a, const std::vector<float>& b, size_t offset,
                                       const char* what) {
        EXPECT_GT(uniformPValue2(a.size() - offset, [&](size_t i) { return std::pair(a[i], b[i + offset]); }),
                  significanceLevel(tests))
            << what;
    };
    for (unsigned path : {0u, 1u << 31}) {
        const auto base = draw(5, 0, 0, path, n, 1);
        expectIndependent(base, base, 1, "neighbouring paths");
        expectIndependent(base, base, 1024, "paths a power of two apart");
        expectIndependent(base, draw(5, 1, 0, path, n, 1), 0, "passes");
        expectIndependent(base, draw(5, 0, 1, path, n, 1), 0, "streams");
        expectIndependent(base, draw(6, 0, 0, path, n, 1), 0, "seeds");
    }
    const auto dimensions = draw(5, 0, 0, 0, n / 4, 4);
    expectIndependent(dimensions, dimensions, 1, "dimensions");
}

TEST(Rng, pairsFromOneHashAreIndependent) {
    const unsigned n = 1 << 18;
    Buffer<float> result(testDevice(), 2 * n, "pairs");
    program().kernel("drawPairs").launch(n, cl_ulong(0), cl_uint(0), cl_uint(0), result, cl_uint(n));
    const auto u = result.read();
    EXPECT_GT(uniformPValue2(n, [&](size_t i) { return std::pair(u[2 * i], u[2 * i + 1]); }), significanceLevel(tests));
}

TEST(Rng, negativeControlCounterWithoutHashFails) {
    // The Weyl sequence that splitmix64 hashes is uniform, but its neighbours lie on lines.
    const size_t n = 1 << 18;
    const auto weyl = [](size_t i) { return static_cast<double>((i * 0x9e3779b97f4a7c15u) >> 11) * 0x1p-53; };
    EXPECT_LT(uniformPValue2(n, [&](size_t i) { return std::pair(weyl(i), weyl(i + 1)); }), 1e-12);
}

TEST(Rng, pathHasItsNumbersWhateverTheLaunch) {
    const auto all = draw(9, 2, 1, 0, 4096, 8);
    for (unsigned path : {0u, 1u, 63u, 64u, 1000u, 4095u}) {
        const auto alone = draw(9, 2, 1, path, 1, 8);
        EXPECT_EQ(alone, std::vector<float>(all.begin() + path * 8, all.begin() + path * 8 + 8));
    }
    EXPECT_EQ(all, draw(9, 2, 1, 0, 4096, 8));
}

// Largest difference, over intervals that begin at 0, between how often numbers from any pass on are in it and how
// often they should.
double largestExcess(const std::vector<float>& numbers, unsigned passes) {
    double largest = 0;
    for (size_t first = 0; first + passes <= numbers.size(); first += 37)
        for (double end = 0.05; end < 1; end += 0.05) {
            double within = 0;
            for (size_t k = first; k < first + passes; ++k) within += numbers[k] < end;
            largest = std::max(largest, std::abs(within - end * passes));
        }
    return largest;
}

// An emitter that is chosen with probability 0.05 has its share of the passes, not a binomial number of them. Nothing
// is left to chance.
TEST(Rng, ChoicesOfEmittersAreEvenOverThePasses) {
    Buffer<float> result(testDevice(), 1000, "numbers");
    for (const unsigned shift : {0u, 123456789u, 4000000000u}) {
        program().kernel("chooseEvenly").launch(1000, cl_uint(shift), result, cl_uint(1000));
        for (const unsigned passes : {10u, 100u, 600u}) EXPECT_LT(largestExcess(result.read(), passes), 3);
    }
    EXPECT_GT(largestExcess(draw(7, 0, 0, 0, 1, 1000), 600), 10)
        << "negative control: numbers that know nothing of each other";
}

/// Six numbers of each point: a pair and a choice for emitters, and for lobes.
std::vector<float> drawNets(uint64_t seed, unsigned paths, unsigned place, unsigned points, unsigned event = 0) {
    Buffer<float> result(testDevice(), size_t{6} * points, "nets");
    program()
        .kernel("drawNets")
        .launch(points, cl_ulong(seed), cl_uint(paths), cl_uint(place), cl_uint(event), result, cl_uint(points));
    return result.read();
}

// Is one of the `size` points from `first` on in each of the boxes 1 / columns wide and columns / size high of two of
// their six numbers?
bool isEven(const std::vector<float>& numbers, unsigned first, unsigned size, unsigned columns, size_t x, size_t y) {
    const unsigned rows = size / columns;
    std::vector<unsigned> counts(size);
    for (unsigned i = first; i < first + size; ++i)
        ++counts.at(unsigned(numbers[6 * i + x] * float(columns)) * rows + unsigned(numbers[6 * i + y] * float(rows)));
    return std::all_of(counts.begin(), counts.end(), [](unsigned count) { return count == 1; });
}

// (0, m, 2)-nets: nothing is left to chance.
TEST(Rng, FirstEventsOfFourPassesLieOnNets) {
    for (const unsigned paths : {1u, 2u, 6u, 16u, 64u}) {
        const unsigned size = paths % 4 == 0 ? 4 * (paths & -paths) : 4;
        const auto numbers = drawNets(11, paths, 3, 2 * size);
        for (const unsigned first : {0u, size})
            for (const size_t use : {0u, 3u}) {
                for (unsigned columns = 1; columns <= size; columns *= 2)
                    EXPECT_TRUE(isEven(numbers, first, size, columns, use, use + 1)) << paths << " " << columns;
                if (size >= 16) {
                    EXPECT_TRUE(isEven(numbers, first, size, size, use + 2, use)) << paths;
                }
            }
    }
    EXPECT_FALSE(isEven(drawNets(11, 16, 3, 128), 32, 64, 8, 0, 1)) << "negative control: halves of two nets";
    EXPECT_FALSE(isEven(drawNets(11, 16, 3, 128), 0, 64, 8, 0, 3)) << "negative control: numbers of two uses";
}

// So do those of each later event, where paths are four or more. The first point in its net, and a later one, of the same path.
TEST(Rng, LaterEventsHaveNetsOfTheirOwn) {
    for (const unsigned event : {1u, 2u, 7u}) {
        const auto numbers = drawNets(11, 16, 3, 128, event);
        for (const unsigned first : {0u, 64u})
            for (const size_t use : {0u, 3u}) {
                for (unsigned columns = 1; columns <= 64; columns *= 2)
                    EXPECT_TRUE(isEven(numbers, first, 64, columns, use, use + 1)) << event << " " << columns;
                EXPECT_TRUE(isEven(numbers, first, 64, 64, use + 2, use)) << event;
            }
        EXPECT_FALSE(isEven(numbers, 32, 64, 8, 0, 1)) << "negative control: halves of two nets";
    }
}

// The same point of many pixels' nets.
TEST(Rng, PointsOfNetsAreUniformAndIndependent) {
    const unsigned pixels = 1 << 14;
    std::vector<float> points;
    for (unsigned pixel = 0; pixel < pixels; ++pixel) {
        const auto numbers = drawNets(12, 4, pixel, 6);
        points.insert(points.end(), numbers.begin() + 30, numbers.end());
    }
    const auto expectEven = [&](size_t a, size_t b) {
        EXPECT_GT(uniformPValue2(pixels, [&](size_t i) { return std::pair(points[6 * i + a], points[6 * i + b]); }),
                  significanceLevel(tests))
            << a << " " << b;
    };
    expectEven(0, 1);
    expectEven(0, 3);
    expectEven(1, 4);
    expectEven(0, 4);
}

// Largest |mean of exp(2 pi i (h a + k b))| over small h, k: 1 where the pairs (a, b) keep to lines, however many they
// are.
double largestWave(const std::vector<float>& numbers, size_t a, size_t b, size_t stride = sequences) {
    const size_t count = numbers.size() / stride;
    double largest = 0;
    for (int h = 1; h <= mostWaves; ++h)
        for (int k = -mostWaves; k <= mostWaves; ++k) {
            std::complex<double> sum = 0;
            for (size_t i = 0; i < count; ++i)
                sum +=
                    std::polar(1.0, 2 * std::numbers::pi * (h * numbers[stride * i + a] + k * numbers[stride * i + b]));
            largest = std::max(largest, std::abs(sum) / static_cast<double>(count));
        }
    return largest;
}

// Two sequences by the same step once let a pixel's first flight decide which emitter it sampled: each seed converged
// to another image, 20 % off behind a cloud. Nothing is left to chance.
TEST(Rng, SequencesOfAPixelDoNotFollowEachOther) {
    const unsigned passes = 1 << 14;
    Buffer<float> result(testDevice(), sequences * passes, "sequences");
    program().kernel("drawSequences").launch(passes, result, cl_uint(passes));
    auto numbers = result.read();
    for (size_t a = 0; a < sequences; ++a)
        for (size_t b = a + 1; b < sequences; ++b)
            EXPECT_LT(largestWave(numbers, a, b), 0.2) << "sequences " << a << " and " << b;
    for (size_t i = 0; i < passes; ++i)
        numbers[sequences * i + 5] = std::fmod(numbers[sequences * i + 4] + 0.25f, 1.0f);
    EXPECT_GT(largestWave(numbers, 4, 5), 0.9) << "negative control: two sequences with the same step";
}

// What two events of a path draw, over all passes of its pixel: else the light that is taken at the second would depend on the seed.
// Uniform and independent numbers have waves of 1 / 128 here; that one of 18 x 78 exceeds 0.05 has a probability below 1e-14.
TEST(Rng, EventsOfAPathDoNotFollowEachOther) {
    const unsigned points = 1 << 14;
    const auto first = drawNets(13, 4, 5, points), second = drawNets(13, 4, 5, points, 1),
               third = drawNets(13, 4, 5, points, 2);
    const auto wave = [&](const std::vector<float>& one, const std::vector<float>& other, size_t use) {
        std::vector<float> pairs;
        for (size_t i = use; i < one.size(); i += 6) pairs.insert(pairs.end(), {one[i], other[i]});
        return largestWave(pairs, 0, 1, 2);
    };
    for (size_t use = 0; use < 6; ++use) {
        EXPECT_LT(wave(first, second, use), 0.05) << use;
        EXPECT_LT(wave(first, third, use), 0.05) << use;
        EXPECT_LT(wave(second, third, use), 0.05) << use;
        EXPECT_GT(wave(first, first, use), 0.5) << "negative control: numbers of the first event again";
    }
}

} // namespace
} // namespace quasilux
