// Complex indices of refraction of metals.
#include "scene/bsdfs/bsdf_plugin.h"

#include <fmt/format.h>

namespace quasilux {

namespace {

struct Metal {
    std::string_view name;
    Rgb eta, k; ///< linear sRGB
};

constexpr Metal metals[] = {
    {"Cu", {0.200438f, 0.924033f, 1.102212f}, {3.912949f, 2.452848f, 2.142188f}},
    {"Au", {0.143119f, 0.374957f, 1.442479f}, {3.983160f, 2.385721f, 1.603215f}},
    {"Ag", {0.155275f, 0.116723f, 0.138341f}, {4.828387f, 3.122499f, 2.147039f}},
    {"Al", {1.657460f, 0.880369f, 0.521229f}, {9.223869f, 6.269523f, 4.837001f}},
    {"Cr", {4.369683f, 2.916713f, 1.654698f}, {5.206434f, 4.231366f, 3.754947f}},
};

const Metal& findMetal(const std::string& name, const SourceLocation& where) {
    Names known = {"none"};
    for (const Metal& metal : metals) {
        if (metal.name == name) return metal;
        known.push_back(metal.name);
    }
    throw InputError(where, fmt::format("unknown material '{}'.{} For another metal give eta and k.", name,
                                        knownNames(name, known)));
}

} // namespace

void readConductorIndex(Properties& properties, shared::Lobe& lobe) {
    const bool measured = properties.has("eta") || properties.has("k");
    const std::string material = properties.string("material", "none");
    if (measured && material != "none")
        throw InputError(properties.where("material"),
                         fmt::format("{} has both material and eta or k; keep one.", properties.describe()));
    lobe.eta = properties.positiveColor("eta", {0, 0, 0});
    lobe.k = properties.positiveColor("k", {1, 1, 1});
    if (material == "none") return;
    const Metal& metal = findMetal(material, properties.where("material"));
    lobe.eta = metal.eta;
    lobe.k = metal.k;
}

} // namespace quasilux
