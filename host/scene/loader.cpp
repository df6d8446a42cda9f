// loadScene: from the tree of elements to a Scene.
#include "scene/loader.h"

#include "scene/bsdfs/bsdf_plugin.h"
#include "scene/emitters/emitters.h"
#include "scene/gltf/gltf_document.h"
#include "scene/illuminance_grid.h"
#include "scene/integrator.h"
#include "scene/load_context.h"
#include "scene/media/medium_plugin.h"
#include "scene/observer.h"
#include "scene/origin.h"
#include "scene/phases/phase_plugin.h"
#include "scene/sensors/sensors.h"
#include "scene/settings.h"
#include "scene/shapes/instance_levels.h"
#include "scene/shapes/shape_plugin.h"
#include "scene/textures/constant_texture.h"
#include "scene/textures/texture_plugin.h"
#include "scene/volumes/volume_plugin.h"
#include "scene/xml/numbers.h"
#include "scene/xml/upgrade.h"

#include <algorithm>
#include <fmt/format.h>

namespace quasilux {

namespace {

void checkVersion(const Element& root, LoadContext& context) {
    const std::string& version = root.get("version");
    const int major = majorVersion(version);
    if (major < 0)
        throw InputError(root.where,
                         fmt::format("version '{}' is not a version; expected one such as 3.0.0.", version));
    if (major < 2)
        context.warn(root.where, fmt::format("version {}: names of parameters are upgraded to those of Mitsuba 3, as "
                                             "Mitsuba does; plugins and defaults are those of version 3.",
                                             version));
    else if (major != 3)
        context.warn(
            root.where,
            fmt::format("version {} is read as Mitsuba 3: names and defaults are those of version 3.", version));
}

void readObject(const Element& object, LoadContext& context, std::vector<PlacedSensor>& sensors,
                std::vector<const Element*>& integrators) {
    if (object.tag == "shape") {
        for (PlacedShape& placed : readShapes(object, context)) {
            context.scene.shapes.push_back(std::move(placed.shape));
            if (placed.sensor)
                sensors.push_back(
                    {placed.sensor, static_cast<unsigned>(context.scene.shapes.size() - 1), std::nullopt});
        }
    } else if (object.tag == "emitter") {
        const bool isShared = isShapeEmitter(object) && object.find("id");
        if (!isShared && !leavesOutEmitter(object, context)) readSceneEmitter(object, context);
    } else if (object.tag == "sensor") {
        for (const PlacedSensor& placed : placeSensors(object, context)) sensors.push_back(placed);
    } else if (object.tag == "integrator")
        integrators.push_back(&object);
    else if (object.tag == "bsdf" || object.tag == "texture" || object.tag == "medium" || object.tag == "phase" ||
             object.tag == "volume" || object.tag == "film" || object.tag == "sampler" || object.tag == "alias")
        return; // read where another object uses it
    else
        throw InputError(object.where,
                         fmt::format("<{}> may not stand directly in <scene>; expected shape, bsdf, texture, medium, "
                                     "phase, volume, emitter, sensor, film, sampler or integrator.",
                                     object.tag));
}

/// All, in the order of the file.
void readObjects(const Element& root, LoadContext& context, std::vector<PlacedSensor>& sensors,
                 std::vector<const Element*>& integrators) {
    size_t next = 0;
    for (size_t k = 0; k <= root.children.size(); ++k) {
        for (; root.instances && next < root.instances->all.size() && root.instances->all[next].before == k; ++next)
            for (ShapeDescription& shape : readPlainInstance(root.instances->all[next], context))
                context.scene.shapes.push_back(std::move(shape));
        if (k < root.children.size()) readObject(root.children[k], context, sensors, integrators);
    }
}

/// Groups that no instance places, likewise.
void checkUnusedGroups(const Element& root, LoadContext& context) {
    for (const Element& element : root.children)
        if (element.tag == "shape" && element.get("type") == "shapegroup" && !context.usedGroups.count(&element)) {
            checkUnusedGroup(element, context);
            context.warn(element.where, fmt::format("shapegroup '{}' is used by no instance.", idOf(element)));
        }
}

/// Bsdfs that no shape uses are checked all the same, and reported.
void checkUnusedBsdfs(const Element& root, LoadContext& context, const std::vector<const Element*>& nested) {
    for (const Element& element : root.children) {
        if (element.tag != "bsdf" || context.bsdfIndex.count(&element)) continue;
        readBsdfLobes(element, context);
        if (std::find(nested.begin(), nested.end(), &element) == nested.end())
            context.warn(element.where, fmt::format("bsdf '{}' is used by no shape.", idOf(element)));
    }
}

/// Textures that no bsdf uses, likewise.
void checkUnusedTextures(const Element& root, LoadContext& context) {
    for (const Element& element : root.children) {
        if (element.tag != "texture" || context.textureIndex.count(&element)) continue;
        if (isConstantTexture(element))
            readConstantTexture(element, ColorUse::emission, context);
        else if (!replacesTexture(element, context))
            readTexture(element, context);
        context.warn(element.where, fmt::format("texture '{}' is used by no bsdf.", idOf(element)));
    }
}

/// Emitters for shapes that no shape has, likewise.
void checkUnusedEmitters(const Element& root, LoadContext& context) {
    for (const Element& element : root.children) {
        if (element.tag != "emitter" || !isShapeEmitter(element) || context.usedEmitters.count(&element)) continue;
        readShapeEmitter(element, context);
        context.warn(element.where, fmt::format("emitter '{}' is used by no shape.", idOf(element)));
    }
}

/// Media that no shape, sensor or emitter uses, likewise, and phase functions that no medium uses.
void checkUnusedMedia(const Element& root, LoadContext& context) {
    for (const Element& element : root.children) {
        if (element.tag != "medium" || context.mediumIndex.count(&element)) continue;
        readMedium(element, context);
        context.warn(element.where, fmt::format("medium '{}' is used by no shape, sensor or emitter.", idOf(element)));
    }
    for (const Element& element : root.children) {
        if (element.tag != "phase" || context.usedPhases.count(&element)) continue;
        MediumDescription unused;
        readPhase(element, context, unused);
        context.warn(element.where, fmt::format("phase '{}' is used by no medium.", idOf(element)));
    }
}

/// Volumes that no medium uses, likewise.
void checkUnusedVolumes(const Element& root, LoadContext& context) {
    for (const Element& element : root.children) {
        if (element.tag != "volume" || context.volumeIndex.count(&element) || context.shownVolumes.count(&element))
            continue;
        readVolume(element, context);
        context.warn(element.where, fmt::format("volume '{}' is used by no medium and no texture.", idOf(element)));
    }
}

/// What the references within bsdfs name.
void collectNested(const Element& element, const LoadContext& context, std::vector<const Element*>& nested) {
    for (const Element& child : element.children) {
        if (child.tag == "ref" && element.tag == "bsdf") nested.push_back(&context.resolve(child));
        collectNested(child, context, nested);
    }
}

bool isNumber(const std::string& text) {
    return !text.empty() && text.find_first_not_of("0123456789") == std::string::npos;
}

/// Of the sensor that `wanted` says by number or id. A sensor whose id is a number goes by it.
size_t chooseSensor(const std::vector<PlacedSensor>& sensors, const std::string& wanted, const LoadContext& context) {
    if (wanted.empty()) return 0;
    Names ids;
    for (size_t i = 0; i < sensors.size(); ++i) {
        const std::string* id = sensors[i].element->find("id");
        if (id && *id == wanted) return i;
        if (id) ids.push_back(*id);
    }
    if (isNumber(wanted) && wanted.size() < 10 && std::stoul(wanted) < sensors.size()) return std::stoul(wanted);
    throw InputError({context.scene.path},
                     fmt::format("the scene has no sensor '{}'; its sensors have the numbers 0 to {}.{}", wanted,
                                 sensors.size() - 1, ids.empty() ? "" : knownNames(wanted, ids)));
}

/// A scene with grids needs no sensor: the grids are what is measured then. All sensors are checked, one is kept.
void readSensors(const std::vector<PlacedSensor>& sensors, const LoadChoice& choice, LoadContext& context) {
    const std::string& wanted = choice.sensor;
    context.scene.sensorCount = sensors.size();
    if (sensors.empty() && !context.scene.grids.empty() && wanted.empty()) {
        useGridsAsSensor(context.scene);
        return;
    }
    if (sensors.empty() && choice.observersSuffice && !context.scene.observers.empty() && wanted.empty()) {
        context.scene.sensor.meter = MeterKind::grid; // of eyes, whose grids come when each is measured
        return;
    }
    if (sensors.empty())
        throw InputError({context.scene.path}, "the scene has no <sensor>; add <sensor type=\"perspective\">.");
    const size_t chosen = chooseSensor(sensors, wanted, context);
    std::vector<const Element*> further;
    for (size_t i = 0; i < sensors.size(); ++i) {
        const Sensor sensor = readSensor(sensors[i], context);
        if (i == chosen)
            context.scene.sensor = sensor;
        else if (wanted.empty())
            further.push_back(sensors[i].element);
    }
    if (further.empty()) return;
    const std::string others = further.size() == 1 ? "1" : fmt::format("1 to {}", further.size());
    context.warn(further.front()->where,
                 fmt::format("{}; only the first one is rendered (--sensor {} renders {}, --sensor all each of them).",
                             further.size() == 1
                                 ? "a further <sensor>"
                                 : fmt::format("{} further sensors, of which this is the first", further.size()),
                             others, further.size() == 1 ? "this one" : "another"));
}

/// As in Mitsuba it is no error, though only its layers may be worth anything.
void checkEmitters(LoadContext& context) {
    const Scene& scene = context.scene;
    const bool emits = std::any_of(scene.shapes.begin(), scene.shapes.end(),
                                   [](const auto& shape) { return shape.emitter.has_value(); });
    if (emits || !scene.pointEmitters.empty() || !scene.directionalEmitters.empty() || scene.surroundings) return;
    const std::string layers = scene.aovs.empty() ? "" : " The layers of the integrator 'aov' need no light.";
    if (context.emittersOff > 0)
        context.warn({scene.path}, "every emitter of the scene is off, so its image is black; give one of them a "
                                   "radiance, intensity, irradiance or scale above 0." +
                                       layers);
    else
        context.warn({scene.path},
                     "the scene has no emitter, so its image is black; put <emitter type=\"area\"> into a shape, or "
                     "add <emitter type=\"point\">, <emitter type=\"directional\">, <emitter type=\"constant\"> or "
                     "<emitter type=\"envmap\">." +
                         layers);
}

/// Lux that are asked for of a sky that has none.
void checkUnitsOfSky(LoadContext& context) {
    const Scene& scene = context.scene;
    if (!scene.surroundings || !scene.surroundings->isPerNanometre) return;
    if (isIrradiance(scene.sensor.meter) || !scene.grids.empty() || !scene.observers.empty() ||
        !scene.luminaireTypes.empty() || scene.sensor.fisheye != FISHEYE_NONE)
        context.warn(
            scene.surroundings->where,
            fmt::format("emitter '{}' is in W per nanometre, so that lux and cd/m² are some 107 times too "
                        "low, beside luminaires too; set sun_scale and sky_scale to 106.75, or begin the scene "
                        "with <?quasilux units=\"photometric\"?>.",
                        scene.surroundings->plugin));
}

/// Light without a surface that a picture would show: glare rated from such an image lacks it.
void checkFisheye(LoadContext& context) {
    const Scene& scene = context.scene;
    if (scene.sensor.fisheye == FISHEYE_NONE || (scene.directionalEmitters.empty() && scene.pointEmitters.empty()))
        return;
    context.warn(
        scene.sensor.where,
        "parallel light, such as the sun of a sky by its type, and emitters of points, luminaires among them, have "
        "no picture: `quasilux dgp` of this image lacks them as sources and in its illuminance. The sun of a "
        "sunsky is seen; of lamps see UGR in `quasilux report`.");
}

/// Other tools would look for channels that are not there.
void checkLayersOfMeter(LoadContext& context) {
    const Sensor& sensor = context.scene.sensor;
    const bool isMeter = sensor.meter == MeterKind::ray || sensor.meter == MeterKind::area;
    if (!isMeter || (context.scene.aovs.empty() && !sensor.pixelFormat.alpha)) return;
    context.warn(
        sensor.where,
        fmt::format("the {} has neither layers of integrator 'aov' nor alpha: cameras have them.", sensor.plugin));
}

/// What is read more than once, such as a group by its instances, says what it has to say each time.
void keepEachOnce(std::vector<std::string>& messages) {
    std::set<std::string> seen;
    std::erase_if(messages, [&](const std::string& one) { return !seen.insert(one).second; });
}

/// The last warnings: what was unknown or out of range, and how much of it.
void listForgiven(LoadContext& context) {
    if (context.forgiven.empty()) return;
    std::vector<std::string>& warnings = context.scene.warnings;
    warnings.push_back(fmt::format(
        "{} unknown or out of range in the scene, so that its image may not be the one that is meant:",
        context.forgiven.size() == 1 ? "1 thing is" : fmt::format("{} things are", context.forgiven.size())));
    warnings.insert(warnings.end(), context.forgiven.begin(), context.forgiven.end());
}

/// A grid, or an observer.
void readMeasurement(const Instruction& instruction, Scene& scene) {
    if (instruction.kind == observerKind) {
        scene.observers.push_back(parseObserver(instruction, scene.observers.size()));
        scene.observers.back().position -= scene.origin;
    } else if (instruction.kind != illuminanceGridKind) {
        const Names kinds = {illuminanceGridKind, observerKind};
        throw InputError(instruction.where, fmt::format("unknown <?quasilux {}?>.{}", instruction.kind,
                                                        knownNames(instruction.kind, kinds)));
    } else {
        scene.grids.push_back(parseIlluminanceGrid(instruction, scene.grids));
        scene.grids.back().origin -= scene.origin;
    }
}

struct ReadScene {
    Scene scene;
    std::optional<InputError> withoutArea; ///< LoadContext::withoutArea
};

/// The scene in coordinates of the file less `origin`.
ReadScene readScene(const SceneDocument& document, const std::string& path, const LoadChoice& choice,
                    const glm::dvec3& origin) {
    const Element& root = document.root;
    document.files.guard().forgetPixels();
    ReadScene read;
    Scene& scene = read.scene;
    scene.path = path;
    scene.origin = origin;
    LoadContext context(root, document.files, scene);
    context.unknown = choice.unknown;
    context.forgiven = document.forgiven;
    context.embedded = document.embedded.get();
    scene.warnings = document.warnings;
    checkVersion(root, context);
    std::vector<Instruction> settings;
    for (const Instruction& instruction : root.instructions)
        if (instruction.kind.empty())
            settings.push_back(instruction);
        else
            readMeasurement(instruction, scene);
    scene.settings = parseSceneSettings(settings);

    countPlaces(root, context);
    chooseLevels(context);
    std::vector<PlacedSensor> sensors;
    std::vector<const Element*> integrators, nestedBsdfs;
    readObjects(root, context, sensors, integrators);
    appendGroups(context);
    collectNested(root, context, nestedBsdfs);
    checkUnusedGroups(root, context);
    checkUnusedBsdfs(root, context, nestedBsdfs);
    checkUnusedTextures(root, context);
    checkUnusedEmitters(root, context);
    readSensors(sensors, choice, context);
    checkUnusedMedia(root, context);
    checkUnusedVolumes(root, context);
    if (integrators.size() > 1) throw InputError(integrators[1]->where, "a second <integrator>; keep one.");
    if (!integrators.empty()) {
        const IntegratorChoice integrator = readIntegrator(*integrators[0], context);
        scene.maxDepth = integrator.maxDepth;
        scene.hideEmitters = integrator.hidesEmitters;
        scene.countsPassages = integrator.countsPassages;
        scene.hidesBeyondPassages = integrator.hidesBeyondPassages;
    }
    checkEmitters(context);
    checkUnitsOfSky(context);
    checkFisheye(context);
    checkLayersOfMeter(context);
    for (auto* messages : {&scene.warnings, &scene.withoutEffect, &context.forgiven}) keepEachOnce(*messages);
    listForgiven(context);
    read.withoutArea = std::move(context.withoutArea);
    return read;
}

ReadScene readAboutItsOrigin(const SceneDocument& document, const std::string& path, const LoadChoice& choice) {
    glm::dvec3 origin;
    {
        ReadScene read = readScene(document, path, choice, glm::dvec3(0));
        origin = chooseOrigin(read.scene);
        if (origin == read.scene.origin) return read;
    } // its meshes, which may be large, are gone before the second reading
    return readScene(document, path, choice, origin);
}

} // namespace

Scene loadScene(const std::string& path, const std::vector<std::pair<std::string, std::string>>& parameters,
                const LoadChoice& choice) {
    const auto guard = std::make_shared<LoadGuard>(path, choice.limits);
    std::optional<Scene> scene;
    guard->withinMemory([&] {
        scene = loadScene(isGltf(path) ? readGltfDocument(path, parameters, choice.unknown, guard)
                                       : readSceneDocument(path, parameters, choice.unknown, guard),
                          path, choice);
    });
    return std::move(*scene);
}

Scene loadScene(const SceneDocument& document, const std::string& path, const LoadChoice& choice) {
    ReadScene read = readAboutItsOrigin(document, path, choice);
    if (read.withoutArea) throw InputError(*read.withoutArea);
    return std::move(read.scene);
}

} // namespace quasilux
