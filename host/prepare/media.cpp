// Which medium lies where, from what the scene states and which shapes hold what.
#include "prepare/media.h"

#include "prepare/device_scene.h"
#include "prepare/media_bodies.h"
#include "prepare/media_points.h"
#include "prepare/pack.h"

namespace quasilux {

namespace {

/// Where camera rays begin: the part of the near plane that the film shows, or a point.
Box cameraOrigins(const Sensor& sensor) {
    const shared::Camera camera = flattenCamera(sensor, MEDIUM_NONE);
    const glm::dvec3 origin = unpack(camera.origin);
    Box box;
    if (camera.fisheye != FISHEYE_NONE) {
        for (const double side : {-1.0, 1.0}) box.add(origin + side * sensor.nearClip);
        return box;
    }
    const double scale = sensor.orthographic ? 1 : sensor.nearClip;
    const double lens = glm::length(unpack(camera.lensX));
    for (const double x : {0u, camera.width})
        for (const double y : {0u, camera.height})
            for (const double side : {-lens, lens})
                box.add(origin + side +
                        scale * (unpack(camera.corner) + x * unpack(camera.stepX) + y * unpack(camera.stepY)));
    return box;
}

/// Where its light leaves from; of a luminaire a box about its luminous shape, however it is turned.
Box boundsOf(const PointEmitter& emitter, const Scene& scene) {
    double radius = 0;
    if (emitter.luminaire) {
        const LuminaireType& type = scene.luminaireTypes[emitter.luminaire->type];
        const LuminousShape& shape = type.goniogram.shape;
        if (type.fromShape)
            radius = glm::length(glm::dvec3(shape.sizeC0, shape.sizeC90, shape.height)) / (2 * type.metresPerUnit);
    }
    Box box;
    for (const double side : {-1.0, 1.0}) box.add(glm::dvec3(emitter.position) + side * radius);
    return box;
}

Box boundsOf(const IlluminanceGrid& grid) {
    Box box;
    for (const double u : {0.0, 1.0})
        for (const double v : {0.0, 1.0}) box.add(grid.origin + u * grid.edgeU + v * grid.edgeV);
    return box;
}

/// Beside a surface that bounds none, on the side of its normal.
unsigned mediumOff(const ShapeDescription& shape, const MediumBodies& bodies) {
    const unsigned medium = bodies.mediumOf(boundsOff(shape));
    return medium == MEDIUM_BY_PLACE ? medium : bodies.mediumAtMost(pointsOff(shape, true));
}

unsigned sensorMedium(const Scene& scene, const MediumBodies& bodies, const MediumPlacement& placement) {
    const Sensor& sensor = scene.sensor;
    if (sensor.medium) return *sensor.medium;
    if (sensor.meter == MeterKind::grid) return placement.grids.front();
    if (sensor.meter != MeterKind::area) return bodies.mediumOf(cameraOrigins(sensor));
    const unsigned exterior = placement.exterior[sensor.meterShape];
    return exterior != MEDIUM_UNCHANGED ? exterior : mediumOff(scene.shapes[sensor.meterShape], bodies);
}

} // namespace

MediumPlacement placeMedia(const Scene& scene) {
    const MediumBodies bodies(scene);
    const auto beside = [&](const ShapeDescription& shape, bool onNormalSide) {
        return bodies.mediumAtMost(pointsOff(shape, onNormalSide));
    };
    MediumPlacement placement;
    for (const ShapeDescription& shape : scene.shapes) {
        const bool bounds = shape.interior || shape.exterior;
        const unsigned unstated = MEDIUM_UNCHANGED;
        const unsigned interior = shape.interior ? *shape.interior : bounds ? beside(shape, false) : unstated;
        const unsigned exterior = shape.exterior ? *shape.exterior : bounds ? beside(shape, true) : unstated;
        unsigned emitted = MEDIUM_NONE;
        if (shape.emitter) emitted = bounds ? exterior : mediumOff(shape, bodies);
        placement.interior.push_back(interior);
        placement.exterior.push_back(exterior);
        placement.shapeEmitters.push_back(emitted);
    }
    for (const PointEmitter& emitter : scene.pointEmitters)
        placement.pointEmitters.push_back(emitter.medium ? *emitter.medium : bodies.mediumOf(boundsOf(emitter, scene)));
    if (scene.sensor.meter == MeterKind::grid)
        for (const IlluminanceGrid& grid : scene.grids) placement.grids.push_back(bodies.mediumOf(boundsOf(grid)));
    placement.camera = sensorMedium(scene, bodies, placement);
    return placement;
}

} // namespace quasilux
