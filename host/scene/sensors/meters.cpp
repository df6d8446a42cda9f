// Sensors that are no cameras.
#include "scene/sensors/sensors.h"

#include <fmt/format.h>
#include <limits>

namespace quasilux {

namespace {

/// Any frame whose z axis is `direction`: nothing else of it matters.
glm::dmat4 lookAlong(const glm::dvec3& origin, const glm::dvec3& direction) {
    glm::dmat4 toWorld(1.0);
    toWorld[2] = glm::dvec4(direction, 0);
    toWorld[3] = glm::dvec4(origin, 1);
    return toWorld;
}

} // namespace

void readRadiancemeter(Properties& properties, Sensor& sensor) {
    const bool hasOrigin = properties.has("origin"), hasDirection = properties.has("direction");
    if (hasOrigin != hasDirection)
        throw InputError(sensor.where,
                         fmt::format("the radiancemeter has {} only; give origin and direction, or to_world.",
                                     hasOrigin ? "an origin" : "a direction"));
    if (hasOrigin && properties.has("to_world"))
        throw InputError(properties.where("to_world"),
                         "the radiancemeter has to_world beside origin and direction; keep one.");
    const glm::dvec3 origin = properties.vector("origin", {}), direction = properties.direction("direction", {0, 0, 1});
    sensor.toWorld = hasOrigin ? lookAlong(origin, direction) : properties.transform("to_world");
    if (sensor.width != 1 || sensor.height != 1)
        throw InputError(sensor.where, fmt::format("the radiancemeter has a film of {} x {} pixels; expected 1 x 1.",
                                                   sensor.width, sensor.height));
    sensor.meter = MeterKind::ray;
    sensor.nearClip = 0;
    sensor.farClip = std::numeric_limits<double>::infinity();
}

/// <sensor type="irradiancemeter">: the irradiance on the shape that it stands in.
void readIrradiancemeter(Properties& properties, Sensor& sensor) {
    properties.refuse("to_world", "the meter lies on its shape; move the shape instead");
    sensor.meter = MeterKind::area;
}

} // namespace quasilux
