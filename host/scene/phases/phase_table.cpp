// The table of phase function plugins, and what is common to reading any of them.
#include "scene/phases/phase_plugin.h"

#include <fmt/format.h>

namespace quasilux {

namespace {

struct PhasePlugin {
    std::string_view name;
    void (*read)(Properties&, MediumDescription&);
};

constexpr PhasePlugin plugins[] = {
    {"isotropic", readIsotropic}, {"hg", readHenyeyGreenstein}, {"rayleigh", readRayleigh}};

const PhasePlugin& findPlugin(const Element& element) {
    Names known;
    for (const PhasePlugin& plugin : plugins) {
        if (plugin.name == element.get("type")) return plugin;
        known.push_back(plugin.name);
    }
    throw InputError(element.where, fmt::format("unknown phase plugin '{}'.{}", element.get("type"),
                                                knownNames(element.get("type"), known)));
}

} // namespace

void readPhase(const Element& element, LoadContext& context, MediumDescription& medium) {
    const PhasePlugin& plugin = findPlugin(element);
    Properties properties(element, context);
    plugin.read(properties, medium);
    properties.finish();
    context.usedPhases.insert(&element);
}

} // namespace quasilux
