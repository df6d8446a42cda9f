// The table of medium plugins, and what is common to reading any of them.
#include "scene/media/medium_plugin.h"
#include "scene/plugin_lookup.h"

#include "scene/phases/phase_plugin.h"
#include "scene/quasi_specular.h"

#include <fmt/format.h>

namespace quasilux {

namespace {

struct MediumPlugin {
    std::string_view name;
    void (*read)(Properties&, MediumDescription&);
};

constexpr MediumPlugin mediumPlugins[] = {{"homogeneous", readHomogeneous}, {"heterogeneous", readHeterogeneous}};

} // namespace

Names mediumPluginNames() { return namesOf(mediumPlugins); }

MediumDescription readMedium(const Element& element, LoadContext& context) {
    MediumDescription medium;
    medium.id = idOf(element);
    medium.where = element.where;
    const MediumPlugin* plugin = findPlugin(mediumPlugins, element, context, "taken as empty");
    if (!plugin) return medium;
    Properties properties(element, context);
    plugin->read(properties, medium);
    if (const Element* phase = properties.object("phase")) readPhase(*phase, context, medium);
    properties.accept({"sample_emitters", "has_spectral_extinction"});
    properties.finish();
    medium.quasiSpecular = readMediumQuasiSpecular(element);
    return medium;
}

unsigned useMedium(const Element& element, LoadContext& context) {
    const auto known = context.mediumIndex.find(&element);
    if (known != context.mediumIndex.end()) return known->second;
    context.scene.media.push_back(readMedium(element, context));
    const auto index = static_cast<unsigned>(context.scene.media.size() - 1);
    context.mediumIndex.emplace(&element, index);
    return index;
}

} // namespace quasilux
