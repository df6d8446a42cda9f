// Which medium lies where, from what the scene states and which shapes hold what.
#include "prepare/media.h"

#include "prepare/media_bodies.h"
#include "prepare/media_points.h"

namespace quasilux {

namespace {

/// Where camera rays start: the centre of projection, or of the near plane.
glm::dvec3 cameraOrigin(const Sensor& sensor) {
    const glm::dvec4 local(0, 0, sensor.orthographic ? sensor.nearClip : 0, 1);
    return glm::dvec3(sensor.toWorld * local);
}

unsigned sensorMedium(const Scene& scene, const MediumBodies& bodies, const MediumPlacement& placement) {
    const Sensor& sensor = scene.sensor;
    if (sensor.medium) return *sensor.medium;
    if (sensor.meter == MeterKind::grid) return placement.grids.front();
    if (sensor.meter != MeterKind::area) return bodies.mediumAt(cameraOrigin(sensor));
    const unsigned exterior = placement.exterior[sensor.meterShape];
    return exterior != MEDIUM_UNCHANGED ? exterior
                                        : bodies.mediumAtMost(pointsOff(scene.shapes[sensor.meterShape], true));
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
        if (shape.emitter) emitted = bounds ? exterior : beside(shape, true);
        placement.interior.push_back(interior);
        placement.exterior.push_back(exterior);
        placement.shapeEmitters.push_back(emitted);
    }
    for (const PointEmitter& emitter : scene.pointEmitters)
        placement.pointEmitters.push_back(emitter.medium ? *emitter.medium
                                                         : bodies.mediumAt(glm::dvec3(emitter.position)));
    if (scene.sensor.meter == MeterKind::grid)
        for (const IlluminanceGrid& grid : scene.grids)
            placement.grids.push_back(bodies.mediumAt(grid.origin + 0.5 * (grid.edgeU + grid.edgeV)));
    placement.camera = sensorMedium(scene, bodies, placement);
    return placement;
}

} // namespace quasilux
