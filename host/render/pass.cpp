#include "render/pass.h"

#include "render/camera_map_pass.h"
#include "render/meter_pass.h"
#include "render/photon_map_pass.h"
#include "util/process_memory.h"

namespace quasilux {

std::unique_ptr<Pass> makePass(const PassContext& context) {
    if (context.settings.map == MapOrder::camera) return std::make_unique<CameraMapPass>(context);
    if (context.flat.offsets.meter.kind != METER_NONE) return std::make_unique<MeterPass>(context);
    return std::make_unique<PhotonMapPass>(context);
}

MemoryForecast forecastOf(const PassContext& context, const BufferSizes& sizes, uint64_t untouched) {
    const uint64_t toCome =
        developBytes(context.flat, context.settings) + (context.device.info().isCpu ? untouched : 0);
    return {sumOf(sizes), std::max(peakResidentBytes(), residentBytes() + toCome)};
}

} // namespace quasilux
