// Regions: the paths that one work-item follows, one after the other. Long ones on a CPU, whose cores each take a few;
// short ones on a GPU, which needs some hundred thousand work-items, and whose driver may end a kernel in which one
// takes seconds.
#pragma once

#include "device/device.h"

namespace quasilux {

inline unsigned photonsPerRegion(const DeviceInfo& device) { return device.isCpu ? 256 : 16; }
/// Of the camera map.
inline unsigned pixelsPerRegion(const DeviceInfo& device) { return device.isCpu ? 64 : 16; }

inline unsigned regionsOf(size_t paths, unsigned perRegion) {
    return static_cast<unsigned>((paths + perRegion - 1) / perRegion);
}

} // namespace quasilux
