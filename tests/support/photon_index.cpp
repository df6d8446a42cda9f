#include "support/photon_index.h"

#include "render/cell_table.h"
#include "support/test_kernels.h"

#include <algorithm>
#include <bit>
#include <fmt/format.h>

namespace quasilux {

namespace {

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
    return fmt::format("-DHAS_LOBE_LAMBERT -DBVH_STACK_SIZE=32 -DPHOTON_CLASSES={}u{}{}", settings.classes,
                       settings.storesDepth ? " -DHAS_DEPTH_LIMIT" : "", settings.field.octaves > 0 ? " -DLEARNS" : "");
}

PhotonIndex indexPhotons(const std::vector<TracedPhoton>& photons, const PhotonIndexSettings& settings) {
    Device& device = testDevice();
    PhotonIndex index;
    index.photons = photons.size();
    shared::MapParams& map = index.map;
    std::copy(settings.radius.begin(), settings.radius.end(), map.radius);
    map.field = settings.field;
    map.cellMask = settings.cells - 1;
    map.chunks = settings.chunks;
    map.scanBlocks = settings.scanBlocks;
    map.regions = settings.regions;
    map.fluxUnit = settings.fluxUnit;
    map.photonStride = unsigned(photons.size() + settings.regions * PHOTON_BLOCK + recordsRead);

    const TracedLayout traced =
        layOutPhotons(photons, regionEnds(photons.size(), settings.regions), map.photonStride, settings.storesDepth);
    Program program(device, "photon_map.cl", photonIndexOptions(settings));
    const size_t cells = size_t(std::popcount(settings.classes)) * settings.cells;
    Buffer<uint32_t> blocks(device, traced.blocks, "photon blocks");
    Buffer<shared::RegionCount> regions(device, traced.regions, "photon regions");
    Buffer<uint32_t> cellCounts(device, cells * map.chunks, "photon cell counts");
    Buffer<uint32_t> blockSums(device, map.scanBlocks, "photon scan blocks");
    index.cellStart = Buffer<uint32_t>(device, cells + 1, "photon cells");
    index.sorted = Buffer<uint32_t>(device, traced.arrays, "photons");
    Buffer<uint32_t> tables(device, 1, "scene tables"); // photons in media alone read them
    program.kernel("countPhotons").launchFew(map.chunks, index.sorted, blocks, regions, tables, cellCounts, map);
    program.kernel("sumBlocks").launchFew(map.scanBlocks, cellCounts, blockSums, map);
    program.kernel("scanCells").launchFew(map.scanBlocks, cellCounts, blockSums, index.cellStart, map);
    program.kernel("placePhotons").launchFew(map.chunks, index.sorted, blocks, regions, cellCounts, map);
    for (unsigned field = 0; field < (settings.storesDepth ? 7u : 6u); ++field)
        program.kernel("movePhotons")
            .launch(std::max(photons.size(), recordsRead), index.sorted, field, unsigned(photons.size()), map);
    return index;
}

} // namespace quasilux
