/* The part of stage 2 that is the same for every scene: sorts records whose cells are known, photons or points. */
#include "cell_sort.clh"
#include "photon_store.clh"

inline size_t countsOfDigit(const SortDigit* digit) { return (size_t)digit->bins * digit->chunks; }
inline uint sumCount(size_t count, uint each) { return (uint)((count + each - 1) / each); }

/* Counts by bin and, within a bin, by chunk, from the one at `first` on. */
typedef struct {
    uint bin, chunk;
} CountWalk;

inline CountWalk countAt(size_t first, const SortDigit* digit) {
    const CountWalk walk = {(uint)(first / digit->chunks), (uint)(first % digit->chunks)};
    return walk;
}
inline size_t placeOfCount(const CountWalk* walk, const SortDigit* digit) {
    return (size_t)walk->bin * digit->binSide + (size_t)walk->chunk * digit->chunkSide;
}
inline void toNextCount(CountWalk* walk, const SortDigit* digit) {
    if (++walk->chunk < digit->chunks) return;
    walk->chunk = 0;
    ++walk->bin;
}

/* sums[block]: records in a block of counts. */
__kernel void sumBlocks(__global const uint* counts, __global uint* sums, const SortDigit digit) {
    const uint block = get_global_id(0);
    const size_t all = countsOfDigit(&digit), first = (size_t)block * digit.blockCounts;
    if (first >= all) return;
    CountWalk walk = countAt(first, &digit);
    uint sum = 0;
    for (size_t k = first; k < min(first + digit.blockCounts, all); ++k, toNextCount(&walk, &digit))
        sum += counts[placeOfCount(&walk, &digit)];
    sums[block] = sum;
}

/* sums[blocks + group]: records in a group of blocks. */
__kernel void sumGroups(__global uint* sums, const SortDigit digit) {
    const uint group = get_global_id(0), blocks = sumCount(countsOfDigit(&digit), digit.blockCounts);
    const uint first = group * digit.groupBlocks;
    if (first >= blocks) return;
    uint sum = 0;
    for (uint block = first; block < min(first + digit.groupBlocks, blocks); ++block) sum += sums[block];
    sums[blocks + group] = sum;
}

/* Counts become the place of the chunk's first record of the bin. */
__kernel void scanCounts(__global uint* counts, __global const uint* sums, const SortDigit digit) {
    const uint block = get_global_id(0);
    const size_t all = countsOfDigit(&digit), first = (size_t)block * digit.blockCounts;
    if (first >= all) return;
    const uint blocks = sumCount(all, digit.blockCounts), group = block / digit.groupBlocks;
    uint place = 0;
    for (uint k = 0; k < group; ++k) place += sums[blocks + k];
    for (uint k = group * digit.groupBlocks; k < block; ++k) place += sums[k];
    CountWalk walk = countAt(first, &digit);
    for (size_t k = first; k < min(first + digit.blockCounts, all); ++k, toNextCount(&walk, &digit)) {
        __global uint* count = counts + placeOfCount(&walk, &digit);
        const uint here = *count;
        *count = place;
        place += here;
    }
}

/* The next digit of records that stand in the order `from` by those before. `keys`: the cell of record r at r *
 * keySide. */
__kernel void countOrdered(__global const uint* keys, __global const uint* from, const ulong fromAt,
                           __global uint* counts, const uint records, const SortDigit digit) {
    const uint chunk = get_global_id(0);
    if (chunk >= digit.chunks) return;
    __global uint* own = countsOf(chunk, counts, &digit);
    clearCounts(own, &digit);
    const uint end = firstOfChunk(chunk + 1, records, &digit);
    for (uint k = firstOfChunk(chunk, records, &digit); k < end; ++k)
        ++*countOf(keys[(size_t)from[fromAt + k] * digit.keySide], own, &digit);
}

__kernel void placeOrdered(__global const uint* keys, __global const uint* from, const ulong fromAt,
                           __global uint* counts, __global uint* to, const ulong toAt, const uint records,
                           const SortDigit digit) {
    const uint chunk = get_global_id(0);
    if (chunk >= digit.chunks) return;
    __global uint* own = countsOf(chunk, counts, &digit);
    const uint end = firstOfChunk(chunk + 1, records, &digit);
    for (uint k = firstOfChunk(chunk, records, &digit); k < end; ++k) {
        const uint record = from[fromAt + k];
        to[toAt + (*countOf(keys[(size_t)record * digit.keySide], own, &digit))++] = record;
    }
}

/* Where each cell begins. Of one digit the counts say it: */
__kernel void copyCellStarts(__global const uint* counts, __global uint* cellStart, const uint records,
                             const uint cells, const SortDigit digit) {
    const uint cell = get_global_id(0);
    if (cell <= cells) cellStart[cell] = cell < cells ? counts[(size_t)cell * digit.binSide] : records;
}

/* of several, the order: by bisection. */
__kernel void findCellStarts(__global const uint* keys, __global const uint* order, const ulong orderAt,
                             __global uint* cellStart, const uint records, const uint cells, const SortDigit digit) {
    const uint cell = get_global_id(0);
    if (cell > cells) return;
    uint first = 0, end = records; /* the first record whose cell is not before this one lies in [first, end] */
    while (first < end) {
        const uint middle = first + (end - first) / 2;
        if (keys[(size_t)order[orderAt + middle] * digit.keySide] < cell)
            first = middle + 1;
        else
            end = middle;
    }
    cellStart[cell] = first;
}

/* From the photons' cells to their order by the first digit. */
__kernel void placePhotons(__global const uint* photons, __global const uint* blocks,
                           __global const RegionCount* regions, __global uint* counts, __global uint* to,
                           const ulong toAt, const SortDigit digit, const MapParams params) {
    const uint chunk = get_global_id(0);
    if (chunk >= digit.chunks) return;
    __global uint* own = countsOf(chunk, counts, &digit);
    __global const uint* cells = photons + (size_t)PHOTON_CELL * params.photonStride;
    const uint end = firstOfChunk(chunk + 1, params.regions, &digit);
    for (uint region = firstOfChunk(chunk, params.regions, &digit); region < end; ++region)
        for (BlockWalk walk = blocksOf(regions + region); walk.left > 0; toNextBlock(&walk, blocks)) {
            const uint first = walk.block * PHOTON_BLOCK;
            for (uint k = first; k < first + photonsInBlock(&walk); ++k)
                to[toAt + (*countOf(cells[k], own, &digit))++] = k;
        }
}

/* Moves one field of all photons to its place; the field before it has been moved. Behind the last of the `sorted` ones
 * as many zeros follow as are read in one go. `source`: the array that says of each sorted photon which one it was. */
__kernel void movePhotons(__global uint* photons, const uint field, const uint source, const uint sorted,
                          const MapParams params) {
    const uint photon = get_global_id(0);
    const size_t stride = params.photonStride;
    __global uint* to = photons + field * stride;
    if (photon < PHOTONS_READ) to[sorted + photon] = 0;
    if (photon < sorted) to[photon] = photons[TRACED(field) * stride + photons[source * stride + photon]];
}

/* From the points' cells to their order by the first digit. */
__kernel void placePoints(__global const CameraPoint* points, __global const PointRegionCount* regions,
                          __global uint* counts, __global uint* to, const ulong toAt, const SortDigit digit,
                          const MapParams params) {
    const uint chunk = get_global_id(0);
    if (chunk >= digit.chunks) return;
    __global uint* own = countsOf(chunk, counts, &digit);
    const uint end = firstOfChunk(chunk + 1, params.regions, &digit);
    for (uint region = firstOfChunk(chunk, params.regions, &digit); region < end; ++region) {
        const size_t first = (size_t)region * params.regionCapacity;
        for (size_t index = first; index < first + regions[region].stored; ++index)
            to[toAt + (*countOf(points[index].cell, own, &digit))++] = index;
    }
}

/* The fields that finding points takes, in their order. */
__kernel void gatherPoints(__global const CameraPoint* points, __global uint* sorted, const uint count,
                           const MapParams params) {
    const uint place = get_global_id(0);
    if (place >= count) return;
    const size_t stride = params.photonStride;
    __global uint* to = sorted + place;
    __global const CameraPoint* point = points + to[POINT_INDEX * stride];
    to[POINT_X * stride] = as_uint(point->position.x);
    to[POINT_Y * stride] = as_uint(point->position.y);
    to[POINT_Z * stride] = as_uint(point->position.z);
    to[POINT_PLACE * stride] = point->place;
}
