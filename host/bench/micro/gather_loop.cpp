// Compiled with -O3 -ffast-math (CMakeLists.txt), for the processor it runs on: the compiler vectorises the inner loop.
#include "bench/micro/gather_loop.h"

#include "bench/micro/native_grid.h"

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
    const float* field = reinterpret_cast<const float*>(photons.sorted);
    const float *x = field, *y = x + stride, *z = y + stride, *r = z + stride, *g = r + stride, *b = g + stride;
    const uint32_t* patchSide = photons.sorted + fieldPatchSide * stride;
    const float radius = photons.map.radius[LIGHT_DIFFUSE], radiusSquared = radius * radius;
    const float scale = 1 / radiusSquared;
    float sumR = 0, sumG = 0, sumB = 0, biasR = 0, biasG = 0, biasB = 0;
    for (size_t i = begin; i < end; ++i) {
        const float dx = x[i] - query.position.x, dy = y[i] - query.position.y, dz = z[i] - query.position.z;
        const float distanceSquared = dx * dx + dy * dy + dz * dz;
        const bool inside = distanceSquared < radiusSquared && patchSide[i] == query.patchSide;
        const float weight = inside ? 1 - distanceSquared * scale : 0.f;
        sumR += weight * r[i];
        sumG += weight * g[i];
        sumB += weight * b[i];
        if (!bias) continue;
        const float biasWeight = weight * (4 - 6 * weight);
        biasR += biasWeight * r[i];
        biasG += biasWeight * g[i];
        biasB += biasWeight * b[i];
    }
    sums.r += sumR, sums.g += sumG, sums.b += sumB;
    sums.biasR += biasR, sums.biasG += biasG, sums.biasB += biasB;
}

/// `run(begin, end)` for the three cells of each row about the query.
template <typename Run>
INTO_EVERY_CLONE void forRuns(const NativeMap& photons, const shared::GatherQuery& query, const Run& run) {
    const CellCoordinate cell = nativeCoordinate(query.position, photons.map.radius[LIGHT_DIFFUSE]);
    const unsigned mask = photons.map.cellMask;
    const uint32_t* start = photons.cellStart;
    for (int dz = -1; dz <= 1; ++dz)
        for (int dy = -1; dy <= 1; ++dy) {
            const unsigned first = nativeCell({cell.x - 1, cell.y + dy, cell.z + dz}, mask);
            if (first + 2 <= mask) {
                run(start[first], start[first + 3]);
            } else {
                run(start[first], start[mask + 1]);
                run(start[0], start[first + 3 - (mask + 1)]);
            }
        }
}

INTO_EVERY_CLONE void gatherAll(const NativeMap& photons, const shared::GatherQuery* queries, shared::GatherSum* sums,
                                size_t count, bool bias) {
    for (size_t k = 0; k < count; ++k) {
        Sums sum;
        forRuns(
            photons, queries[k], [&](size_t begin, size_t end) __attribute__((always_inline)) {
                gatherRun(photons, queries[k], begin, end, bias, sum);
            });
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
    for (size_t k = 0; k < count; ++k)
        forRuns(photons, queries[k], [&](size_t begin, size_t end) { tested += end - begin; });
    return tested;
}

} // namespace quasilux
