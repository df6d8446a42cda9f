#include "support/photon_index.h"

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
    Program program(device, "photon_map.cl", photonIndexOptions(settings));
    program.add("every_scene.cl", "");
    CellTable table(device, program, settings.classes, 1, "photon");
    table.make(settings.cells, settings.regions, settings.parts);
    shared::MapParams& map = table.map();
    std::copy(settings.radius.begin(), settings.radius.end(), map.radius);
    map.field = settings.field;
    map.fluxUnit = settings.fluxUnit;
    map.photonStride = unsigned(photons.size() + settings.regions * PHOTON_BLOCK + recordsRead);
    index.map = map;

    const TracedLayout traced =
        layOutPhotons(photons, regionEnds(photons.size(), settings.regions), map.photonStride, settings.storesDepth);
    Buffer<uint32_t> blocks(device, traced.blocks, "photon blocks");
    Buffer<shared::RegionCount> regions(device, traced.regions, "photon regions");
    index.sorted = Buffer<uint32_t>(device, traced.arrays, "photons");
    Buffer<uint32_t> tables(device, 1, "scene tables"); // photons in media alone read them
    Buffer<uint32_t> spare(device, photons.size(), "photon order");
    Kernel count = program.kernel("countPhotons"), place = program.kernel("placePhotons");
    const auto countFirst = [&](const auto& digit, const auto& counts) {
        count.launchLong(digit.chunks, index.sorted, blocks, regions, tables, counts, digit, map);
    };
    const auto placeFirst = [&](const auto& digit, const auto& counts, const auto& to) {
        place.launchLong(digit.chunks, index.sorted, blocks, regions, counts, to.buffer, to.at, digit, map);
    };
    const unsigned source = settings.storesDepth ? 8 : 7; // behind the last field as traced
    table.sort(unsigned(photons.size()), {countFirst, placeFirst}, index.sorted,
               {index.sorted, uint64_t(source) * map.photonStride}, {spare, 0});
    index.cellStart = table.cellStart();
    for (unsigned field = 0; field < (settings.storesDepth ? 7u : 6u); ++field)
        program.kernel("movePhotons")
            .launch(std::max(photons.size(), recordsRead), index.sorted, field, source, unsigned(photons.size()), map);
    return index;
}

} // namespace quasilux
