// Shapes into primitives, their records and corner normals.
#include "prepare/border_surface.h"
#include "prepare/device_scene.h"
#include "prepare/pack.h"
#include "scene/shapes/shape_area.h"
#include "scene/transform.h"

#include <cmath>

namespace quasilux {

namespace {

bool isNull(const Scene& scene, const ShapeDescription& shape) {
    return shape.bsdf >= 0 && scene.bsdfs[static_cast<size_t>(shape.bsdf)].isNull;
}

} // namespace

bool passesLight(const Scene& scene, const ShapeDescription& shape) {
    const bool counts = scene.countsPassages && scene.maxDepth >= 0;
    return isNull(scene, shape) && !shape.interior && !shape.exterior && !counts;
}

bool hidesEmitters(const Scene& scene) { return scene.hideEmitters && !isIrradiance(scene.sensor.meter); }

std::vector<BvhPrimitive> flattenPrimitives(const Scene& scene, std::span<const ShapeDescription> shapes) {
    std::vector<BvhPrimitive> primitives;
    for (const auto& shape : shapes) {
        const bool null = passesLight(scene, shape);
        if (shape.sphere) primitives.push_back({shape.sphere->center, {shape.sphere->radius, 0, 0}, {}, true, null});
        const auto& p = shape.mesh.positions;
        for (const auto& t : shape.mesh.triangles) primitives.push_back({p[t.x], p[t.y], p[t.z], false, null});
    }
    return primitives;
}

std::vector<shared::PrimitiveInfo> flattenPrimitiveInfo(const Scene& scene, const SurfaceBorders& borders) {
    std::vector<shared::PrimitiveInfo> records;
    std::vector<unsigned> patches = borders.patchOfPrimitive;
    for (const SurfaceBorders& group : borders.groups)
        patches.insert(patches.end(), group.patchOfPrimitive.begin(), group.patchOfPrimitive.end());
    records.reserve(patches.size());
    for (unsigned shape = 0; shape < scene.shapes.size(); ++shape)
        for (unsigned k = 0; k < primitiveCount(scene.shapes[shape]); ++k)
            records.push_back({shape, patches[records.size()]});
    return records;
}

std::vector<shared::Shape> flattenShapes(const Scene& scene, const std::vector<unsigned>& emitterOfShape,
                                         const MediumPlacement& placement) {
    std::vector<shared::Shape> records;
    unsigned primitive = 0, normal = 0, uv = 0;
    for (size_t k = 0; k < scene.shapes.size(); ++k) {
        const auto& shape = scene.shapes[k];
        shared::Shape record{};
        record.material = static_cast<unsigned>(shape.bsdf);
        record.emitter = shape.emitterIsOff && hidesEmitters(scene) ? EMITTER_OFF : emitterOfShape[k];
        record.firstPrimitive = primitive;
        record.firstNormal = shape.mesh.cornerNormals.empty() ? QL_NONE : normal;
        record.normalSign = shape.flipNormals ? -1.f : 1.f;
        record.firstUv = uvWords(scene, shape) == 0 ? QL_NONE : uv;
        record.interior = placement.interior[k];
        record.exterior = placement.exterior[k];
        records.push_back(record);
        uv += uvWords(scene, shape);
        primitive += primitiveCount(shape);
        normal += static_cast<unsigned>(shape.mesh.cornerNormals.size());
    }
    return records;
}

std::vector<shared::Packed3> flattenCornerNormals(const Scene& scene) {
    std::vector<shared::Packed3> normals;
    for (const auto& shape : scene.shapes)
        for (const auto& normal : shape.mesh.cornerNormals) normals.push_back(pack(normal));
    return normals;
}

double scatteringArea(const Scene& scene) {
    const auto areaOfAll = [&](std::span<const ShapeDescription> shapes, const glm::dmat3* toWorld) {
        double area = 0;
        for (const auto& shape : shapes)
            if (!isNull(scene, shape)) area += toWorld ? areaOf(shape, *toWorld) : areaOf(shape);
        return area;
    };
    std::vector<double> ofGroups;
    for (const ShapeGroup& group : scene.groups) ofGroups.push_back(areaOfAll(scene.shapesOf(group), nullptr));
    double area = areaOfAll(scene.worldShapes(), nullptr);
    for (const Instance& instance : scene.instances) {
        const glm::dmat3 axes(glm::mat3(instance.toWorld[0], instance.toWorld[1], instance.toWorld[2]));
        const double scale = std::cbrt(std::abs(glm::determinant(axes)));
        area += keepsAngles(axes / scale, 1, 1e-4) ? scale * scale * ofGroups[instance.group]
                                                   : areaOfAll(scene.shapesOf(scene.groups[instance.group]), &axes);
    }
    return area;
}

} // namespace quasilux
