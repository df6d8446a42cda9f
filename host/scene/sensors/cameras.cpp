// Cameras.
#include "scene/sensors/field_of_view.h"
#include "scene/sensors/sensors.h"
#include "scene/transform.h"

namespace quasilux {

namespace {

/// A camera is moved and turned (or mirrored), not scaled.
glm::dmat4 readPlacement(Properties& properties) {
    const glm::dmat4 toWorld = properties.transform("to_world");
    if (!keepsAngles(glm::dmat3(toWorld), 1, 1e-3))
        throw InputError(properties.where("to_world"), "to_world of the sensor scales or shears; use only translate, "
                                                       "rotate and lookat.");
    return toWorld;
}

/// What both have.
void readView(Properties& properties, Sensor& sensor) {
    sensor.fovX = readFieldOfView(properties, static_cast<double>(sensor.filmWidth) / sensor.filmHeight);
    sensor.toWorld = readPlacement(properties);
}

} // namespace

/// <sensor type="perspective">: a pinhole camera.
void readPerspective(Properties& properties, Sensor& sensor) {
    readView(properties, sensor);
    sensor.principalPoint = {properties.number("principal_point_offset_x", 0),
                             properties.number("principal_point_offset_y", 0)};
}

/// <sensor type="thinlens">.
void readThinLens(Properties& properties, Sensor& sensor) {
    readView(properties, sensor);
    if (!properties.has("aperture_radius"))
        throw InputError(sensor.where, "sensor 'thinlens' needs <float name=\"aperture_radius\" value=\"...\"/>.");
    sensor.apertureRadius = properties.numberAbove("aperture_radius", 0, 0, false);
    sensor.focusDistance = properties.numberAbove("focus_distance", sensor.farClip, 0, true);
}

/// <sensor type="orthographic">: parallel rays; to_world scales the [-1, 1] that the film is wide.
void readOrthographic(Properties& properties, Sensor& sensor) {
    sensor.orthographic = true;
    sensor.toWorld = properties.transform("to_world");
}

} // namespace quasilux
