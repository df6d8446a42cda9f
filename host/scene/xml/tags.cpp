// The tags of the scene language.
#include "scene/xml/tags.h"

#include <algorithm>
#include <fmt/format.h>

namespace quasilux {

namespace {

const std::vector<Tag> tags = {
    {"scene", TagKind::scene, {"version"}, {"type", "id", "name"}},
    {"default", TagKind::directive, {"name", "value"}, {}},
    {"include", TagKind::directive, {"filename"}, {"name"}},
    {"path", TagKind::directive, {"value"}, {}},
    {"alias", TagKind::directive, {"id", "as"}, {}},
    {"ref", TagKind::reference, {"id"}, {"name"}},
    {"integrator", TagKind::object, {"type"}, {"id", "name", "version"}},
    {"sensor", TagKind::object, {"type"}, {"id", "name", "version"}},
    {"film", TagKind::object, {"type"}, {"id", "name", "version"}},
    {"rfilter", TagKind::object, {"type"}, {"id", "name", "version"}},
    {"sampler", TagKind::object, {"type"}, {"id", "name", "version"}},
    {"shape", TagKind::object, {"type"}, {"id", "name", "version"}},
    {"bsdf", TagKind::object, {"type"}, {"id", "name", "version"}},
    {"emitter", TagKind::object, {"type"}, {"id", "name", "version"}},
    {"texture", TagKind::object, {"type"}, {"id", "name", "version"}},
    {"medium", TagKind::object, {"type"}, {"id", "name", "version"}},
    {"phase", TagKind::object, {"type"}, {"id", "name", "version"}},
    {"volume", TagKind::object, {"type"}, {"id", "name", "version"}},
    {"float", TagKind::parameter, {"name", "value"}, {}},
    {"integer", TagKind::parameter, {"name", "value"}, {}},
    {"boolean", TagKind::parameter, {"name", "value"}, {}},
    {"string", TagKind::parameter, {"name", "value"}, {}},
    {"rgb", TagKind::parameter, {"name", "value"}, {}},
    {"spectrum", TagKind::parameter, {"name"}, {"value", "filename"}},
    {"point", TagKind::parameter, {"name"}, {"x", "y", "z", "value"}},
    {"vector", TagKind::parameter, {"name"}, {"x", "y", "z", "value"}},
    {"transform", TagKind::transform, {"name"}, {}},
    {"translate", TagKind::operation, {}, {"x", "y", "z", "value"}},
    {"rotate", TagKind::operation, {"angle"}, {"x", "y", "z", "value"}},
    {"scale", TagKind::operation, {}, {"x", "y", "z", "value"}},
    {"matrix", TagKind::operation, {"value"}, {}},
    {"lookat", TagKind::operation, {"origin", "target"}, {"up"}},
};

/// Part of Mitsuba 3 or a version before but not of quasilux, with what to do instead.
const std::vector<std::pair<std::string_view, std::string_view>> unsupportedTags = {
    {"animation", "is not supported yet; use one <transform>"},
    {"luminaire", "is of Mitsuba 0.x; use <emitter>"},
    {"camera", "is of Mitsuba 0.x; use <sensor>"},
    {"subsurface", "is of Mitsuba 0.x; use a <medium> as the shape's interior"},
    {"blackbody", "is of Mitsuba 0.x; use <texture type=\"blackbody\"> with a float 'temperature'"},
};

Names namesOf(const std::vector<Tag>& list) {
    Names names;
    for (const Tag& tag : list) names.push_back(tag.name);
    return names;
}

void checkAttributes(const Element& element, const Tag& tag) {
    Names known = tag.required;
    known.insert(known.end(), tag.optional.begin(), tag.optional.end());
    for (size_t i = 0; i < element.attributes.size(); ++i) {
        const std::string& name = element.attributes[i].name;
        if (std::find(known.begin(), known.end(), name) == known.end())
            throw InputError(element.where,
                             fmt::format("<{}> has no attribute '{}'.{}", element.tag, name, knownNames(name, known)));
        for (size_t j = 0; j < i; ++j)
            if (element.attributes[j].name == name)
                throw InputError(element.where,
                                 fmt::format("<{}> has the attribute '{}' twice; keep one.", element.tag, name));
    }
    for (std::string_view name : tag.required)
        if (!element.find(name))
            throw InputError(element.where, fmt::format("<{}> needs the attribute '{}'.", element.tag, name));
}

void checkPlace(const Element& element, const Tag& tag, const Element& parent) {
    const TagKind outer = tagOf(parent).kind;
    const auto refuse = [&](std::string_view advice) {
        throw InputError(element.where,
                         fmt::format("<{}> may not stand in <{}>; {}.", element.tag, parent.tag, advice));
    };
    if (tag.kind == TagKind::scene) refuse("a file has one <scene>, its outermost element");
    if (tag.kind == TagKind::operation && outer != TagKind::transform) refuse("put it into a <transform>");
    if (outer == TagKind::transform && tag.kind != TagKind::operation)
        refuse("a transform holds translate, rotate, scale, matrix, lookat");
    if (outer != TagKind::scene && outer != TagKind::object && outer != TagKind::transform)
        refuse("close that element first");
    if (outer == TagKind::scene && (tag.kind == TagKind::parameter || tag.kind == TagKind::transform))
        refuse("parameters belong in an object such as <shape> or <bsdf>");
    if ((element.tag == "path" || element.tag == "alias") && outer != TagKind::scene) refuse("put it into <scene>");
}

} // namespace

const Tag& tagOf(const Element& element) {
    for (const Tag& tag : tags)
        if (tag.name == element.tag) return tag;
    for (const auto& [name, advice] : unsupportedTags)
        if (name == element.tag) throw InputError(element.where, fmt::format("<{}> {}.", name, advice));
    throw InputError(element.where,
                     fmt::format("unknown element <{}>.{}", element.tag, knownNames(element.tag, namesOf(tags))));
}

bool isKnownTag(std::string_view name) {
    return name == "lookAt" || std::any_of(tags.begin(), tags.end(), [&](const Tag& tag) { return tag.name == name; });
}

void throwNesting(const Element& element) {
    throw InputError(element.where, fmt::format("elements nested deeper than {}.", maximumNesting));
}

void checkElement(const Element& element, const Element* parent) {
    const Tag& tag = tagOf(element);
    checkAttributes(element, tag);
    if (parent) checkPlace(element, tag, *parent);
}

namespace {

void checkChildren(const Element& parent, int depth) {
    for (const Element& child : parent.children) {
        if (depth > maximumNesting) throwNesting(child);
        checkElement(child, &parent);
        checkChildren(child, depth + 1);
    }
}

} // namespace

void checkTree(const Element& root) {
    checkElement(root, nullptr);
    checkChildren(root, 1);
}

} // namespace quasilux
