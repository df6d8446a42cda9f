#include "scene/plugin_kinds.h"

#include "scene/bsdfs/bsdf_plugin.h"
#include "scene/emitters/emitters.h"
#include "scene/integrator.h"
#include "scene/media/medium_plugin.h"
#include "scene/phases/phase_plugin.h"
#include "scene/sensors/sensors.h"
#include "scene/shapes/shape_plugin.h"
#include "scene/textures/texture_plugin.h"
#include "scene/unsupported_plugins.h"
#include "scene/volumes/volume_plugin.h"

#include <map>

namespace quasilux {

namespace {

using Kinds = std::map<std::string_view, std::string_view>; // tag by plugin

Kinds makeKinds() {
    const std::pair<std::string_view, Names> kinds[] = {
        {"shape", shapePluginNames()},     {"bsdf", bsdfPluginNames()},       {"emitter", emitterPluginNames()},
        {"texture", texturePluginNames()}, {"medium", mediumPluginNames()},   {"phase", phasePluginNames()},
        {"volume", volumePluginNames()},   {"sensor", sensorPluginNames()},   {"film", filmPluginNames()},
        {"rfilter", filterPluginNames()},  {"sampler", samplerPluginNames()}, {"integrator", integratorPluginNames()}};
    Kinds known;
    for (const auto& [tag, plugins] : kinds)
        for (const std::string_view plugin : plugins) known.emplace(plugin, tag);
    return known;
}

const Kinds& kinds() {
    static const Kinds known = makeKinds();
    return known;
}

} // namespace

std::string_view tagOfPlugin(std::string_view plugin) {
    const auto found = kinds().find(plugin);
    return found == kinds().end() ? tagOfUnsupported(plugin) : found->second;
}

Names pluginNames() {
    Names names;
    for (const auto& entry : kinds()) names.push_back(entry.first);
    return names;
}

} // namespace quasilux
