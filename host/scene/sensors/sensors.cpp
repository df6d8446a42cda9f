// The table of sensor plugins, and what all of them have: film, sampler, clipping planes.
#include "scene/sensors/sensors.h"

#include "scene/media/medium_plugin.h"
#include "scene/plugin_lookup.h"

#include <algorithm>
#include <fmt/format.h>

namespace quasilux {

namespace {

struct SensorPlugin {
    std::string_view name;
    void (*read)(Properties&, Sensor&);
    bool clips; ///< has clipping planes
    bool isOnShape;
};
constexpr SensorPlugin sensorPlugins[] = {
    {"perspective", readPerspective, true, false},      {"thinlens", readThinLens, true, false},
    {"orthographic", readOrthographic, true, false},    {"quasilux_fisheye", readFisheye, true, false},
    {"radiancemeter", readRadiancemeter, false, false}, {"irradiancemeter", readIrradiancemeter, false, true},
};

void checkPlace(const SensorPlugin& plugin, const Element& element, bool inShape) {
    if (plugin.isOnShape && !inShape)
        throw InputError(element.where,
                         fmt::format("sensor '{}' measures on a shape; put it into a <shape>.", plugin.name));
    if (!plugin.isOnShape && inShape)
        throw InputError(element.where,
                         fmt::format("sensor '{}' may not stand in a <shape>; put it into the <scene>.", plugin.name));
}

/// Any of Mitsuba's: quasilux draws its own numbers.
const Names samplers = {"independent", "stratified", "multijitter", "orthogonal", "ldsampler"};
/// And those of Mitsuba 0.x.
const Names formerSamplers = {"sobol", "halton", "hammersley"};

const Names batch = {"batch"}; // placeSensors takes it apart

} // namespace

Names sensorPluginNames() { return namesOf(sensorPlugins, batch); }

Names samplerPluginNames() { return samplers; }

void refuseResponse(Properties& properties) {
    if (properties.find("srf") || properties.texture("srf"))
        throw InputError(properties.where("srf"), "parameter 'srf': light is linear RGB here, so that a sensor has no "
                                                  "spectral response; remove it.");
}

Sensor readSensor(const PlacedSensor& placed, LoadContext& context) {
    const Element& element = *placed.element;
    const SensorPlugin& plugin = findPlugin(sensorPlugins, element, batch);
    checkPlace(plugin, element, placed.shape.has_value());
    Properties properties(element, context);
    Sensor sensor;
    sensor.where = element.where;
    sensor.plugin = plugin.name;
    sensor.meterShape = placed.shape.value_or(0);
    readFilter(nullptr, context, sensor); // for a sensor without film
    const Element* film = properties.object("film");
    if (placed.film) // instead of its own, as in Mitsuba
        takeShareOfFilm(*placed.film, context, sensor);
    else if (film)
        readFilm(*film, context, sensor);
    if (const Element* sampler = properties.object("sampler")) readSampler(*sampler, context);
    if (plugin.clips) {
        sensor.nearClip = properties.numberAbove("near_clip", sensor.nearClip, 0, true);
        sensor.farClip = properties.numberAbove("far_clip", sensor.farClip, sensor.nearClip, true);
    }
    if (const Element* medium = properties.object("medium")) sensor.medium = useMedium(*medium, context);
    plugin.read(properties, sensor);
    properties.accept({"shutter_open", "shutter_close"}); // nothing moves
    refuseResponse(properties);
    properties.finish();
    return sensor;
}

void readSampler(const Element& element, LoadContext& context) {
    Properties properties(element, context);
    const auto isIn = [&](const Names& names) {
        return std::find(names.begin(), names.end(), properties.plugin()) != names.end();
    };
    if (!isIn(samplers) && !isIn(formerSamplers))
        context.refuseUnknown(element.where,
                              fmt::format("unknown sampler plugin '{}'.{}", properties.plugin(),
                                          knownNames(properties.plugin(), samplers)),
                              "ignored");
    properties.acceptAll();
}

} // namespace quasilux
