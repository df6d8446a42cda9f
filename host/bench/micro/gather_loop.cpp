// Compiled with -O3 -ffast-math (CMakeLists.txt), for the processor it runs on: the compiler vectorises the inner loop.
#include "bench/micro/gather_loop.h"

#include "bench/micro/native_flux.h"
#include "bench/micro/native_grid.h"

#include <algorithm>
#include <bit>

namespace quasilux {

namespace {

#if defined(__GNUC__) && !defined(__clang__) && defined(__x86_64__)
#define EVERY_PROCESSOR                                                                                                \
    __attribute__((target_clones("arch=sapphirerapids", "arch=skylake-avx512", "arch=haswell", "default")))
#else
#define EVERY_PROCESSOR
#endif
#define INTO_EVERY_CLONE inline __attribute__((always_inline))

struct Sums {
    float r = 0, g = 0, b = 0, biasR = 0, biasG = 0, biasB = 0;
};

INTO_EVERY_CLONE void gatherRun(const NativeMap& photons, const shared::GatherQuery& query, size_t begin, size_t end,
                                bool bias, Sums& sums) {
    const size_t stride = photons.map.photonStride;
    const uint32_t *x = photons.sorted, *y = x + stride, *z = y + stride; // bits of floats
    const uint32_t *fluxes = photons.sorted + fieldFlux * stride, *patchSide = fluxes + stride;
    const float radius = photons.map.radius[LIGHT_DIFFUSE], radiusSquared = radius * radius;
    const float scale = 1 / radiusSquared;
    float sumR = 0, sumG = 0, sumB = 0, biasR = 0, biasG = 0, biasB = 0;
    for (size_t i = begin; i < end; ++i) {
        const float dx = std::bit_cast<float>(x[i]) - query.position.x;
        const float dy = std::bit_cast<float>(y[i]) - query.position.y;
        const float dz = std::bit_cast<float>(z[i]) - query.position.z;
        const float distanceSquared = dx * dx + dy * dy + dz * dz;
        // Without branches, so that the compiler sees what it can do for many photons at once.
        const int inside = int(distanceSquared < radiusSquared) & int(patchSide[i] == query.patchSide);
        const float weight = (1 - distanceSquared * scale) * float(inside);
        const shared::Rgb flux = nativeUnpackFlux(fluxes[i]);
        sumR += weight * flux.r;
        sumG += weight * flux.g;
        sumB += weight * flux.b;
        if (bias) {
            const float biasWeight = weight * (4 - 6 * weight);
            biasR += biasWeight * flux.r;
            biasG += biasWeight * flux.g;
            biasB += biasWeight * flux.b;
        }
    }
    sums.r += sumR, sums.g += sumG, sums.b += sumB;
    sums.biasR += biasR, sums.biasG += biasG, sums.biasB += biasB;
}

/// Photons of cells that follow each other in one row.
struct Run {
    size_t begin, end;
};

struct Runs {
    Run run[18]; // nine rows, each of which may wrap around the end of the table
    unsigned count = 0;

    /// Rows that collide in the hashed table share photons: such runs are made one.
    void add(size_t begin, size_t end) {
        if (begin == end) return;
        for (unsigned k = 0; k < count;) {
            if (begin >= run[k].end || run[k].begin >= end) {
                ++k;
                continue;
            }
            begin = std::min(begin, run[k].begin);
            end = std::max(end, run[k].end);
            run[k] = run[--count];
            k = 0; // the longer one may meet others
        }
        run[count++] = {begin, end};
    }
};

INTO_EVERY_CLONE Runs findRuns(const NativeMap& photons, const shared::GatherQuery& query) {
    const CellCoordinate cell = nativeCoordinate(query.position, photons.map.radius[LIGHT_DIFFUSE]);
    const unsigned mask = photons.map.cellMask;
    const uint32_t* start = photons.cellStart;
    Runs runs;
    for (int dz = -1; dz <= 1; ++dz)
        for (int dy = -1; dy <= 1; ++dy) {
            const unsigned first = nativeCell({cell.x - 1, cell.y + dy, cell.z + dz}, query.patchSide, mask);
            if (first + 2 <= mask) {
                runs.add(start[first], start[first + 3]);
            } else {
                runs.add(start[first], start[mask + 1]);
                runs.add(start[0], start[first + 3 - (mask + 1)]);
            }
        }
    return runs;
}

INTO_EVERY_CLONE void gatherAll(const NativeMap& photons, const shared::GatherQuery* queries, shared::GatherSum* sums,
                                size_t count, bool bias) {
    for (size_t k = 0; k < count; ++k) {
        Sums sum;
        const Runs runs = findRuns(photons, queries[k]);
        for (unsigned n = 0; n < runs.count; ++n)
            gatherRun(photons, queries[k], runs.run[n].begin, runs.run[n].end, bias, sum);
        sums[k] = {{sum.r, sum.g, sum.b}, {sum.biasR, sum.biasG, sum.biasB}};
    }
}

} // namespace

EVERY_PROCESSOR void gatherLoop(const NativeMap& photons, const shared::GatherQuery* queries, shared::GatherSum* sums,
                                size_t count, bool bias) {
    if (bias)
        gatherAll(photons, queries, sums, count, true);
    else
        gatherAll(photons, queries, sums, count, false);
}

uint64_t photonsTested(const NativeMap& photons, const shared::GatherQuery* queries, size_t count) {
    uint64_t tested = 0;
    for (size_t k = 0; k < count; ++k) {
        const Runs runs = findRuns(photons, queries[k]);
        for (unsigned n = 0; n < runs.count; ++n) tested += runs.run[n].end - runs.run[n].begin;
    }
    return tested;
}

} // namespace quasilux
