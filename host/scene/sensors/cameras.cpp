// Cameras.
#include "scene/sensors/field_of_view.h"
#include "scene/sensors/sensors.h"
#include "scene/transform.h"

#include <algorithm>
#include <fmt/format.h>

namespace quasilux {

namespace {

/// By FISHEYE_*, from 1 on.
const Names fisheyeNames{"equidistant", "equisolid", "orthographic"};

/// A camera is moved and turned (or mirrored), not scaled.
glm::dmat4 readPlacement(Properties& properties) {
    const glm::dmat4 toWorld = properties.transform("to_world");
    if (!keepsAngles(glm::dmat3(toWorld), 1, 1e-3))
        throw InputError(properties.where("to_world"), "to_world of the sensor scales or shears; use only translate, "
                                                       "rotate and lookat.");
    return toWorld;
}

/// Mitsuba has it for all cameras, but only a lens makes use of it.
const Names ofLenses = {"focus_distance"};

/// What both have.
void readView(Properties& properties, Sensor& sensor) {
    sensor.fovX = readFieldOfView(properties, static_cast<double>(sensor.filmWidth) / sensor.filmHeight);
    sensor.toWorld = readPlacement(properties);
}

} // namespace

/// <sensor type="perspective">: a pinhole camera.
void readPerspective(Properties& properties, Sensor& sensor) {
    readView(properties, sensor);
    properties.accept(ofLenses);
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
    properties.accept(ofLenses);
    sensor.toWorld = properties.transform("to_world");
}

/// <sensor type="quasilux_fisheye">: a circle as wide as the film, black about it.
void readFisheye(Properties& properties, Sensor& sensor) {
    sensor.toWorld = readPlacement(properties);
    const std::string projection = properties.choice("projection", "equidistant", fisheyeNames);
    sensor.fisheye = 1 + static_cast<unsigned>(std::find(fisheyeNames.begin(), fisheyeNames.end(), projection) -
                                               fisheyeNames.begin());
    const double degrees = properties.number("fov", 180), most = sensor.fisheye == FISHEYE_ORTHOGRAPHIC ? 180 : 360;
    if (!(degrees > 0 && degrees <= most))
        throw InputError(properties.where("fov"),
                         fmt::format("parameter 'fov' is {}; expected degrees above 0 and up to {} of projection '{}'.",
                                     degrees, most, projection));
    sensor.fovX = glm::radians(degrees);
}

std::string fisheyeName(unsigned fisheye) { return std::string(fisheyeNames.at(fisheye - 1)); }

} // namespace quasilux
