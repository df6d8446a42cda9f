#include "render/cell_table.h"

#include <algorithm>
#include <bit>

namespace quasilux {

namespace {

// A few cells per disc's worth of records: collisions of rows only cost tests, and memory, on a GPU for each of many chunks,
// more than on a CPU.
unsigned cellsPerSlot(uint64_t records, const DeviceInfo& device) {
    const uint64_t recordsPerCell = device.isCpu ? 4 : 8, least = device.isCpu ? 16384 : 4096;
    return static_cast<unsigned>(std::clamp<uint64_t>(std::bit_ceil(records / recordsPerCell), least, 1u << 28));
}

// On a CPU a long chunk for each core, since each has counts of its own for all cells; on a GPU enough of them to occupy it.
unsigned chunksFor(const DeviceInfo& device, unsigned regions) {
    return std::min(regions, device.isCpu ? device.computeUnits : 256u);
}

unsigned scanBlocksFor(size_t cells, const DeviceInfo& device) {
    return static_cast<unsigned>(std::clamp<size_t>(cells / 256, 1, device.isCpu ? 64 : 4096));
}

} // namespace

CellTable::CellTable(Device& device, const Program& pass, unsigned slots, std::string noun)
    : device_(device), sumBlocks_(pass.kernel("sumBlocks")), scanCells_(pass.kernel("scanCells")), slots_(slots),
      noun_(std::move(noun)) {}

void CellTable::make(uint64_t expected, unsigned regions) {
    map_.regions = regions;
    map_.cellMask = cellsPerSlot(expected, device_.info()) - 1;
    map_.chunks = chunksFor(device_.info(), regions);
    const size_t cells = size_t(std::popcount(slots_)) * (map_.cellMask + 1);
    map_.scanBlocks = scanBlocksFor(cells, device_.info());
    counts_ = Buffer<uint32_t>(device_, cells * map_.chunks, noun_ + " cell counts");
    blockSums_ = Buffer<uint32_t>(device_, map_.scanBlocks, noun_ + " scan blocks");
    cellStart_ = Buffer<uint32_t>(device_, cells + 1, noun_ + " cells");
}

BufferSizes CellTable::plan(unsigned slots, uint64_t expected, unsigned regions, const std::string& noun,
                            const DeviceInfo& device) {
    const size_t cells = size_t(std::popcount(slots)) * cellsPerSlot(expected, device);
    return {{noun + " cell counts", std::max<size_t>(1, cells * chunksFor(device, regions)) * sizeof(uint32_t)},
            {noun + " scan blocks", scanBlocksFor(cells, device) * sizeof(uint32_t)},
            {noun + " cells", (cells + 1) * sizeof(uint32_t)}};
}

void CellTable::scan() {
    sumBlocks_.launchFew(map_.scanBlocks, counts_, blockSums_, map_);
    scanCells_.launchFew(map_.scanBlocks, counts_, blockSums_, cellStart_, map_);
}

std::array<uint64_t, PHOTON_SLOTS> CellTable::countBySlot() const {
    std::array<uint64_t, PHOTON_SLOTS> counted{};
    size_t first = 0; // cell where the slot begins; its records stand between the starts of two slots
    for (unsigned slot = 0; slot < PHOTON_SLOTS; ++slot) {
        if (!(slots_ >> slot & 1)) continue;
        const size_t end = first + map_.cellMask + 1;
        counted[slot] = cellStart_.read(end, 1).front() - cellStart_.read(first, 1).front();
        first = end;
    }
    return counted;
}

} // namespace quasilux
