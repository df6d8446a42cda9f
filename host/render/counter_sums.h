// Counters of different passes as those of all of them.
#pragma once

#include "device/device.h"
#include "render/renderer.h"

namespace quasilux {

void addCounts(RenderCounters& all, const RenderCounters& part);
void addTimings(std::map<std::string, KernelTiming>& all, const std::map<std::string, KernelTiming>& part);

} // namespace quasilux
