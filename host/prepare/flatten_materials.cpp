// Bsdfs into materials and lobes.
#include "prepare/device_scene.h"

#include <fmt/format.h>

namespace quasilux {

namespace {

unsigned appendSide(const Bsdf& bsdf, const std::vector<LobeDescription>& side,
                    const std::vector<LobeDecision>& decisions, std::vector<shared::Lobe>& lobes) {
    if (side.size() > LOBES_MAX)
        throw InputError(bsdf.where, fmt::format("this bsdf has {} lobes on one side, expected at most {}: blend fewer",
                                                 side.size(), LOBES_MAX));
    for (size_t k = 0; k < side.size(); ++k) {
        shared::Lobe lobe = side[k].device;
        lobe.scattering = decisions[k].scattering;
        lobes.push_back(lobe);
    }
    return static_cast<unsigned>(side.size());
}

} // namespace

MaterialTables flattenMaterials(const Scene& scene, const std::vector<BsdfDecision>& split) {
    MaterialTables tables;
    for (size_t k = 0; k < scene.bsdfs.size(); ++k) {
        const auto& bsdf = scene.bsdfs[k];
        shared::Material material{};
        material.flags = bsdf.isNull ? MATERIAL_NULL : 0;
        material.frontFirst = static_cast<unsigned>(tables.lobes.size());
        material.frontCount = appendSide(bsdf, bsdf.front, split[k].front, tables.lobes);
        material.backFirst = static_cast<unsigned>(tables.lobes.size());
        material.backCount = appendSide(bsdf, bsdf.back, split[k].back, tables.lobes);
        tables.materials.push_back(material);
    }
    return tables;
}

} // namespace quasilux
