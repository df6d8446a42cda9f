// Flux in one word: the mean over all random bits is the flux, whatever its size; the codes are what native loops take
// them for; and what is too large is reported.
//
// Exact but for the random bits of photons, which are tested by chi squared, false alarm 1e-4 (support/chi_squared.h).
#include "bench/micro/native_flux.h"
#include "render/flux_unit.h"
#include "support/chi_squared.h"
#include "support/test_kernels.h"

#include <cmath>
#include <gtest/gtest.h>
#include <random>

namespace quasilux {
namespace {

struct Flux {
    float r, g, b, unused = 0;
};

constexpr unsigned randomBits = 18;

Program& program() {
    static Program built = testProgram("packed_flux.cl");
    return built;
}

std::vector<uint32_t> pack(const std::vector<Flux>& flux, const std::vector<uint32_t>& random,
                           std::vector<int>* clipped = nullptr) {
    Buffer<Flux> input(testDevice(), flux, "flux");
    Buffer<uint32_t> bits(testDevice(), random, "random"), packed(testDevice(), flux.size(), "packed");
    Buffer<int> lost(testDevice(), flux.size(), "clipped");
    program().kernel("packAll").launch(flux.size(), input, bits, packed, lost, unsigned(flux.size()));
    if (clipped) *clipped = lost.read();
    return packed.read();
}

std::vector<Flux> unpack(const std::vector<uint32_t>& packed) {
    Buffer<uint32_t> input(testDevice(), packed, "packed");
    Buffer<Flux> flux(testDevice(), packed.size(), "flux");
    program().kernel("unpackAll").launch(packed.size(), input, flux, unsigned(packed.size()));
    return flux.read();
}

/// Over 60 powers of two, from far below the smallest code to the largest.
std::vector<float> allSizes() {
    std::vector<float> values{0, 0x1p-30f};
    for (int exponent = -60; exponent <= 0; ++exponent)
        for (const float mantissa : {1.f, 1.0078125f, 1.3f, 1.5f, 1.77f, 1.9999f})
            if (const float value = std::ldexp(mantissa, exponent); value < 1.96f) values.push_back(value);
    return values;
}

/// Mean of the codes' values over random bits that are spread evenly.
Flux meanOver(const std::vector<uint32_t>& random, float value) {
    const std::vector<Flux> flux(random.size(), {value, 0.5f * value, 0.25f * value});
    double r = 0, g = 0, b = 0;
    for (const Flux& f : unpack(pack(flux, random))) r += f.r, g += f.g, b += f.b;
    const auto n = double(random.size());
    return {float(r / n), float(g / n), float(b / n)};
}

TEST(PackedFlux, MeanIsTheFlux) {
    std::vector<uint32_t> all(1u << randomBits);
    for (uint32_t k = 0; k < all.size(); ++k) all[k] = k;
    for (const float value : {1.3f, 0.7001f, 3.1e-5f, 0x1.fep-20f, 0x1p-29f * 1.9f, 0x1p-33f, 0x1.8p-40f}) {
        const Flux mean = meanOver(all, value);
        // The dropped bits, 17 of R and G, are all that decides, but below the smallest code 18 bits do.
        const double tolerance = value < 0x1p-26f ? 0x1p-18 * 0x1p-30 / value + 1e-6 : 1e-6;
        EXPECT_NEAR(mean.r / value, 1, tolerance) << value;
        EXPECT_NEAR(mean.g / (0.5f * value), 1, 2 * tolerance) << value;
        EXPECT_NEAR(mean.b / (0.25f * value), 1, 4 * tolerance) << value;
    }
    // Control: always rounded down.
    EXPECT_LT(meanOver(std::vector<uint32_t>(64, 0), 1.3f).r / 1.3f, 0.998);
}

TEST(PackedFlux, IsOneOfBothNeighbours) {
    const auto sizes = allSizes();
    std::vector<Flux> flux;
    for (const float value : sizes) flux.push_back({value, value, value});
    const auto lower = unpack(pack(flux, std::vector<uint32_t>(sizes.size(), 0))),
               upper = unpack(pack(flux, std::vector<uint32_t>(sizes.size(), (1u << randomBits) - 1)));
    for (size_t k = 0; k < sizes.size(); ++k) {
        const float value = sizes[k];
        const Flux low = lower[k], high = upper[k];
        EXPECT_LE(low.r, value);
        EXPECT_LE(low.b, value);
        if (value < 0x1p-48f) continue; // of no account: always zero
        EXPECT_GE(high.r, value * 0.99999f) << "but for random bits that are just not 1";
        EXPECT_GE(high.b, value * 0.99999f);
        if (value < 0x1p-30f) continue;
        EXPECT_LE(high.r - low.r, value / 64);
        EXPECT_LE(high.g - low.g, value / 64);
        EXPECT_LE(high.b - low.b, value / 32);
    }
}

TEST(PackedFlux, NativeLoopsReadAndWriteTheSame) {
    std::mt19937 random(3);
    std::uniform_real_distribution<float> size(-29, 0.9f);
    std::vector<Flux> flux;
    std::vector<uint32_t> bits;
    for (unsigned k = 0; k < 10'000; ++k) {
        flux.push_back({std::exp2(size(random)), std::exp2(size(random)), std::exp2(size(random))});
        bits.push_back(random() >> (32 - randomBits));
    }
    const auto packed = pack(flux, bits);
    const auto unpacked = unpack(packed);
    for (size_t k = 0; k < packed.size(); ++k) {
        EXPECT_EQ(packed[k], nativePackFlux({flux[k].r, flux[k].g, flux[k].b}, bits[k]));
        const shared::Rgb native = nativeUnpackFlux(packed[k]);
        EXPECT_EQ(unpacked[k].r, native.r);
        EXPECT_EQ(unpacked[k].g, native.g);
        EXPECT_EQ(unpacked[k].b, native.b);
    }
}

TEST(PackedFlux, WhatIsTooLargeIsTold) {
    std::vector<int> clipped;
    const auto packed =
        pack({{1.98f, 0, 0}, {2.1f, 0, 0}, {0, 1e20f, 0}, {0, 0, INFINITY}}, std::vector<uint32_t>(4, 0), &clipped);
    EXPECT_EQ(clipped, (std::vector<int>{0, 1, 1, 1}));
    const auto kept = unpack(packed);
    EXPECT_GT(kept[1].r, 1.9f) << "the largest there is, not another number";
    EXPECT_GT(kept[2].g, 1.9f);
    EXPECT_EQ(kept[2].r, 0);
    EXPECT_GT(kept[3].b, 1.9f);
}

std::vector<uint32_t> roundings(unsigned count) {
    Buffer<uint32_t> bits(testDevice(), count, "random");
    program().kernel("roundings").launch(count, bits, count);
    return bits.read();
}

TEST(PackedFlux, NeighboursAreRoundedAtRandom) {
    constexpr unsigned cells = 256;
    std::vector<uint64_t> upper(cells + 1, 0), lower(cells + 1, 0), pairs(cells + 1, 0); // the last: what is outside
    uint32_t before = 0;
    for (const uint32_t bits : roundings(200'000)) {
        ++upper[std::min(bits >> (randomBits - 8), cells)];
        ++lower[bits % cells];
        ++pairs[(before >> (randomBits - 4) << 4) + (bits >> (randomBits - 4))];
        before = bits;
    }
    const std::vector<double> even(cells, 1.0 / cells);
    for (const auto& counts : {upper, lower, pairs}) EXPECT_GT(chiSquaredPValue(counts, even), significanceLevel(3));
    lower[0] += 300; // control
    EXPECT_LT(chiSquaredPValue(lower, even), significanceLevel(3));
}

// A photon's flux, as emitted and 2000 times that, is well within what can be stored, whatever its size.
TEST(PackedFlux, UnitFitsThePhotons) {
    for (const double emitted : {1e-12, 0.3, 1.0, 700.0, 1e9})
        for (const unsigned paths : {1u, 2048u, 10'000'000u}) {
            const double unit = fluxUnit(emitted, paths), mostOfAPhoton = 3 * emitted / paths;
            EXPECT_FLOAT_EQ(fluxUnit(1.7 * emitted, paths), 1.7 * unit) << "brighter photons are rounded alike";
            EXPECT_LT(2000 * mostOfAPhoton, 1.9 * unit);
            EXPECT_GT(1e-5 * mostOfAPhoton, 0x1p-30 * unit);
        }
    EXPECT_GT(fluxUnit(0, 100), 0) << "a scene without light";
}

} // namespace
} // namespace quasilux
