// The photons of a pass: traced into arrays (kernels/photon_store.clh) and sorted by slot and cell within the same
// memory (kernels/photon_map.cl, record_sort.cl).
#pragma once

#include "render/cell_table.h"
#include "render/geometry_buffers.h"

#include <vector>

namespace quasilux {

class PhotonArrays {
public:
    /// `pass` holds photon_map.cl and record_sort.cl; `slots` are the bits 1 << slot that occur; `storesDepth` where
    /// the kernels are compiled with HAS_DEPTH_LIMIT.
    PhotonArrays(Device& device, const Program& pass, unsigned slots, bool storesDepth);

    /// Room for so many photons of this many regions. What was stored is lost.
    void make(uint64_t photons, unsigned regions);
    /// The buffers that it then takes, by label.
    static BufferSizes plan(unsigned slots, uint64_t photons, unsigned regions, bool storesDepth,
                            const DeviceInfo& device);
    /// Makes more room where the regions want more than they could store; false where they have stored all.
    bool enlarge(const std::vector<shared::RegionCount>& regions);
    /// All blocks are free again: to be called before photons are traced.
    void clear();

    /// Sorts the photons that the regions have stored.
    void sort(const Buffer<shared::RegionCount>& regionBuffer, const std::vector<shared::RegionCount>& regions,
              const GeometryBuffers& geometry);

    /// Has compiled what only passes of many photons would otherwise.
    void compile();

    CellTable& table() { return table_; }
    const CellTable& table() const { return table_; }
    unsigned blockCount() const { return blockCount_; }
    Buffer<uint32_t>& blocks() { return blocks_; }
    Buffer<uint32_t>& arrays() { return arrays_; }
    const Buffer<uint32_t>& sorted() const { return arrays_; }
    /// Of a photon, traced and sorted together.
    static size_t photonBytes(bool storesDepth, const DeviceInfo& device);

private:
    void makeBlocks(uint64_t count);

    Device& device_;
    CellTable table_;
    Kernel countPhotons_, placePhotons_, movePhotons_;
    bool storesDepth_;
    unsigned blockCount_ = 0;
    Buffer<uint32_t> arrays_, blocks_;
};

} // namespace quasilux
