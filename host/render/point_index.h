// The camera points of a pass, sorted by slot and cell (kernels/camera_point_map.cl, record_sort.cl).
#pragma once

#include "render/cell_table.h"
#include "render/geometry_buffers.h"

namespace quasilux {

class PointIndex {
public:
    /// `pass`: of --map camera; `slots` are the bits 1 << slot that occur.
    PointIndex(Device& device, const Program& pass, unsigned slots);

    /// Makes room for about `expected` points, which come from this many regions.
    void make(uint64_t expected, unsigned regions);
    /// Room for so many points, with some to spare where it has proved too small.
    void reserve(uint64_t points);
    /// Sorts `count` points that stand in regions as `table().map().regionCapacity` says.
    void sort(const Buffer<shared::CameraPoint>& points, const Buffer<shared::PointRegionCount>& regions,
              const GeometryBuffers& geometry, uint64_t count);

    CellTable& table() { return table_; }
    const Buffer<uint32_t>& sorted() const { return sorted_; }
    /// Of a point in the index.
    static size_t pointBytes();

private:
    Device& device_;
    CellTable table_;
    Kernel countPoints_, placePoints_, gatherPoints_;
    Buffer<uint32_t> sorted_;
};

} // namespace quasilux
