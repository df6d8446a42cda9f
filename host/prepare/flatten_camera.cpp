// Sensor into the kernels' camera. Mitsuba's camera looks along its +z with +y up and +x to the left of the image.
#include "prepare/device_scene.h"
#include "prepare/filter_table.h"
#include "prepare/pack.h"

namespace quasilux {

namespace {

// From the middle of the film to the upper left corner of the image, pixels to the left and up.
glm::dvec2 toCorner(const Sensor& sensor) {
    return {sensor.filmWidth / 2.0 - sensor.cropX, sensor.filmHeight / 2.0 - sensor.cropY};
}

void placePerspective(const Sensor& sensor, shared::Camera& camera) {
    const glm::dmat3 rotation(sensor.toWorld);
    const glm::dvec3 left = glm::normalize(rotation[0]), up = glm::normalize(rotation[1]),
                     forward = glm::normalize(rotation[2]);
    const double halfWidth = std::tan(sensor.fovX / 2);
    const double step = 2 * halfWidth / sensor.filmWidth;
    camera.origin = pack(glm::dvec3(sensor.toWorld[3]));
    camera.stepX = pack(-left * step);
    camera.stepY = pack(-up * step);
    const glm::dvec2 corner =
        toCorner(sensor) - sensor.principalPoint * glm::dvec2(sensor.filmWidth, sensor.filmHeight);
    camera.corner = pack(forward + step * (left * corner.x + up * corner.y));
    if (sensor.apertureRadius > 0) {
        camera.lensX = pack(left * sensor.apertureRadius);
        camera.lensY = pack(up * sensor.apertureRadius);
        camera.focusDistance = static_cast<float>(sensor.focusDistance);
    }
    camera.forward = pack(forward);
}

// Rays start on the near plane; as in Mitsuba a scale moves that plane, while the length of the rays is not scaled.
void placeOrthographic(const Sensor& sensor, shared::Camera& camera) {
    const glm::dmat3 axes(sensor.toWorld);
    const glm::dvec3 left = axes[0], up = axes[1];
    const double step = 2.0 / sensor.filmWidth;
    camera.orthographic = 1;
    camera.origin = pack(glm::dvec3(sensor.toWorld * glm::dvec4(0, 0, sensor.nearClip, 1)));
    camera.stepX = pack(-left * step);
    camera.stepY = pack(-up * step);
    camera.corner = pack(step * (left * toCorner(sensor).x + up * toCorner(sensor).y));
    camera.forward = pack(glm::normalize(axes[2]));
}

// As wide as the film; its middle is the film's.
void placeFisheye(const Sensor& sensor, shared::Camera& camera) {
    const glm::dmat3 axes(sensor.toWorld);
    const glm::dvec3 left = glm::normalize(axes[0]), up = glm::normalize(axes[1]);
    const double step = 2.0 / sensor.filmWidth;
    camera.fisheye = sensor.fisheye;
    camera.halfAngle = static_cast<float>(sensor.fovX / 2);
    camera.origin = pack(glm::dvec3(sensor.toWorld[3]));
    camera.stepX = pack(-left * step);
    camera.stepY = pack(-up * step);
    camera.corner = pack(step * (left * toCorner(sensor).x + up * toCorner(sensor).y));
    camera.forward = pack(glm::normalize(axes[2]));
}

// One ray, whatever the place in the pixel.
void placeRay(const Sensor& sensor, shared::Camera& camera) {
    camera.origin = pack(glm::dvec3(sensor.toWorld[3]));
    camera.forward = camera.corner = pack(glm::normalize(glm::dvec3(sensor.toWorld[2])));
}

} // namespace

shared::Camera flattenCamera(const Sensor& sensor, unsigned medium) {
    shared::Camera camera{};
    if (sensor.meter == MeterKind::ray)
        placeRay(sensor, camera);
    else if (sensor.orthographic)
        placeOrthographic(sensor, camera);
    else if (sensor.fisheye != FISHEYE_NONE)
        placeFisheye(sensor, camera);
    else
        placePerspective(sensor, camera);
    camera.medium = medium;
    camera.nearClip = static_cast<float>(sensor.nearClip);
    camera.farClip = static_cast<float>(sensor.farClip);
    camera.width = sensor.width;
    camera.height = sensor.height;
    camera.filter = needsFilterTable(sensor) ? FILTER_TABLE : FILTER_BOX;
    camera.filterRadius = static_cast<float>(sensor.filterRadius);
    camera.filterReach = filterReach(sensor);
    camera.filterEnds = sensor.filterEnds ? 1 : 0;
    return camera;
}

} // namespace quasilux
