// <shape type="sphere">: centre and radius, then to_world.
#include "scene/shapes/shape_plugin.h"

#include <cmath>
#include <fmt/format.h>

namespace quasilux {

namespace {

/// The factor by which `toWorld` scales. Throws InputError where it is not the same in all directions.
double uniformScale(const glm::dmat4& toWorld, const SourceLocation& where) {
    const glm::dmat3 axes(toWorld);
    const double scale = std::cbrt(std::abs(glm::determinant(axes)));
    if (!keepsAngles(axes / scale, 1, 1e-4))
        throw InputError(where,
                         "to_world of a sphere scales directions differently; scale it uniformly, or use a mesh.");
    return scale;
}

} // namespace

void readSphere(Properties& properties, ShapeDescription& shape) {
    const glm::dmat4 toWorld = properties.transform("to_world");
    const double scale = uniformScale(toWorld, properties.where("to_world"));
    const double radius = properties.numberAbove("radius", 1, 0, true) * scale;
    Sphere sphere;
    sphere.toLocal = glm::mat3(glm::inverse(glm::dmat3(toWorld) / scale));
    sphere.center = toSingle(transformPoint(toWorld, properties.vector("center", glm::dvec3(0))), shape.where);
    sphere.radius = toSingle(glm::dvec3(radius), shape.where).x;
    if (!(sphere.radius > 0))
        throw InputError(shape.where, fmt::format("the sphere's radius {} is too small for single precision.", radius));
    shape.sphere = sphere;
    // As in Mitsuba 3, a mirrored sphere is turned inside out, though not by an instance.
    const auto& placement = properties.context().placement;
    const double instance = placement ? glm::determinant(glm::dmat3(*placement)) : 1;
    if (glm::determinant(glm::dmat3(toWorld)) * instance < 0) shape.flipNormals = !shape.flipNormals;
}

} // namespace quasilux
