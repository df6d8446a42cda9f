#include "output/render_record.h"

#include "scene/sensors/sensors.h"

#include <numbers>

namespace quasilux {

std::optional<ImageView> imageViewOf(const Sensor& sensor) {
    const bool isWhole = sensor.width == sensor.filmWidth && sensor.height == sensor.filmHeight;
    const bool isInMiddle = sensor.principalPoint.x == 0 && sensor.principalPoint.y == 0;
    if (sensor.meter != MeterKind::none || sensor.orthographic || !isWhole || !isInMiddle) return std::nullopt;
    return ImageView{sensor.fisheye == FISHEYE_NONE ? "perspective" : fisheyeName(sensor.fisheye),
                     sensor.fovX * 180 / std::numbers::pi};
}

} // namespace quasilux
