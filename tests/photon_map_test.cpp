// The photon index: a stable sort whatever the number of chunks and digits.
//
// No test here is statistical: photons are random but seeded, and what they are compared with is exact.
#include "support/awkward_photons.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <gtest/gtest.h>
#include <numeric>

namespace quasilux {
namespace {

// As kernels/photon_grid.clh numbers them.
enum Field : unsigned { fieldX, fieldY, fieldZ, fieldFlux, fieldPatchSide, fieldDirection, fieldDepth };
constexpr unsigned fieldCount = fieldDepth; // without a depth limit

using Photon = TracedPhoton;

/// Cell of the table by the definition in kernels/photon_grid.clh, written down again.
unsigned expectedCell(const Photon& photon, const PhotonIndexSettings& settings) {
    const unsigned lightClass = photon.slot;
    const auto coordinate = [&](float x) {
        return int64_t(std::floor(std::clamp(x / settings.radius[lightClass], -1073741824.f, 1073741824.f)));
    };
    const auto y = uint32_t(coordinate(photon.position.y)),
               z = uint32_t(coordinate(photon.position.z)) + photon.patchSide * 0xb5297a4du;
    uint32_t hash = (y * 0x8da6b343u) ^ (z * 0xd8163841u);
    hash ^= hash >> 15;
    hash *= 0x2c1b3c6du;
    hash ^= hash >> 12;
    const uint32_t cell = (hash + uint32_t(coordinate(photon.position.x))) & (settings.cells - 1);
    unsigned slot = 0;
    for (unsigned c = 0; c < lightClass; ++c) slot += settings.classes >> c & 1;
    return slot * settings.cells + cell;
}

/// Order of the photons after a stable sort by cell, and where each cell begins.
struct ExpectedIndex {
    std::vector<unsigned> order;
    std::vector<uint32_t> cellStart;
};

ExpectedIndex expectIndex(const std::vector<Photon>& photons, const PhotonIndexSettings& settings) {
    ExpectedIndex index;
    std::vector<unsigned> cells;
    for (const Photon& photon : photons) cells.push_back(expectedCell(photon, settings));
    index.order.resize(photons.size());
    std::iota(index.order.begin(), index.order.end(), 0u);
    std::stable_sort(index.order.begin(), index.order.end(),
                     [&](unsigned a, unsigned b) { return cells[a] < cells[b]; });
    index.cellStart.assign(size_t(std::popcount(settings.classes)) * settings.cells + 1, 0);
    for (const unsigned cell : cells) ++index.cellStart[cell + 1];
    std::partial_sum(index.cellStart.begin(), index.cellStart.end(), index.cellStart.begin());
    return index;
}

uint32_t bits(float value) { return std::bit_cast<uint32_t>(value); }

void expectSorted(const std::vector<Photon>& photons, const PhotonIndexSettings& settings) {
    const PhotonIndex index = indexPhotons(photons, settings);
    const ExpectedIndex expected = expectIndex(photons, settings);
    EXPECT_EQ(index.cellStart.read(), expected.cellStart);
    std::vector<std::vector<uint32_t>> fields(settings.storesDepth ? fieldCount + 1 : fieldCount);
    for (const unsigned k : expected.order) {
        const Photon& p = photons[k];
        const uint32_t values[] = {
            bits(p.position.x), bits(p.position.y), bits(p.position.z), p.flux, p.patchSide, p.direction, p.depth};
        for (size_t f = 0; f < fields.size(); ++f) fields[f].push_back(values[f]);
    }
    for (unsigned f = 0; f < fields.size(); ++f) EXPECT_EQ(index.field(f), fields[f]) << "field " << f;
}

TEST(PhotonMap, IsAStableSortByCell) {
    for (const unsigned cells : {4u, 64u, 4096u})
        for (const float center : {0.f, -3000.f, 2e5f}) {
            PhotonIndexSettings settings = settingsOfFlux();
            settings.classes = 1u << LIGHT_CAUSTIC | 1u << LIGHT_DIFFUSE;
            settings.radius = {9, 0.25f, 9, 0.5f};
            settings.cells = cells;
            expectSorted(awkwardPhotons(20011, center, 0.25f, {LIGHT_CAUSTIC, LIGHT_DIFFUSE}), settings);
        }
}

TEST(PhotonMap, EveryClassHasItsRun) {
    PhotonIndexSettings settings = settingsOfFlux();
    settings.classes = 15;
    settings.radius = {0.5f, 0.125f, 1, 2};
    settings.cells = 256;
    settings.storesDepth = true;
    expectSorted(awkwardPhotons(5003, 1, 0.5f, {LIGHT_DIRECT, LIGHT_CAUSTIC, LIGHT_QUASI_CAUSTIC, LIGHT_DIFFUSE}),
                 settings);
    // A class without photons is an empty run between the others.
    expectSorted(awkwardPhotons(5003, 1, 0.5f, {LIGHT_CAUSTIC, LIGHT_DIFFUSE}), settings);
}

TEST(PhotonMap, ChunksAndDigitsDoNotChangeABit) {
    const auto photons = awkwardPhotons(10007, -10, 0.25f, {LIGHT_DIFFUSE});
    PhotonIndexSettings settings = settingsOfFlux();
    settings.radius[LIGHT_DIFFUSE] = 0.25f;
    settings.regions = 61;
    for (const unsigned cells : {1024u, 1u << 18, 1u << 23}) { // of one, two and three digits
        settings.cells = cells;
        settings.parts = {1, true};
        const PhotonIndex once = indexPhotons(photons, settings);
        for (const SortParts& parts :
             {SortParts{3, true}, SortParts{1, false}, SortParts{7, false}, SortParts{61, false}}) {
            settings.parts = parts;
            const PhotonIndex again = indexPhotons(photons, settings);
            EXPECT_EQ(again.cellStart.read(), once.cellStart.read());
            for (unsigned f = 0; f < fieldCount; ++f) EXPECT_EQ(again.field(f), once.field(f));
        }
    }
}

TEST(PhotonMap, NoPhotonsAndOnePhoton) {
    PhotonIndexSettings settings = settingsOfFlux();
    settings.cells = 4;
    expectSorted({}, settings);
    expectSorted({photonAt(-1, 5, 0.5f, LIGHT_DIFFUSE, 3)}, settings);
}

} // namespace
} // namespace quasilux
