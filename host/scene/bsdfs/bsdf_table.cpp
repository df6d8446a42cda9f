// The table of bsdf plugins, and what is common to reading any of them.
#include "scene/bsdfs/bsdf_plugin.h"
#include "scene/plugin_lookup.h"
#include "scene/quasi_specular.h"

#include <algorithm>

namespace quasilux {

namespace {

struct BsdfPlugin {
    std::string_view name;
    BsdfLobes (*read)(Properties&);
};

constexpr BsdfPlugin bsdfPlugins[] = {
    {"diffuse", readDiffuse},
    {"phong", readPhong},
    {"conductor", readConductor},
    {"roughconductor", readRoughConductor},
    {"dielectric", readDielectric},
    {"thindielectric", readThinDielectric},
    {"plastic", readPlastic},
    {"roughplastic", readRoughPlastic},
    {"roughdielectric", readRoughDielectric},
    {"principled", readPrincipled},
    {"principledthin", readPrincipledThin},
    {"blendbsdf", readBlend},
    {"mask", readMask},
    {"normalmap", readNormalMap},
    {"bumpmap", readBumpMap},
    {"twosided", readTwoSided},
    {"null", readNull},
};

/// Lobes that scatter nothing cost time and noise.
void dropBlackLobes(std::vector<LobeDescription>& lobes) {
    const auto black = [](const LobeDescription& lobe) {
        return isBlack(lobe.device.reflectance) && isBlack(lobe.device.transmittance);
    };
    lobes.erase(std::remove_if(lobes.begin(), lobes.end(), black), lobes.end());
}

/// Makes what thin panes let pass lobes of their own, which shadow rays pass too. Where a texture bends the normal
/// shadow rays would have to know the bent one: there a pane stays one lobe, and light behind it comes as photons.
void splitPanes(std::vector<LobeDescription>& lobes, const std::optional<shared::Relief>& relief) {
    if (relief) return;
    for (size_t i = 0, before = lobes.size(); i < before; ++i) {
        if (lobes[i].device.type != LOBE_THINDIELECTRIC) continue;
        LobeDescription passing = lobes[i];
        passing.name = "pane";
        passing.device.type = LOBE_PANE;
        passing.device.reflectance = {0, 0, 0};
        passing.device.reflectanceTexture = passing.device.transmittanceTexture; // either tint is that of its light
        lobes[i].device.transmittance = {0, 0, 0};
        lobes[i].device.transmittanceTexture = 0;
        lobes.push_back(std::move(passing));
    }
}

int addBsdf(BsdfLobes lobes, std::string id, std::string plugin, const SourceLocation& where, Scene& scene) {
    splitPanes(lobes.front, lobes.frontRelief);
    splitPanes(lobes.back, lobes.backRelief);
    dropBlackLobes(lobes.front);
    dropBlackLobes(lobes.back);
    Bsdf bsdf;
    bsdf.id = std::move(id);
    bsdf.plugin = std::move(plugin);
    bsdf.where = where;
    bsdf.front = std::move(lobes.front);
    bsdf.back = std::move(lobes.back);
    bsdf.frontRelief = lobes.frontRelief;
    bsdf.backRelief = lobes.backRelief;
    bsdf.isNull = lobes.isNull;
    scene.bsdfs.push_back(std::move(bsdf));
    return static_cast<int>(scene.bsdfs.size()) - 1;
}

BsdfLobes greyLobes(float reflectance) {
    BsdfLobes lobes;
    lobes.front = {makeLobe(LOBE_LAMBERT, "diffuse", Rgb{reflectance, reflectance, reflectance}, lambertHalfWidth)};
    return lobes;
}

} // namespace

Names bsdfPluginNames() { return namesOf(bsdfPlugins); }

BsdfLobes readBsdfLobes(const Element& element, LoadContext& context) {
    std::vector<const Element*>& open = context.openBsdfs;
    const BsdfPlugin* plugin = findPlugin(bsdfPlugins, element, context, "a grey diffuse bsdf of reflectance 0.5");
    if (!plugin) return greyLobes(0.5f);
    context.enter(element, open);
    Properties properties(element, context);
    BsdfLobes lobes = plugin->read(properties);
    properties.finish();
    applyQuasiSpecular(element, lobes.front, lobes.back);
    open.pop_back();
    return lobes;
}

int useBsdf(const Element& element, LoadContext& context) {
    const auto known = context.bsdfIndex.find(&element);
    if (known != context.bsdfIndex.end()) return known->second;
    const int index =
        addBsdf(readBsdfLobes(element, context), idOf(element), element.get("type"), element.where, context.scene);
    context.bsdfIndex.emplace(&element, index);
    return index;
}

int useDefaultBsdf(const Element& shape, bool emits, LoadContext& context) {
    int& index = emits ? context.defaultEmitterBsdf : context.defaultBsdf;
    if (index >= 0) return index;
    index = addBsdf(greyLobes(emits ? 0.0f : 0.5f), emits ? "default (emitters)" : "default", "diffuse", shape.where,
                    context.scene);
    return index;
}

} // namespace quasilux
