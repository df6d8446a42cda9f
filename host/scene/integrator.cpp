// <integrator>: only its limit on the path length has a meaning here.
#include "scene/integrator.h"

#include "scene/properties.h"

#include <algorithm>
#include <fmt/format.h>

namespace quasilux {

namespace {

/// Simulate all light, as quasilux does.
const Names fullIntegrators = {"path", "volpath", "volpathmis", "ptracer",    "photonmapper",
                               "sppm", "ppm",     "bdpt",       "mlt",        "pssmlt",
                               "erpt", "prb",     "prb_basic",  "prbvolpath", "prb_projective"};
/// Compute something else, or only a part of the light.
const Names otherIntegrators = {
    "direct", "direct_projective", "emission", "emission_reparam", "aov", "stokes", "moment", "depth"};

} // namespace

int readMaxDepth(const Element& element, LoadContext& context) {
    Properties properties(element, context);
    const std::string& plugin = properties.plugin();
    const auto isIn = [&](const Names& names) { return std::find(names.begin(), names.end(), plugin) != names.end(); };
    if (isIn(otherIntegrators)) {
        context.warn(element.where,
                     fmt::format("integrator '{}' is ignored: quasilux always computes all light.", plugin));
    } else if (!isIn(fullIntegrators)) {
        Names known = fullIntegrators;
        known.insert(known.end(), otherIntegrators.begin(), otherIntegrators.end());
        throw InputError(element.where,
                         fmt::format("unknown integrator plugin '{}'.{}", plugin, knownNames(plugin, known)));
    }
    int64_t inherited = -1; // from the integrator within aov, stokes or moment
    const Element* nested = properties.object("integrator");
    for (const Element& child : element.children)
        if (&child == nested) inherited = readMaxDepth(child, context);
    const int64_t depth = properties.integer("max_depth", inherited);
    if (depth == 0 || depth < -1 || depth > 1000000)
        throw InputError(
            properties.where("max_depth"),
            fmt::format("parameter 'max_depth' is {}; expected -1 (no limit), or 1 to 1000000 (1: emitters seen "
                        "directly, 2: and direct light).",
                        depth));
    return static_cast<int>(depth);
}

bool readHideEmitters(const Element& element, LoadContext& context) {
    Properties properties(element, context);
    bool inherited = false;
    const Element* nested = properties.object("integrator");
    for (const Element& child : element.children)
        if (&child == nested) inherited = readHideEmitters(child, context);
    return properties.boolean("hide_emitters", inherited);
}

} // namespace quasilux
