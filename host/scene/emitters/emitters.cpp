// The tables of emitter plugins: those of shapes, and those that stand alone.
#include "scene/emitters/emitters.h"

#include "scene/plugin_lookup.h"

#include <algorithm>
#include <fmt/format.h>

namespace quasilux {

namespace {

struct ShapeEmitterPlugin {
    std::string_view name;
    AreaEmitter (*read)(Properties&);
};
constexpr ShapeEmitterPlugin shapeEmitters[] = {
    {"area", readArea},
    {"directionalarea", readDirectionalArea},
};

struct SceneEmitterPlugin {
    std::string_view name;
    void (*read)(Properties&);
};
constexpr SceneEmitterPlugin sceneEmitters[] = {
    {"point", readPoint},
    {"spot", readSpot},
    {"directional", readDirectional},
    {"constant", readConstant},
    {"envmap", readEnvmap},
    {"projector", readProjector},
    {"quasilux_ies", readLuminaire},
    {"quasilux_cie_sky", readCieSky},
    {"quasilux_perez_sky", readPerezSky},
    {"sunsky", readSunSky},
};

[[noreturn]] void throwNotHere(const Element& element) {
    const std::string& plugin = element.get("type");
    for (const ShapeEmitterPlugin& entry : shapeEmitters)
        if (entry.name == plugin)
            throw InputError(element.where,
                             fmt::format("emitter '{}' stands alone; put it into the <shape> that emits.", plugin));
    for (const SceneEmitterPlugin& entry : sceneEmitters)
        if (entry.name == plugin)
            throw InputError(element.where,
                             fmt::format("emitter '{}' is nested in a shape; put it directly into <scene>.", plugin));
    throwUnknownPlugin(element, emitterPluginNames());
}

} // namespace

Names emitterPluginNames() { return namesOf(sceneEmitters, namesOf(shapeEmitters)); }

bool isShapeEmitter(const Element& element) {
    return std::any_of(std::begin(shapeEmitters), std::end(shapeEmitters),
                       [&](const ShapeEmitterPlugin& plugin) { return plugin.name == element.get("type"); });
}

bool leavesOutEmitter(const Element& element, LoadContext& context) {
    const auto isNamed = [&](const auto& entry) { return entry.name == element.get("type"); };
    if (context.unknown == Unknown::refused ||
        std::any_of(std::begin(shapeEmitters), std::end(shapeEmitters), isNamed) ||
        std::any_of(std::begin(sceneEmitters), std::end(sceneEmitters), isNamed))
        return false;
    context.refuseUnknown(element.where, fmt::format("unknown emitter plugin '{}'.", element.get("type")), "left out");
    return true;
}

Surroundings& addSurroundings(Properties& properties) {
    auto& surroundings = properties.context().scene.surroundings;
    const Element& element = properties.element();
    if (surroundings)
        throw InputError(element.where,
                         fmt::format("a second emitter all around the scene, after the emitter '{}' at {}; keep one.",
                                     surroundings->plugin, surroundings->where.text()));
    surroundings.emplace();
    surroundings->id = idOf(element);
    surroundings->where = element.where;
    surroundings->plugin = properties.plugin();
    return *surroundings;
}

AreaEmitter readShapeEmitter(const Element& element, LoadContext& context) {
    for (const ShapeEmitterPlugin& plugin : shapeEmitters) {
        if (plugin.name != element.get("type")) continue;
        context.usedEmitters.insert(&element);
        Properties properties(element, context);
        AreaEmitter emitter = plugin.read(properties);
        properties.accept({"sampling_weight"}); // which emitter is chosen is learned
        properties.finish();
        return emitter;
    }
    throwNotHere(element);
}

void readSceneEmitter(const Element& element, LoadContext& context) {
    for (const SceneEmitterPlugin& plugin : sceneEmitters) {
        if (plugin.name != element.get("type")) continue;
        Properties properties(element, context);
        plugin.read(properties);
        properties.accept({"sampling_weight"}); // which emitter is chosen is learned
        properties.finish();
        return;
    }
    throwNotHere(element);
}

} // namespace quasilux
