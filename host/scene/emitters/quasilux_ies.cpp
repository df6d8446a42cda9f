// <emitter type="quasilux_ies">: a luminaire by its IES or EULUMDAT file (docs/reference/photometry.md).
#include "scene/emitters/emitters.h"
#include "scene/transform.h"

#include <cmath>
#include <fmt/format.h>

namespace quasilux {

namespace {

/// Content of an IES file that the scene holds, or null.
const std::string* heldGoniogram(const LoadContext& context, const std::string& name) {
    if (!context.embedded) return nullptr;
    const auto found = context.embedded->goniograms.find(name);
    return found == context.embedded->goniograms.end() ? nullptr : &found->second;
}

/// Index into Scene::luminaireTypes; of luminaires of a type the file is read once.
unsigned typeOf(Properties& properties) {
    LoadContext& context = properties.context();
    const std::string name = properties.string("filename", "");
    const SourceLocation where = properties.where("filename");
    if (name.empty())
        throw InputError(where,
                         fmt::format("{} needs <string name=\"filename\" value=\"….ies\"/>.", properties.describe()));
    const int64_t lampSet = properties.integer("lamp_set", firstLampSet);
    if (lampSet < 1)
        throw InputError(properties.where("lamp_set"),
                         fmt::format("parameter 'lamp_set' is {}; expected a number from 1.", lampSet));
    const double metresPerUnit = properties.numberAbove("metres_per_unit", 1, 0, true);
    const bool fromShape = properties.boolean("luminous_shape", true);
    const std::string* const held = heldGoniogram(context, name);
    const std::string path = held ? name : context.files.resolve(name, where);
    const auto [entry, isNew] =
        context.luminaireTypes.insert({{path, static_cast<size_t>(lampSet), metresPerUnit, fromShape},
                                       static_cast<unsigned>(context.scene.luminaireTypes.size())});
    if (isNew) {
        const auto mayRead = [&](const std::string& named, const SourceLocation& whereNamed) {
            context.files.guard().admit(named, whereNamed);
        };
        Goniogram goniogram =
            held ? readHeldGoniogram(name, *held) : readGoniogram(path, where, static_cast<size_t>(lampSet), mayRead);
        context.scene.warnings.insert(context.scene.warnings.end(), goniogram.warnings.begin(),
                                      goniogram.warnings.end());
        context.scene.luminaireTypes.push_back({std::move(goniogram), metresPerUnit, fromShape});
    }
    return entry->second;
}

} // namespace

SceneEmitter readLuminaire(Properties& properties) {
    const glm::dmat4 toWorld = roundPlacement(properties);
    const unsigned index = typeOf(properties);
    const LuminaireType& type = properties.context().scene.luminaireTypes[index];
    double factor = properties.numberAbove("maintenance", 1, 0, true);
    factor *= type.goniogram.tiltFactor(properties.number("tilt", 0), properties.where("tilt"));
    if (properties.has("lumens")) factor *= properties.numberAbove("lumens", 0, 0, true) / type.goniogram.lumens();
    // Irradiance is intensity over the square of a distance in scene units, and is to be that by square metre.
    factor /= type.metresPerUnit * type.metresPerUnit;
    factor *= radiantFactor(properties);
    if (!(factor > 0))
        throw InputError(properties.element().where,
                         fmt::format("{} sends no light: its factors multiply to 0. Remove it if it is off.",
                                     properties.describe()));

    PointEmitter emitter = darkPointAt(transformPoint(toWorld, glm::dvec3(0)), properties);
    const Rgb tint = readLightColour(properties);
    const auto channel = [&](float share) { return toFiniteFloat(factor * share, emitter.where, "the intensity"); };
    emitter.intensity = {channel(tint.r), channel(tint.g), channel(tint.b)};
    PointEmitter::Luminaire luminaire{index, {}};
    // At right angles, whatever digits a matrix leaves out.
    const glm::dvec3 z = glm::normalize(transformVector(toWorld, {0, 0, 1})),
                     along = transformVector(toWorld, {1, 0, 0});
    const glm::dvec3 x = glm::normalize(along - glm::dot(along, z) * z), y = glm::cross(z, x);
    luminaire.axes = {x, glm::dot(y, transformVector(toWorld, {0, 1, 0})) < 0 ? -y : y, z};
    emitter.luminaire = luminaire;
    return emitter;
}

} // namespace quasilux
