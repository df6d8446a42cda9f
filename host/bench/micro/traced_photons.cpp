#include "bench/micro/traced_photons.h"

#include <algorithm>
#include <bit>

namespace quasilux {

namespace {

void putDown(const TracedPhoton& photon, size_t at, size_t stride, bool storesDepth, std::vector<uint32_t>& arrays) {
    std::vector<uint32_t> fields{photon.slot,
                                 std::bit_cast<uint32_t>(photon.position.x),
                                 std::bit_cast<uint32_t>(photon.position.y),
                                 std::bit_cast<uint32_t>(photon.position.z),
                                 photon.flux,
                                 photon.patchSide,
                                 photon.direction};
    if (storesDepth) fields.push_back(photon.depth);
    for (size_t array = 0; array < fields.size(); ++array) arrays[array * stride + at] = fields[array];
}

} // namespace

TracedLayout layOutPhotons(const std::vector<TracedPhoton>& photons, const std::vector<size_t>& regionEnds,
                           size_t stride, bool storesDepth) {
    TracedLayout made;
    constexpr uint32_t nan = 0x7fc00000; // what was there before may be anything
    made.arrays.assign((storesDepth ? 9 : 8) * stride, nan);
    made.blocks.assign(1, 0);
    made.regions.resize(regionEnds.size());
    const auto beginOf = [&](size_t region) { return region == 0 ? 0 : regionEnds[region - 1]; };
    bool any = true;
    for (size_t round = 0; any; ++round) {
        any = false;
        for (size_t region = 0; region < regionEnds.size(); ++region) {
            const size_t begin = beginOf(region) + round * PHOTON_BLOCK;
            if (begin >= regionEnds[region]) continue;
            any = true;
            shared::RegionCount& count = made.regions[region];
            const uint32_t block = made.blocks[0]++;
            made.blocks.push_back(0);
            if (round == 0)
                count.firstBlock = block;
            else
                made.blocks[1 + count.lastBlock] = block;
            count.lastBlock = block;
            for (size_t k = begin; k < std::min(begin + PHOTON_BLOCK, regionEnds[region]); ++k, ++count.stored)
                putDown(photons[k], block * PHOTON_BLOCK + k - begin, stride, storesDepth, made.arrays);
            count.wanted = count.stored;
        }
    }
    return made;
}

} // namespace quasilux
