// <shape type="shapegroup|instance|merge">: shapes made of shapes. Instances are flattened: each has its own triangles.
#include "scene/shapes/shape_plugin.h"

#include <fmt/format.h>

namespace quasilux {

namespace {

bool isPlugin(const Element& element, std::string_view plugin) { return element.get("type") == plugin; }

/// The shapes of a group, where context.placement puts them; `instance` is who asks.
std::vector<PlacedShape> readGroup(const Element& group, const Element& instance, LoadContext& context) {
    Properties properties(group, context);
    const std::vector<const Element*> shapes = properties.objects("shape");
    properties.finish();
    if (shapes.empty())
        throw InputError(group.where, fmt::format("shapegroup '{}' has no shape; put some into it.", idOf(group)));
    std::vector<PlacedShape> placed;
    for (const Element* element : shapes) {
        if (isPlugin(*element, "instance") || isPlugin(*element, "shapegroup") || isPlugin(*element, "merge"))
            throw InputError(element->where,
                             fmt::format("<shape type=\"{}\"> within a shapegroup; put its shapes there instead.",
                                         element->get("type")));
        if (leavesOutShape(*element, context)) continue;
        const Element* sensor = nullptr;
        ShapeDescription shape = readShape(*element, context, sensor);
        if (shape.emitter || sensor)
            throw InputError(element->where,
                             fmt::format("shape '{}' of a shapegroup has {}; as in Mitsuba, instances cannot. Put the "
                                         "shape directly into <scene>.",
                                         shape.id, sensor ? "a sensor" : "an emitter"));
        shape.id = fmt::format("{}/{}", idOf(instance), shape.id);
        placed.push_back({std::move(shape), nullptr});
    }
    return placed;
}

std::vector<PlacedShape> readInstance(const Element& element, LoadContext& context) {
    Properties properties(element, context);
    const std::vector<const Element*> groups = properties.objects("shape");
    if (groups.size() != 1 || !isPlugin(*groups[0], "shapegroup"))
        throw InputError(element.where, "an instance needs one shapegroup, such as <ref id=\"…\"/>.");
    glm::dmat4 toWorld = properties.transform("to_world");
    toWorld[3] += glm::dvec4(context.scene.origin, 0); // which is subtracted from the places of the shapes
    properties.finish();
    context.usedGroups.insert(groups[0]);
    context.placement = toWorld;
    std::vector<PlacedShape> placed = readGroup(*groups[0], element, context);
    context.placement.reset();
    return placed;
}

/// What Mitsuba joins into one mesh for speed stays apart here.
std::vector<PlacedShape> readMerge(const Element& element, LoadContext& context) {
    Properties properties(element, context);
    const std::vector<const Element*> shapes = properties.objects("shape");
    properties.finish();
    std::vector<PlacedShape> all;
    for (const Element* shape : shapes) {
        if (isPlugin(*shape, "merge"))
            throw InputError(shape->where, "a merge within a merge; put its shapes into the outer one.");
        for (PlacedShape& placed : readShapes(*shape, context)) all.push_back(std::move(placed));
    }
    return all;
}

} // namespace

std::vector<PlacedShape> readShapes(const Element& element, LoadContext& context) {
    if (isPlugin(element, "shapegroup")) return {};
    if (isPlugin(element, "instance")) return readInstance(element, context);
    if (isPlugin(element, "merge")) return readMerge(element, context);
    if (leavesOutShape(element, context)) return {};
    std::vector<PlacedShape> one(1);
    one[0].shape = readShape(element, context, one[0].sensor);
    return one;
}

void checkUnusedGroup(const Element& group, LoadContext& context) { readGroup(group, group, context); }

} // namespace quasilux
