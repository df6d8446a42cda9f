// Typed queries of a plugin's parameters.
#include "scene/properties.h"

#include "scene/textures/constant_texture.h"
#include "scene/transform.h"
#include "scene/xml/numbers.h"
#include "scene/xml/tags.h"

#include <algorithm>
#include <fmt/format.h>
#include <limits>

namespace quasilux {

Properties::Properties(const Element& element, LoadContext& context) : element_(element), context_(context) {
    context.files.guard().note(element.where);
    for (const Element& child : element.children) {
        const TagKind kind = tagOf(child).kind;
        if (kind == TagKind::object || kind == TagKind::reference) {
            objects_.push_back(&child);
            continue;
        }
        const auto [before, isNew] = parameters_.emplace(child.get("name"), &child);
        if (!isNew)
            throw InputError(child.where, fmt::format("parameter '{}' is given twice (first at {}); keep one.",
                                                      child.get("name"), before->second->where.text()));
    }
}

std::string Properties::describe() const { return fmt::format("{} '{}'", element_.tag, plugin()); }

SourceLocation Properties::where(const std::string& name) const {
    const auto found = parameters_.find(name);
    if (found != parameters_.end()) return found->second->where;
    for (const Element* object : objects_)
        if (!name.empty() && object->get("name") == name) return object->where;
    return element_.where;
}

bool Properties::has(const std::string& name) { return find(name) || constantTexture(name); }

const Element* Properties::find(const std::string& name) {
    knownNames_.insert(name);
    const auto found = parameters_.find(name);
    return found == parameters_.end() ? nullptr : found->second;
}

const Element* Properties::find(const std::string& name, const Names& tags) {
    const Element* parameter = find(name);
    if (parameter && std::find(tags.begin(), tags.end(), parameter->tag) == tags.end())
        throw InputError(parameter->where, fmt::format("parameter '{}' of {} is a <{}>; expected <{}>.", name,
                                                       describe(), parameter->tag, fmt::join(tags, "> or <")));
    return parameter;
}

double Properties::number(const std::string& name, double missing) {
    if (const Element* constant = constantTexture(name)) {
        const Rgb color = readConstantTexture(*constant, ColorUse::unbounded, context_);
        if (constant->get("type") == "rawconstant" && smallest(color) != largest(color))
            throw InputError(constant->where, fmt::format("parameter '{}' of {} is a number; expected <float "
                                                          "name=\"value\"> in the rawconstant, not a vector.",
                                                          name, describe()));
        return luminance(color);
    }
    const Element* parameter = find(name, {"float", "integer"});
    if (!parameter) return missing;
    return parseNumber(parameter->get("value"), parameter->where, fmt::format("parameter '{}'", name));
}

double Properties::textureNumber(const std::string& name, double missing) {
    const Element* parameter = find(name);
    if (!parameter || (parameter->tag != "rgb" && parameter->tag != "spectrum")) return number(name, missing);
    const Rgb color = parseColor(*parameter, ColorUse::unbounded, context_);
    return (double(color.r) + double(color.g) + double(color.b)) / 3;
}

double Properties::numberAbove(const std::string& name, double missing, double lowest, bool open) {
    const double value = number(name, missing);
    if (value > lowest || (!open && value == lowest)) return value;
    const std::string message = fmt::format("parameter '{}' of {} is {}; it must be {} {}.", name, describe(), value,
                                            open ? "greater than" : "at least", lowest);
    if (open) throw InputError(where(name), message); // no value is the nearest
    context_.refuseUnknown(where(name), message, fmt::format("taken as {}", lowest));
    return lowest;
}

double Properties::share(const std::string& name, double missing) {
    const double value = textureNumber(name, missing);
    if (value >= 0 && value <= 1) return value;
    const double taken = std::clamp(value, 0.0, 1.0);
    context_.refuseUnknown(
        where(name), fmt::format("parameter '{}' of {} is {}; it must lie within [0, 1].", name, describe(), value),
        fmt::format("taken as {}", taken));
    return taken;
}

double Properties::nearest(const std::string& name, double value, double lowest, double highest) {
    if (value >= lowest && value <= highest) return value;
    const double taken = std::clamp(value, lowest, highest);
    context_.refuseUnknown(where(name),
                           fmt::format("parameter '{}' is {}; expected {} to {}.", name, value, lowest, highest),
                           fmt::format("taken as {}", taken));
    return taken;
}

double Properties::numberWithin(const std::string& name, double missing, double lowest, double highest) {
    return nearest(name, number(name, missing), lowest, highest);
}

int64_t Properties::integer(const std::string& name, int64_t missing) {
    const Element* parameter = find(name, {"integer"});
    if (!parameter) return missing;
    return parseInteger(parameter->get("value"), parameter->where, fmt::format("parameter '{}'", name));
}

int Properties::integerWithin(const std::string& name, int missing, int lowest, int highest) {
    return static_cast<int>(nearest(name, static_cast<double>(integer(name, missing)), lowest, highest));
}

bool Properties::boolean(const std::string& name, bool missing) {
    const Element* parameter = find(name, {"boolean"});
    if (!parameter) return missing;
    const std::string& text = parameter->get("value");
    if (text == "true" || text == "True" || text == "TRUE") return true;
    if (text == "false" || text == "False" || text == "FALSE") return false;
    throw InputError(parameter->where,
                     fmt::format("parameter '{}': '{}' is not a boolean; expected true or false.", name, text));
}

std::string Properties::string(const std::string& name, const std::string& missing) {
    const Element* parameter = find(name, {"string"});
    return parameter ? parameter->get("value") : missing;
}

std::string Properties::choice(const std::string& name, const std::string& missing, const Names& known) {
    return among(known, name, string(name, missing), missing);
}

std::string Properties::choiceOfAnyCase(const std::string& name, const std::string& missing, const Names& known) {
    return among(known, name, lowerCase(string(name, missing)), missing);
}

std::string Properties::among(const Names& known, const std::string& name, const std::string& value,
                              const std::string& missing) {
    if (std::find(known.begin(), known.end(), value) != known.end()) return value;
    context_.refuseUnknown(where(name),
                           fmt::format("parameter '{}' of {}: unknown value '{}'.{}", name, describe(), value,
                                       quasilux::knownNames(value, known)),
                           fmt::format("taken as '{}'", missing));
    return missing;
}

glm::dvec3 Properties::vector(const std::string& name, const glm::dvec3& missing) {
    const Element* parameter = find(name, {"point", "vector"});
    if (!parameter) return missing;
    if (!parameter->find("value") && !(parameter->find("x") && parameter->find("y") && parameter->find("z")))
        throw InputError(parameter->where, fmt::format("parameter '{}': give x, y and z, or value=\"a,b,c\".", name));
    return parseVector(*parameter, 0);
}

glm::dvec3 Properties::direction(const std::string& name, const glm::dvec3& missing) {
    const glm::dvec3 direction = vector(name, missing);
    if (!(glm::length(direction) > 0))
        throw InputError(where(name), fmt::format("parameter '{}' is 0,0,0; it must have a length.", name));
    return glm::normalize(direction);
}

glm::dmat4 Properties::transform(const std::string& name) {
    const glm::dmat4 own = ownTransform(name);
    return name == "to_world" ? placement() * own : own;
}

glm::dmat4 Properties::ownTransform(const std::string& name) {
    const Element* parameter = find(name, {"transform"});
    return parameter ? parseTransform(*parameter) : glm::dmat4(1.0);
}

glm::dmat4 Properties::placement() const {
    glm::dmat4 matrix = context_.placement.value_or(glm::dmat4(1.0));
    matrix[3] -= glm::dvec4(context_.scene.origin, 0);
    return matrix;
}

std::optional<Rgb> Properties::color(const std::string& name, ColorUse use) {
    if (const Element* constant = constantTexture(name)) return readConstantTexture(*constant, use, context_);
    if (const Element* parameter = find(name)) return parseColor(*parameter, use, context_);
    return std::nullopt;
}

Rgb Properties::reflectance(const std::string& name, float missing) {
    const Rgb color = positiveColor(name, {missing, missing, missing}, ColorUse::reflectance);
    return withinRange(name, color, 1, "every channel must lie within [0, 1]");
}

Rgb Properties::withinRange(const std::string& name, Rgb color, float highest, const std::string& message) {
    if (smallest(color) >= 0 && largest(color) <= highest) return color;
    const auto taken = [&](float channel) { return std::clamp(channel, 0.0f, highest); };
    const Rgb nearestColor = {taken(color.r), taken(color.g), taken(color.b)};
    context_.refuseUnknown(
        where(name),
        fmt::format("parameter '{}' of {} is ({}, {}, {}); {}.", name, describe(), color.r, color.g, color.b, message),
        fmt::format("taken as ({}, {}, {})", nearestColor.r, nearestColor.g, nearestColor.b));
    return nearestColor;
}

Rgb Properties::positiveColor(const std::string& name, Rgb missing, ColorUse use) {
    return withinRange(name, color(name, use).value_or(missing), std::numeric_limits<float>::infinity(),
                       "no channel may be negative");
}

Rgb Properties::unboundedColor(const std::string& name, Rgb missing) {
    return color(name, ColorUse::unbounded).value_or(missing);
}

Rgb Properties::emission(const std::string& name, Rgb missing) {
    return positiveColor(name, missing, ColorUse::emission);
}

std::vector<const Element*> Properties::objects(const std::string& tag) {
    knownTags_.insert(tag);
    std::vector<const Element*> found;
    for (const Element* object : objects_) {
        const Element& target = context_.resolve(*object);
        if (target.tag == tag) found.push_back(&target);
    }
    return found;
}

const Element* Properties::object(const std::string& tag) {
    const std::vector<const Element*> found = objects(tag);
    if (found.size() > 1)
        throw InputError(found[1]->where,
                         fmt::format("{} has {} objects <{}>; expected one.", describe(), found.size(), tag));
    return found.empty() ? nullptr : found[0];
}

const Element* Properties::named(const std::string& tag, const std::string& name) {
    knownNamed_[tag].insert(name);
    const Element* found = nullptr;
    for (const Element* object : objects_) {
        const Element& target = context_.resolve(*object);
        if (target.tag != tag || object->get("name") != name) continue;
        const Element* before = found ? found : find(name);
        if (before)
            throw InputError(object->where, fmt::format("parameter '{}' is given twice (first at {}); keep one.", name,
                                                        before->where.text()));
        found = &target;
    }
    return found;
}

const Element* Properties::texture(const std::string& name) {
    return constantTexture(name) ? nullptr : named("texture", name);
}

const Element* Properties::constantTexture(const std::string& name) {
    for (const Element* object : objects_) {
        const Element& target = context_.resolve(*object);
        if (target.tag == "texture" && object->get("name") == name && isConstantTexture(target))
            return named("texture", name);
    }
    return nullptr;
}

void Properties::accept(const Names& names) {
    for (const std::string_view name : names)
        if (find(std::string(name))) context_.scene.withoutEffect.emplace_back(name);
}

void Properties::refuse(const std::string& name, const std::string& why) {
    if (find(name))
        context_.refuseUnknown(
            where(name), fmt::format("parameter '{}' of {} is not supported: {}.", name, describe(), why), "ignored");
}

void Properties::acceptAll() {
    for (const auto& entry : parameters_) accept({std::string_view(entry.first)});
    for (const Element* object : objects_) knownTags_.insert(context_.resolve(*object).tag);
}

void Properties::checkObject(const Element& object) const {
    const std::string& tag = context_.resolve(object).tag;
    if (knownTags_.count(tag)) return;
    const std::string& name = object.get("name");
    const auto byName = knownNamed_.find(tag);
    if (byName != knownNamed_.end() && byName->second.count(name)) return;
    const std::string given = name.empty() ? "without a name" : "as '" + name + "'";
    Names names;
    if (byName != knownNamed_.end()) names.assign(byName->second.begin(), byName->second.end());
    Names tags(knownTags_.begin(), knownTags_.end());
    for (const auto& entry : knownNamed_) tags.push_back(entry.first);
    std::string message = fmt::format("{} takes no <{}>. Objects that it takes: {}.", describe(), tag,
                                      tags.empty() ? "none" : joinNames(tags));
    if (tag == "texture")
        message = fmt::format("{} takes no texture {}. Parameters of it that may be textures: {}.", describe(), given,
                              names.empty() ? "none" : joinNames(names));
    else if (!names.empty())
        message =
            fmt::format("{} takes no {} {}; name it.{}", describe(), tag, given, quasilux::knownNames(name, names));
    context_.refuseUnknown(object.where, message, "ignored");
}

void Properties::finish() const {
    for (const Element& child : element_.children) {
        const TagKind kind = tagOf(child).kind;
        if (kind == TagKind::object || kind == TagKind::reference) {
            checkObject(child);
            continue;
        }
        const std::string& name = child.get("name");
        if (knownNames_.count(name)) continue;
        const Names known(knownNames_.begin(), knownNames_.end());
        context_.refuseUnknown(
            child.where,
            fmt::format("unknown parameter '{}' of {}.{}", name, describe(), quasilux::knownNames(name, known)),
            "ignored");
    }
}

} // namespace quasilux
