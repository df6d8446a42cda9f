#include "support/photon_index.h"

#include "support/test_kernels.h"

#include <algorithm>
#include <bit>
#include <fmt/format.h>

namespace quasilux {

namespace {

constexpr size_t vectorWidth = 8; // photons are read eight at a time

/// Where each region's photons end. The shares go 0, 1, 2, 0, 1, 2, ... so every third region is empty.
std::vector<size_t> regionEnds(size_t photons, unsigned regions) {
    std::vector<size_t> ends;
    size_t shares = 0, before = 0;
    for (unsigned k = 0; k < regions; ++k) shares += k % 3;
    for (unsigned k = 0; k < regions; ++k) {
        before += k % 3;
        ends.push_back(shares == 0 || k + 1 == regions ? photons : photons * before / shares);
    }
    return ends;
}

} // namespace

std::string photonIndexOptions(const PhotonIndexSettings& settings) {
    return fmt::format("-DHAS_LOBE_LAMBERT -DBVH_STACK_SIZE=32 -DPHOTON_CLASSES={}u{}", settings.classes,
                       settings.storesDepth ? " -DHAS_DEPTH_LIMIT" : "");
}

PhotonIndex indexPhotons(const std::vector<shared::Photon>& photons, const PhotonIndexSettings& settings) {
    Device& device = testDevice();
    const std::vector<size_t> ends = regionEnds(photons.size(), settings.regions);
    PhotonIndex index;
    index.photons = photons.size();
    shared::MapParams& map = index.map;
    std::copy(settings.radius.begin(), settings.radius.end(), map.radius);
    map.cellMask = settings.cells - 1;
    map.chunks = settings.chunks;
    map.scanBlocks = settings.scanBlocks;
    map.regions = settings.regions;
    size_t begin = 0;
    for (const size_t end : ends) {
        map.regionCapacity = std::max(map.regionCapacity, unsigned(end - begin));
        begin = end;
    }
    map.photonStride = unsigned(photons.size() + vectorWidth);

    std::vector<shared::Photon> traced(size_t(map.regions) * map.regionCapacity);
    std::vector<shared::RegionCount> counts(map.regions);
    begin = 0;
    for (unsigned k = 0; k < map.regions; ++k) {
        std::copy(photons.begin() + long(begin), photons.begin() + long(ends[k]),
                  traced.begin() + long(size_t(k) * map.regionCapacity));
        counts[k].stored = counts[k].wanted = unsigned(ends[k] - begin);
        begin = ends[k];
    }
    Program program(device, "photon_map.cl", photonIndexOptions(settings));
    const size_t cells = size_t(std::popcount(settings.classes)) * settings.cells;
    Buffer<shared::Photon> tracedBuffer(device, traced, "photons as traced");
    Buffer<shared::RegionCount> regionBuffer(device, counts, "photon regions");
    Buffer<uint32_t> cellCounts(device, cells * map.chunks, "photon cell counts");
    Buffer<uint32_t> blockSums(device, map.scanBlocks, "photon scan blocks");
    index.cellStart = Buffer<uint32_t>(device, cells + 1, "photon cells");
    index.sorted = Buffer<uint32_t>(device, size_t(settings.storesDepth ? 9 : 8) * map.photonStride, "photons sorted");
    index.sorted.fill(0);
    Buffer<uint32_t> tables(device, 1, "scene tables"); // photons in media alone read them
    program.kernel("countRecords").launchFew(map.chunks, tracedBuffer, regionBuffer, tables, cellCounts, map);
    program.kernel("sumBlocks").launchFew(map.scanBlocks, cellCounts, blockSums, map);
    program.kernel("scanCells").launchFew(map.scanBlocks, cellCounts, blockSums, index.cellStart, map);
    program.kernel("scatterRecords")
        .launchFew(map.chunks, tracedBuffer, regionBuffer, tables, cellCounts, index.sorted, map);
    return index;
}

} // namespace quasilux
