// Index of refraction of a transparent material, by number or by name.
#include "scene/bsdfs/bsdf_plugin.h"

#include <fmt/format.h>

namespace quasilux {

namespace {

struct Material {
    std::string_view name;
    double index;
};

/// Mitsuba's named materials: at 589 nm, 20 °C where not said otherwise.
constexpr Material materials[] = {
    {"vacuum", 1.0},      {"helium", 1.000036},        {"hydrogen", 1.000132},
    {"air", 1.000277},    {"carbon dioxide", 1.00045}, {"water", 1.3330},
    {"acetone", 1.36},    {"ethanol", 1.361},          {"carbon tetrachloride", 1.461},
    {"glycerol", 1.4729}, {"benzene", 1.501},          {"silicone oil", 1.52045},
    {"bromine", 1.661},   {"water ice", 1.31},         {"fused quartz", 1.458},
    {"pyrex", 1.470},     {"acrylic glass", 1.49},     {"polypropylene", 1.49},
    {"bk7", 1.5046},      {"sodium chloride", 1.544},  {"amber", 1.55},
    {"pet", 1.5750},      {"diamond", 2.419},
};

} // namespace

double readRefractiveIndex(Properties& properties, const std::string& name, const std::string& missing) {
    const Element* parameter = properties.find(name);
    if (parameter && parameter->tag != "string") return properties.numberAbove(name, 1, 0, true);
    const std::string material = lowerCase(properties.string(name, missing)); // as Mitsuba does
    Names known;
    for (const Material& entry : materials) {
        if (entry.name == material) return entry.index;
        known.push_back(entry.name);
    }
    throw InputError(properties.where(name),
                     fmt::format("parameter '{}': unknown material '{}'.{} Or give the index as <float>.", name,
                                 material, knownNames(material, known)));
}

} // namespace quasilux
