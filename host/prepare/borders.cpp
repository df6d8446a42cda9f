// Finds patches and borders: weld, join, cut, measure.
#include "prepare/borders.h"

#include "prepare/border_intersections.h"
#include "prepare/border_patches.h"
#include "prepare/instance_cuts.h"

#include <fmt/format.h>

namespace quasilux {

namespace {

Surface findBordersOf(const Scene& scene, std::span<const ShapeDescription> shapes, double creaseAngle,
                      SurfaceBorders& borders) {
    Surface surface = collectSurface(scene, shapes);
    joinPatches(scene, shapes, creaseAngle, surface, borders);
    intersectSurfaces(surface, borders);
    return surface;
}

} // namespace

SurfaceBorders findBorders(const Scene& scene, double creaseAngle) {
    SurfaceBorders borders;
    const Surface world = findBordersOf(scene, scene.worldShapes(), creaseAngle, borders);
    std::vector<Surface> groups;
    for (const ShapeGroup& group : scene.groups)
        groups.push_back(findBordersOf(scene, scene.shapesOf(group), creaseAngle, borders.groups.emplace_back()));
    if (!scene.instances.empty()) cutInstances(scene, world, groups, borders);
    return borders;
}

std::vector<unsigned> firstPatches(const Scene& scene, const SurfaceBorders& borders) {
    constexpr uint64_t mostPatches = uint64_t(1) << 31; // a bit is left for the side
    std::vector<unsigned> first;
    first.reserve(scene.instances.size());
    uint64_t patches = borders.patchCount;
    for (const Instance& instance : scene.instances) {
        first.push_back(static_cast<unsigned>(patches));
        patches += borders.groups[instance.group].patchCount;
        if (patches >= mostPatches)
            throw InputError({scene.path}, fmt::format("instances have more than {} faces and smooth parts of surfaces "
                                                       "together; place fewer, or simpler meshes.",
                                                       mostPatches));
    }
    return first;
}

} // namespace quasilux
