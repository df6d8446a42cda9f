// Where the records of each slot and cell stand in a pass's index: the table of a counting sort (kernels/cell_scan.clh), whether
// the records are photons or camera points.
#pragma once

#include "device/program.h"
#include "pass_types.h"
#include "render/memory_plan.h"

#include <array>
#include <cstdint>

namespace quasilux {

/// Records are read so many at a time: the last group may reach beyond the last record (PHOTONS_READ of photon_grid.clh).
constexpr size_t recordsRead = 8;

class CellTable {
public:
    /// `pass` holds the kernels; `slots` are the bits 1 << slot that occur; `noun` names the records in labels of buffers
    /// and in messages.
    CellTable(Device& device, const Program& pass, unsigned slots, std::string noun);

    /// Makes room for about `expected` records, which come from this many regions.
    void make(uint64_t expected, unsigned regions);
    /// The buffers that it then takes, by label.
    static BufferSizes plan(unsigned slots, uint64_t expected, unsigned regions, const std::string& noun,
                            const DeviceInfo& device);

    /// From counts of each chunk and cell to the place where the chunk's first record of the cell goes.
    void scan();

    /// Records by slot, as last scanned.
    std::array<uint64_t, PHOTON_SLOTS> countBySlot() const;

    /// All kernels see it, so its radii must be set.
    shared::MapParams& map() { return map_; }
    const shared::MapParams& map() const { return map_; }
    const Buffer<uint32_t>& counts() const { return counts_; }
    const Buffer<uint32_t>& cellStart() const { return cellStart_; }
    const std::string& noun() const { return noun_; }

private:
    Device& device_;
    Kernel sumBlocks_, scanCells_;
    unsigned slots_;
    std::string noun_;
    shared::MapParams map_{};
    Buffer<uint32_t> counts_, blockSums_, cellStart_;
};

} // namespace quasilux
