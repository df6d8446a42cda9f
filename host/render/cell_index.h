// Stage of a pass that indexes what another one has traced: a stable counting sort of records by slot and cell
// (kernels/cell_sort.clh), whether they are photons or camera points.
#pragma once

#include "device/program.h"
#include "pass_types.h"
#include "render/geometry_buffers.h"
#include "render/memory_plan.h"

#include <array>
#include <cstdint>

namespace quasilux {

class CellIndex {
public:
    /// `pass` holds the kernels for this kind of record; `slots` are the bits 1 << slot that occur; `fields` are 32-bit
    /// words of a record in the index; `noun` names the records in labels of buffers and in messages.
    CellIndex(Device& device, const Program& pass, unsigned slots, size_t fields, std::string noun);

    /// Makes a table for about `expected` records, which come from this many regions.
    void makeTable(uint64_t expected, unsigned regions);
    /// The buffers that it then takes, by label.
    static BufferSizes plan(unsigned slots, uint64_t expected, unsigned regions, size_t fields, const std::string& noun,
                            const DeviceInfo& device);

    /// Room for so many records, with some to spare where it has proved too small.
    void reserve(uint64_t records);

    /// Indexes `count` records that stand in regions as `map().regionCapacity` says. All kernels see `map()`, so its
    /// radii must be set.
    template <typename Record, typename RegionCount>
    void sort(const Buffer<Record>& records, const Buffer<RegionCount>& regions, const GeometryBuffers& geometry,
              uint64_t count) {
        reserve(count);
        countRecords_.launchFew(map_.chunks, records, regions, geometry.tables, counts_, map_);
        sumBlocks_.launchFew(map_.scanBlocks, counts_, blockSums_, map_);
        scanCells_.launchFew(map_.scanBlocks, counts_, blockSums_, cellStart_, map_);
        scatterRecords_.launchFew(map_.chunks, records, regions, geometry.tables, counts_, sorted_, map_);
    }

    /// Records by slot, as last sorted.
    std::array<uint64_t, PHOTON_SLOTS> countBySlot() const;

    shared::MapParams& map() { return map_; }
    const shared::MapParams& map() const { return map_; }
    const Buffer<uint32_t>& cellStart() const { return cellStart_; }
    const Buffer<uint32_t>& sorted() const { return sorted_; }
    /// Of a record in the index.
    size_t recordBytes() const { return fields_ * sizeof(uint32_t); }

private:
    Device& device_;
    Kernel countRecords_, sumBlocks_, scanCells_, scatterRecords_;
    unsigned slots_;
    size_t fields_;
    std::string noun_;
    shared::MapParams map_{};
    Buffer<uint32_t> counts_, blockSums_, cellStart_, sorted_;
};

} // namespace quasilux
