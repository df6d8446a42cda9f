// The table of shape plugins, and what is common to reading any of them.
#include "scene/plugin_lookup.h"
#include "scene/shapes/shape_plugin.h"

#include "scene/bsdfs/bsdf_plugin.h"
#include "scene/emitters/emitters.h"
#include "scene/media/medium_plugin.h"
#include "scene/shapes/shape_area.h"
#include "scene/textures/texture_use.h"

#include <fmt/format.h>

namespace quasilux {

namespace {

struct ShapePlugin {
    std::string_view name;
    void (*read)(Properties&, ShapeDescription&);
    bool hasInside = true; ///< that a medium may fill
};

constexpr ShapePlugin shapePlugins[] = {
    {"rectangle", readRectangle},
    {"cube", readCube},
    {"disk", readDisk},
    {"cylinder", readCylinder},
    {"sphere", readSphere},
    {"obj", readObj},
    {"ply", readPly},
    {"serialized", readSerialized},
    {"bsplinecurve", readBsplineCurve, false},
    {"linearcurve", readLinearCurve, false},
};

/// Of scenes that hold meshes themselves; XML knows none.
constexpr ShapePlugin embeddedMesh = {"mesh", readEmbeddedMesh};

bool isEmbeddedMesh(const Element& element, const LoadContext& context) {
    return context.embedded && element.get("type") == embeddedMesh.name;
}

/// Plugins that readShapes takes apart.
Names compoundShapes() { return {"instance", "shapegroup", "merge"}; }

/// `textured`: which of its objects needs them.
void checkTexCoords(const ShapeDescription& shape, const char* textured, LoadContext& context) {
    if (!shape.sphere && shape.mesh.cornerUvs.empty())
        throw InputError(shape.where,
                         fmt::format("shape '{}' has no texture coordinates, but its {} has a texture; add them to the "
                                     "mesh file, or use {} {} without textures.",
                                     shape.id, textured, textured[0] == 'e' ? "an" : "a", textured));
    if (shape.mesh.cornersWithoutUv > 0)
        context.warn(shape.where,
                     fmt::format("shape '{}' has no texture coordinates at {} of its {} corners, but its {} has a "
                                 "texture; they are taken as (0, 0). Add them to the mesh file.",
                                 shape.id, shape.mesh.cornersWithoutUv, shape.mesh.cornerUvs.size(), textured));
}

/// For an emitter along its normals.
void checkFlat(const ShapeDescription& shape) {
    if (shape.sphere || !shape.mesh.cornerNormals.empty())
        throw InputError(shape.emitter->where,
                         fmt::format("emitter 'directionalarea' emits along the normals of flat faces, but shape '{}' "
                                     "is curved; use a rectangle or disk, or a mesh with <boolean "
                                     "name=\"face_normals\" value=\"true\"/>.",
                                     shape.id));
}

void checkArea(const ShapeDescription& shape, bool hasSensor, LoadContext& context) {
    if ((!shape.emitter && !hasSensor) || context.withoutArea || static_cast<float>(areaOf(shape)) > 0) return;
    context.withoutArea.emplace(shape.where,
                                fmt::format("shape '{}' {}.", shape.id,
                                            shape.emitter ? "emits but has no area; enlarge it or remove its emitter"
                                                          : "has a sensor but no area; enlarge it"));
}

} // namespace

Names shapePluginNames() { return namesOf(shapePlugins, compoundShapes()); }

bool leavesOutShape(const Element& element, LoadContext& context) {
    return !isEmbeddedMesh(element, context) &&
           !findPlugin(shapePlugins, element, context, "left out", compoundShapes());
}

ShapeDescription readShape(const Element& element, LoadContext& context, const Element*& sensor) {
    const ShapePlugin& plugin =
        isEmbeddedMesh(element, context) ? embeddedMesh : findPlugin(shapePlugins, element, compoundShapes());
    Properties properties(element, context);
    ShapeDescription shape;
    shape.id = idOf(element);
    shape.plugin = plugin.name;
    shape.where = element.where;
    shape.flipNormals = properties.boolean("flip_normals", false);
    plugin.read(properties, shape);
    properties.accept({"silhouette_sampling_weight"}); // for derivatives
    const Element* bsdf = properties.object("bsdf");
    const Element* emitter = properties.object("emitter");
    if (emitter && leavesOutEmitter(*emitter, context)) emitter = nullptr;
    sensor = properties.object("sensor");
    const Element* interior = properties.medium("interior");
    const Element* exterior = properties.medium("exterior");
    properties.finish();
    if (!plugin.hasInside && (interior || exterior))
        throw InputError((interior ? interior : exterior)->where,
                         fmt::format("{} bounds no medium; use another shape.", properties.describe()));
    if (interior) shape.interior = useMedium(*interior, context);
    if (exterior) shape.exterior = useMedium(*exterior, context);
    if (interior && !bsdf)
        context.warn(element.where,
                     fmt::format("no light enters the medium in shape '{}', since a shape without a bsdf "
                                 "is opaque; add <bsdf type=\"null\"/>.",
                                 shape.id));
    shape.bsdf = bsdf ? useBsdf(*bsdf, context) : useDefaultBsdf(element, emitter != nullptr, context);
    if (needsTexCoords(context.scene, context.scene.bsdfs[static_cast<size_t>(shape.bsdf)]))
        checkTexCoords(shape, "bsdf", context);
    if (emitter) shape.emitter = readShapeEmitter(*emitter, context);
    shape.emitterIsOff = emitter && !shape.emitter;
    keepShownAttributes(shape, context);
    if (shape.emitter) {
        if (shape.emitter->texture && needTexCoords(context.scene, {*shape.emitter->texture}))
            checkTexCoords(shape, "emitter", context);
        if (shape.emitter->alongNormal) checkFlat(shape);
    }
    checkArea(shape, sensor != nullptr, context);
    return shape;
}

} // namespace quasilux
