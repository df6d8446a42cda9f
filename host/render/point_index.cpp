#include "render/point_index.h"

#include "util/error.h"

#include <fmt/format.h>

namespace quasilux {

PointIndex::PointIndex(Device& device, const Program& pass, unsigned slots)
    : device_(device), table_(device, pass, slots, "camera point"), countPoints_(pass.kernel("countPoints")),
      scatterPoints_(pass.kernel("scatterPoints")) {}

void PointIndex::make(uint64_t expected, unsigned regions) {
    table_.make(expected, regions);
    reserve(expected);
}

void PointIndex::reserve(uint64_t points) {
    unsigned& stride = table_.map().photonStride;
    if (points + recordsRead <= stride) return;
    const uint64_t wanted = (stride == 0 ? points : points + points / 4) + recordsRead;
    if (wanted > UINT32_MAX)
        throw DeviceError(fmt::format("{} camera points in one pass, at most {} can be indexed: use a smaller image "
                                      "or --map photons",
                                      points, UINT32_MAX));
    stride = static_cast<unsigned>(wanted);
    sorted_ = Buffer<uint32_t>();
    sorted_ = Buffer<uint32_t>(device_, size_t(POINT_FIELDS) * stride, "camera points sorted");
    sorted_.fill(0); // lanes beyond the last record are read, with weight 0: they must be finite
}

void PointIndex::sort(const Buffer<shared::CameraPoint>& points, const Buffer<shared::PointRegionCount>& regions,
                      const GeometryBuffers& geometry, uint64_t count) {
    reserve(count);
    const shared::MapParams& map = table_.map();
    countPoints_.launchFew(map.chunks, points, regions, geometry.tables, table_.counts(), map);
    table_.scan();
    scatterPoints_.launchFew(map.chunks, points, regions, geometry.tables, table_.counts(), sorted_, map);
}

size_t PointIndex::pointBytes() { return POINT_FIELDS * sizeof(uint32_t); }

} // namespace quasilux
