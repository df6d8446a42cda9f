#include "scene/gltf/scene_extras.h"

#include "scene/gltf/elements.h"

#include <cmath>

namespace quasilux {

namespace {

constexpr const char *skyKey = "sky", *sunKey = "sun_direction";

double finiteNumber(const tinygltf::Value& value, const std::string& name, const SourceLocation& where) {
    const double number = value.IsNumber() ? value.GetNumberAsDouble() : NAN;
    if (!std::isfinite(number))
        throw InputError(where, fmt::format("'{}' is no finite number, text or array of numbers.", name));
    return number;
}

std::string numberText(const tinygltf::Value& value, const std::string& name, const SourceLocation& where) {
    return fmt::format("{}", finiteNumber(value, name, where));
}

std::string textOf(const tinygltf::Value& value, const std::string& name, const SourceLocation& where) {
    if (value.IsString()) return value.Get<std::string>();
    if (!value.IsArray()) return numberText(value, name, where);
    std::string text;
    for (size_t k = 0; k < value.ArrayLen(); ++k)
        text += (k > 0 ? "," : "") + numberText(value.Get(static_cast<int>(k)), name, where);
    return text;
}

/// Of the element that a parameter of an emitter is in a scene file.
const char* tagOf(const tinygltf::Value& value, const std::string& name) {
    if (value.IsString()) return "string";
    if (value.IsBool()) return "boolean";
    if (value.IsInt()) return "integer";
    if (!value.IsArray()) return "float";
    return name == sunKey ? "vector" : "rgb";
}

/// Of a sky whose own axes point east, north and up: in the file up is +y, the north -z.
glm::dmat4 axesOfMap() { return {1, 0, 0, 0, 0, 0, -1, 0, 0, 1, 0, 0, 0, 0, 0, 1}; }

/// Of Mitsuba's, whose axes point south, west and up, which is a mirror.
glm::dmat4 axesOfSunsky() { return {0, 0, 1, 0, -1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 0, 1}; }

/// Other surroundings have no zenith of their own, or +y: of an image it is up, as in the file.
std::optional<glm::dmat4> axesOf(const std::string& type) {
    if (type == "sunsky") return axesOfSunsky();
    if (type == "quasilux_cie_sky" || type == "quasilux_perez_sky") return axesOfMap();
    return std::nullopt;
}

/// Given as east, north and up. A sunsky wants it in the world, whatever its axes.
std::string sunDirection(const std::string& type, const tinygltf::Value& value, const SourceLocation& where) {
    if (type != "sunsky" || !value.IsArray() || value.ArrayLen() != 3) return textOf(value, sunKey, where);
    glm::dvec3 direction;
    for (int k = 0; k < 3; ++k) direction[k] = finiteNumber(value.Get(k), sunKey, where);
    direction = glm::dmat3(axesOfMap()) * direction;
    return fmt::format("{},{},{}", direction.x, direction.y, direction.z);
}

std::string valueOf(const std::string& type, const std::string& name, const tinygltf::Value& value,
                    const SourceLocation& where) {
    if (name == sunKey) return sunDirection(type, value, where);
    return value.IsBool() ? (value.Get<bool>() ? "true" : "false") : textOf(value, name, where);
}

Instruction instructionOf(const std::string& kind, const tinygltf::Value& object, const SourceLocation& where) {
    Instruction instruction{{}, where, kind};
    if (!object.IsObject()) throw InputError(where, fmt::format("'{}' is no object.", kind));
    for (const std::string& name : object.Keys())
        instruction.entries.push_back({name, textOf(object.Get(name), name, where)});
    // Where a scene file says nothing up is +z, where a glTF file says nothing +y.
    if (kind == "observer" && !object.Has("up")) instruction.entries.push_back({"up", "0,1,0"});
    return instruction;
}

} // namespace

std::vector<Instruction> instructionsOf(const tinygltf::Value& extras, const SourceLocation& where) {
    if (!extras.Has("quasilux")) return {};
    const tinygltf::Value& all = extras.Get("quasilux");
    if (!all.IsObject()) throw InputError(where, "'quasilux' is no object of settings.");
    std::vector<Instruction> instructions;
    Instruction settings{{}, where};
    for (const std::string& name : all.Keys()) {
        if (name == skyKey) continue;
        const tinygltf::Value& value = all.Get(name);
        if (value.IsObject())
            instructions.push_back(instructionOf(name, value, where));
        else if (value.IsArray())
            for (size_t k = 0; k < value.ArrayLen(); ++k)
                instructions.push_back(instructionOf(name, value.Get(static_cast<int>(k)), where));
        else
            settings.entries.push_back({name, textOf(value, name, where)});
    }
    if (!settings.entries.empty()) instructions.push_back(settings);
    return instructions;
}

std::optional<Element> skyOf(const tinygltf::Value& extras, const std::string& id, const SourceLocation& where) {
    if (!extras.Has("quasilux") || !extras.Get("quasilux").Has(skyKey)) return std::nullopt;
    const tinygltf::Value& sky = extras.Get("quasilux").Get(skyKey);
    if (!sky.IsObject() || !sky.Has("type") || !sky.Get("type").IsString())
        throw InputError(where, "'sky' is no object with a 'type', such as \"quasilux_cie_sky\".");
    const std::string type = sky.Get("type").Get<std::string>();
    Element emitter = newObject("emitter", type, id, where);
    for (const std::string& name : sky.Keys()) {
        if (name == "type") continue;
        const tinygltf::Value& value = sky.Get(name);
        const std::string text = valueOf(type, name, value, where);
        emitter.children.push_back({tagOf(value, name), {{"name", name}, {"value", text}}, {}, {}, where});
    }
    if (const auto axes = axesOf(type)) addMatrix(emitter, "to_world", *axes);
    return emitter;
}

} // namespace quasilux
