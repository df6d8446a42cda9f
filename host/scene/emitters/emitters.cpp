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
    SceneEmitter (*read)(Properties&);
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

/// As in Mitsuba a lamp that is off is no error; here it is not even asked for light.
void warnOff(const Element& element, LoadContext& context, std::string_view why = "all that it emits is 0") {
    ++context.emittersOff;
    context.warn(element.where, fmt::format("emitter '{}' is off: {}. It is left out.", idOf(element), why));
}

constexpr std::string_view neverSampled = "its sampling_weight is 0, and nothing but samples of it finds its light";

/// Which emitter is chosen is learned here, but for a weight of 0: in Mitsuba light of the emitter then comes by what
/// bsdfs scatter there alone, and points and parallel light have nothing that a ray could meet.
bool isNeverSampled(Properties& properties) {
    constexpr std::string_view withoutSurface[] = {"point", "spot", "directional", "projector", "directionalarea"};
    const bool isMet = std::find(std::begin(withoutSurface), std::end(withoutSurface), properties.plugin()) ==
                       std::end(withoutSurface);
    if (properties.numberAbove("sampling_weight", 1, 0, false) == 0 && !isMet) return true;
    properties.accept({"sampling_weight"});
    return false;
}

bool isOff(const PointEmitter& emitter) { return isBlack(emitter.intensity); }
bool isOff(const DirectionalEmitter& emitter) { return isBlack(emitter.irradiance); }
bool isOff(const Surroundings& emitter) { return !emitter.image && isBlack(emitter.radiance); }

void add(PointEmitter&& emitter, Scene& scene) { scene.pointEmitters.push_back(std::move(emitter)); }
void add(DirectionalEmitter&& emitter, Scene& scene) { scene.directionalEmitters.push_back(std::move(emitter)); }
void add(Surroundings&& emitter, Scene& scene) { scene.surroundings = std::move(emitter); }

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
    context.refuseUnknown(element.where, aboutUnknownPlugin(element), "left out");
    return true;
}

Surroundings newSurroundings(Properties& properties) {
    const auto& before = properties.context().scene.surroundings;
    const Element& element = properties.element();
    if (before)
        throw InputError(element.where,
                         fmt::format("a second emitter all around the scene, after the emitter '{}' at {}; keep one.",
                                     before->plugin, before->where.text()));
    Surroundings surroundings;
    surroundings.id = idOf(element);
    surroundings.where = element.where;
    surroundings.plugin = properties.plugin();
    return surroundings;
}

std::optional<AreaEmitter> readShapeEmitter(const Element& element, LoadContext& context) {
    for (const ShapeEmitterPlugin& plugin : shapeEmitters) {
        if (plugin.name != element.get("type")) continue;
        context.usedEmitters.insert(&element);
        Properties properties(element, context);
        AreaEmitter emitter = plugin.read(properties);
        const bool isUnused = isNeverSampled(properties);
        properties.finish();
        if (isBlack(emitter.radiance))
            warnOff(element, context);
        else if (isUnused)
            warnOff(element, context, neverSampled);
        else
            return emitter;
        return std::nullopt;
    }
    throwNotHere(element);
}

void readSceneEmitter(const Element& element, LoadContext& context) {
    for (const SceneEmitterPlugin& plugin : sceneEmitters) {
        if (plugin.name != element.get("type")) continue;
        Properties properties(element, context);
        SceneEmitter emitter = plugin.read(properties);
        const bool isUnused = isNeverSampled(properties);
        properties.finish();
        const auto finish = [&](auto& read) {
            if (isOff(read))
                warnOff(element, context);
            else if (isUnused)
                warnOff(element, context, neverSampled);
            else
                add(std::move(read), context.scene);
        };
        std::visit(finish, emitter);
        return;
    }
    throwNotHere(element);
}

} // namespace quasilux
