#include "output/render_record.h"

#include "scene/sensors/sensors.h"

#include <numbers>

namespace quasilux {

std::optional<FisheyeView> fisheyeViewOf(const Sensor& sensor) {
    const bool isWhole = sensor.width == sensor.filmWidth && sensor.height == sensor.filmHeight;
    if (sensor.fisheye == FISHEYE_NONE || !isWhole) return std::nullopt;
    return FisheyeView{fisheyeName(sensor.fisheye), sensor.fovX * 180 / std::numbers::pi};
}

} // namespace quasilux
