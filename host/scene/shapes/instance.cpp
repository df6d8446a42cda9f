// <shape type="shapegroup|instance|merge">: shapes made of shapes. Instances have triangles of their own, or those of
// their group (instance_levels.cpp).
#include "scene/shapes/instance_levels.h"
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

/// The shapegroup of an instance, or nullptr.
const Element* groupOf(const Element& instance, const LoadContext& context) {
    const Element* group = nullptr;
    for (const Element& child : instance.children) {
        if (child.tag != "shape" && child.tag != "ref") continue;
        const Element& object = context.resolve(child);
        if (object.tag != "shape") continue;
        if (group || !isPlugin(object, "shapegroup")) return nullptr;
        group = &object;
    }
    return group;
}

/// Where an instance puts the group, in coordinates of the file.
glm::dmat4 placeOf(const Element& element, LoadContext& context) {
    Properties properties(element, context);
    if (properties.objects("shape").size() != 1 || !groupOf(element, context))
        throw InputError(element.where, "an instance needs one shapegroup, such as <ref id=\"…\"/>.");
    glm::dmat4 toWorld = properties.transform("to_world");
    toWorld[3] += glm::dvec4(context.scene.origin, 0); // which is subtracted from the places of the shapes
    properties.finish();
    return toWorld;
}

/// An instance of the group at `toWorld`, in coordinates of the file.
std::vector<PlacedShape> placeGroup(const Element& group, const glm::dmat4& toWorld, const Element& instance,
                                    LoadContext& context) {
    context.usedGroups.insert(&group);
    if (keepAsInstance(group, toWorld, context)) return {};
    context.placement = toWorld;
    std::vector<PlacedShape> placed = readGroup(group, instance, context);
    context.placement.reset();
    return placed;
}

std::vector<PlacedShape> readInstance(const Element& element, LoadContext& context) {
    const glm::dmat4 toWorld = placeOf(element, context);
    return placeGroup(*groupOf(element, context), toWorld, element, context);
}

void countPlace(const Element& group, LoadContext& context) {
    if (++context.groupUse.try_emplace(&group).first->second.places == 1) context.placedGroups.push_back(&group);
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

std::vector<ShapeDescription> readPlainInstance(const PlainInstances::One& instance, LoadContext& context) {
    const Element element{"shape", {{"type", "instance"}}, {}, {}, {context.scene.path, instance.line, 0}};
    std::vector<ShapeDescription> shapes;
    for (PlacedShape& placed :
         placeGroup(*context.plainGroups[instance.group], glm::dmat4(instance.toWorld), element, context))
        shapes.push_back(std::move(placed.shape));
    return shapes;
}

std::vector<PlacedShape> readShapes(const Element& element, LoadContext& context) {
    if (isPlugin(element, "shapegroup")) return {};
    if (isPlugin(element, "instance")) return readInstance(element, context);
    if (isPlugin(element, "merge")) return readMerge(element, context);
    if (leavesOutShape(element, context)) return {};
    std::vector<PlacedShape> one(1);
    one[0].shape = readShape(element, context, one[0].sensor);
    return one;
}

std::vector<ShapeDescription> readGroupAt(const Element& group, const glm::dmat4& place, LoadContext& context) {
    context.placement = place;
    std::vector<ShapeDescription> shapes;
    for (PlacedShape& placed : readGroup(group, group, context)) shapes.push_back(std::move(placed.shape));
    context.placement.reset();
    return shapes;
}

void countPlaces(const Element& parent, LoadContext& context) {
    for (const Element& child : parent.children) {
        const Element& element = context.resolve(child);
        if (element.tag != "shape") continue;
        if (isPlugin(element, "merge") && &parent != &element && !isPlugin(parent, "merge"))
            countPlaces(element, context);
        else if (const Element* group = isPlugin(element, "instance") ? groupOf(element, context) : nullptr)
            countPlace(*group, context);
    }
    if (!parent.instances) return;
    for (const std::string& id : parent.instances->groupIds)
        context.plainGroups.push_back(&context.resolve({"ref", {{"id", id}}, {}, {}, parent.where}));
    for (const PlainInstances::One& one : parent.instances->all) countPlace(*context.plainGroups[one.group], context);
}

void checkUnusedGroup(const Element& group, LoadContext& context) { readGroup(group, group, context); }

} // namespace quasilux
