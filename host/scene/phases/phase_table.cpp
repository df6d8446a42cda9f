// The table of phase function plugins, and what is common to reading any of them.
#include "scene/phases/phase_plugin.h"
#include "scene/plugin_lookup.h"

namespace quasilux {

namespace {

struct PhasePlugin {
    std::string_view name;
    void (*read)(Properties&, MediumDescription&);
};

constexpr PhasePlugin phasePlugins[] = {{"isotropic", readIsotropic},
                                        {"hg", readHenyeyGreenstein},
                                        {"rayleigh", readRayleigh},
                                        {"tabphase", readTabulated},
                                        {"blendphase", readBlend}};

} // namespace

Names phasePluginNames() { return namesOf(phasePlugins); }

void readPhase(const Element& element, LoadContext& context, MediumDescription& medium) {
    context.usedPhases.insert(&element);
    const PhasePlugin* plugin = findPlugin(phasePlugins, element, context, "isotropic");
    if (!plugin) return;
    Properties properties(element, context);
    std::vector<const Element*>& open = context.openPhases;
    context.enter(element, open);
    plugin->read(properties, medium);
    open.pop_back();
    properties.finish();
}

} // namespace quasilux
