#include "render/photon_arrays.h"

#include "util/error.h"

#include <algorithm>
#include <fmt/format.h>

namespace quasilux {

namespace {

constexpr unsigned photonFields(bool storesDepth) { return PHOTON_FIELDS_WITHOUT_DEPTH + (storesDepth ? 1 : 0); }
// One array is free, so that the next field has where to go; one says where each photon goes; on GPUs, which sort by
// several digits, one more.
unsigned arrayCount(bool storesDepth, const DeviceInfo& device) {
    return photonFields(storesDepth) + (device.isCpu ? 2 : 3);
}

constexpr uint64_t divideUp(uint64_t count, uint64_t by) { return (count + by - 1) / by; }

// The last block of each region is not full.
uint64_t blocksFor(uint64_t photons, unsigned regions) { return divideUp(photons, PHOTON_BLOCK) + regions; }

// A block more, so that all blocks begin on a cache line; records are read beyond the last one.
uint64_t strideOf(uint64_t blocks) { return (blocks + 1) * PHOTON_BLOCK; }
static_assert(recordsRead <= PHOTON_BLOCK);

// Photons are numbered by 32 bits.
constexpr uint64_t blocksMax = UINT32_MAX / PHOTON_BLOCK - 1;

// From so many work-items on, kernels are compiled anew (docs/method/memory.md, "Time to build and compile").
constexpr size_t manyWorkItems = 65536;

const std::string noun = "photon";

struct ArrayBuffers {
    ArrayBuffers(uint64_t blockCount, bool storesDepth, const DeviceInfo& device)
        : arrays{"photons", arrayCount(storesDepth, device) * strideOf(blockCount)}, blocks{"photon blocks",
                                                                                            1 + blockCount} {}
    PlannedBuffer<uint32_t> arrays, blocks;
};

} // namespace

PhotonArrays::PhotonArrays(Device& device, const Program& pass, unsigned slots, bool storesDepth)
    : device_(device), table_(device, pass, slots, 1, noun), countPhotons_(pass.kernel("countPhotons")),
      placePhotons_(pass.kernel("placePhotons")), movePhotons_(pass.kernel("movePhotons")), storesDepth_(storesDepth) {}

void PhotonArrays::make(uint64_t photons, unsigned regions) {
    table_.make(photons, regions);
    makeBlocks(blocksFor(photons, regions));
}

BufferSizes PhotonArrays::plan(unsigned slots, uint64_t photons, unsigned regions, bool storesDepth,
                               const DeviceInfo& device) {
    BufferSizes sizes = CellTable::plan(slots, photons, regions, noun, device);
    const ArrayBuffers buffers(blocksFor(photons, regions), storesDepth, device);
    sizes.merge(sizesOf(buffers.arrays, buffers.blocks));
    return sizes;
}

void PhotonArrays::makeBlocks(uint64_t count) {
    if (count > blocksMax)
        throw DeviceError(fmt::format("room for {} photons in one pass, at most {} can be indexed: use fewer --photons",
                                      count * PHOTON_BLOCK, blocksMax * PHOTON_BLOCK));
    blockCount_ = static_cast<unsigned>(count);
    table_.map().photonStride = static_cast<unsigned>(strideOf(count));
    arrays_ = {};
    blocks_ = {};
    const ArrayBuffers buffers(count, storesDepth_, device_.info());
    arrays_ = buffers.arrays.make(device_);
    blocks_ = buffers.blocks.make(device_);
}

bool PhotonArrays::enlarge(const std::vector<shared::RegionCount>& regions) {
    uint64_t wanted = 0;
    bool lacking = false;
    for (const auto& region : regions) {
        wanted += divideUp(region.wanted, PHOTON_BLOCK);
        lacking |= region.wanted > region.stored;
    }
    if (lacking) makeBlocks(std::max(wanted, std::min(wanted + wanted / 8, blocksMax)));
    return lacking;
}

void PhotonArrays::clear() { blocks_.write({0u}); }

void PhotonArrays::sort(const Buffer<shared::RegionCount>& regionBuffer,
                        const std::vector<shared::RegionCount>& regions, const GeometryBuffers& geometry) {
    uint64_t stored = 0;
    for (const auto& region : regions) stored += region.stored;
    const shared::MapParams& map = table_.map();
    const auto countFirst = [&](const auto& digit, const auto& counts) {
        countPhotons_.launchLong(digit.chunks, arrays_, blocks_, regionBuffer, geometry.tables, counts, digit, map);
    };
    const auto placeFirst = [&](const auto& digit, const auto& counts, const auto& to) {
        placePhotons_.launchLong(digit.chunks, arrays_, blocks_, regionBuffer, counts, to.buffer, to.at, digit, map);
    };
    const uint64_t stride = map.photonStride;
    const unsigned source = photonFields(storesDepth_) + 1;
    table_.sort(static_cast<unsigned>(stored), {countFirst, placeFirst}, arrays_, {arrays_, source * stride},
                {arrays_, (source + 1) * stride});
    for (unsigned field = 0; field < photonFields(storesDepth_); ++field)
        movePhotons_.launch(std::max<size_t>(stored, recordsRead), arrays_, field, source,
                            static_cast<unsigned>(stored), map);
}

void PhotonArrays::compile() { movePhotons_.launch(manyWorkItems, arrays_, 0u, 0u, 0u, table_.map()); }

size_t PhotonArrays::photonBytes(bool storesDepth, const DeviceInfo& device) {
    return arrayCount(storesDepth, device) * sizeof(uint32_t);
}

} // namespace quasilux
