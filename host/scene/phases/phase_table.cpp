// The table of phase function plugins, and what is common to reading any of them.
#include "scene/phases/phase_plugin.h"
#include "scene/plugin_lookup.h"

#include <fmt/format.h>

namespace quasilux {

namespace {

struct PhasePlugin {
    std::string_view name;
    void (*read)(Properties&, MediumDescription&);
};

constexpr PhasePlugin phasePlugins[] = {
    {"isotropic", readIsotropic}, {"hg", readHenyeyGreenstein}, {"rayleigh", readRayleigh}};

} // namespace

void readPhase(const Element& element, LoadContext& context, MediumDescription& medium) {
    context.usedPhases.insert(&element);
    const PhasePlugin* plugin = findPlugin(phasePlugins, element, context, "isotropic");
    if (!plugin) return;
    Properties properties(element, context);
    plugin->read(properties, medium);
    properties.finish();
}

} // namespace quasilux
