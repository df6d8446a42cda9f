#include "render/point_index.h"

#include "util/error.h"

#include <fmt/format.h>

namespace quasilux {

namespace {

constexpr unsigned keySide = sizeof(shared::CameraPoint) / sizeof(uint32_t);
static_assert(offsetof(shared::CameraPoint, cell) == 0);

} // namespace

PointIndex::PointIndex(Device& device, const Program& pass, unsigned slots)
    : device_(device), table_(device, pass, slots, keySide, "camera point"), countPoints_(pass.kernel("countPoints")),
      placePoints_(pass.kernel("placePoints")), gatherPoints_(pass.kernel("gatherPoints")) {}

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
    const auto countFirst = [&](const auto& digit, const auto& counts) {
        countPoints_.launchLong(digit.chunks, points, regions, geometry.tables, counts, digit, map);
    };
    const auto placeFirst = [&](const auto& digit, const auto& counts, const auto& to) {
        placePoints_.launchLong(digit.chunks, points, regions, counts, to.buffer, to.at, digit, map);
    };
    const auto records = static_cast<unsigned>(count);
    // The first array, of coordinates, is filled last, so until then it is free (POINT_* of kernels/photon_grid.clh).
    table_.sort(records, {countFirst, placeFirst}, points, {sorted_, uint64_t(POINT_FIELDS - 1) * map.photonStride},
                {sorted_, 0});
    gatherPoints_.launch(records, points, sorted_, records, map);
}

size_t PointIndex::pointBytes() { return POINT_FIELDS * sizeof(uint32_t); }

} // namespace quasilux
