#include "prepare/features.h"

#include <algorithm>
#include <array>

namespace quasilux {

namespace {

// In the order of LobeType and of EMITTER_*.
#define LOBE_NAME(ID, argument) #ID,
constexpr std::array<const char*, LOBE_TYPES> lobeNames = {LOBE_LIST(LOBE_NAME, )};
#undef LOBE_NAME
constexpr std::array<const char*, 11> emitterNames = {"RECTANGLE",   "TRIANGLES",       "SPHERE",   "POINT",
                                                      "DIRECTIONAL", "CONSTANT",        "ENVMAP",   "SPOT",
                                                      "PROJECTOR",   "DIRECTIONALAREA", "GONIOGRAM"};
constexpr std::array<const char*, 4> phaseNames = {"ISOTROPIC", "HG", "RAYLEIGH", "MIXED"}; // in the order of PHASE_*

std::string lower(std::string text) {
    std::transform(text.begin(), text.end(), text.begin(), [](unsigned char c) { return std::tolower(c); });
    return text;
}

struct Flag {
    bool Features::*member;
    const char* define;
    const char* text;
};
// What decides the classes of photons, and is no option of kernels.
constexpr std::array scatteringKinds = {&Features::genuineDiffuse, &Features::quasiSpecular, &Features::specular,
                                        &Features::genuineDiffuseMedia, &Features::quasiSpecularMedia};

constexpr std::array flags = {
    Flag{&Features::spheres, "HAS_SPHERES", "spheres"},
    Flag{&Features::nullPrimitives, "HAS_NULL_PRIMITIVES", "null surfaces"},
    Flag{&Features::cornerNormals, "HAS_CORNER_NORMALS", "vertex normals"},
    Flag{&Features::borders, "HAS_BORDERS", "surface borders"},
    Flag{&Features::instances, "HAS_INSTANCES", "instances"},
    Flag{&Features::depthLimit, "HAS_DEPTH_LIMIT", "path depth limit"},
    Flag{&Features::orthographicCamera, "HAS_ORTHOGRAPHIC_CAMERA", "orthographic camera"},
    Flag{&Features::fisheyeCamera, "HAS_FISHEYE_CAMERA", "fisheye camera"},
    Flag{&Features::thinLens, "HAS_THIN_LENS", "thin lens"},
    Flag{&Features::filterTable, "HAS_FILTER_TABLE", "tabulated reconstruction filter"},
    Flag{&Features::textures, "HAS_TEXTURES", "textures"},
    Flag{&Features::nestedTextures, "HAS_NESTED_TEXTURES", "textures within textures"},
    Flag{&Features::meshAttributes, "HAS_MESH_ATTRIBUTES", "attributes of meshes"},
    Flag{&Features::lobeWeights, "HAS_LOBE_WEIGHTS", "blends by texture"},
    Flag{&Features::weightFunctions, "HAS_WEIGHT_FUNCTIONS", "functions of textures"},
    Flag{&Features::manyLobes, "HAS_MANY_LOBES", "materials of many lobes"},
    Flag{&Features::textureVolumes, "HAS_TEXTURE_VOLUMES", "textures by place"},
    Flag{&Features::alphaTextures, "HAS_ALPHA_TEXTURES", "roughness by texture"},
    Flag{&Features::indexTextures, "HAS_INDEX_TEXTURES", "indices of refraction by texture"},
    Flag{&Features::relief, "HAS_RELIEF", "normal and bump maps"},
    Flag{&Features::anisotropy, "HAS_ANISOTROPY", "anisotropic lobes"},
    Flag{&Features::lowCoats, "HAS_LOW_COATS", "rough coats under denser media"},
    Flag{&Features::media, "HAS_MEDIA", "media"},
    Flag{&Features::chromaticMedia, "HAS_CHROMATIC_MEDIA", "media with coloured extinction"},
    Flag{&Features::heterogeneousMedia, "HAS_HETEROGENEOUS_MEDIA", "media that vary in space"},
    Flag{&Features::sharingLambert, "HAS_SHARING_LAMBERT", "diffuse paths that look for emitters"},
    Flag{&Features::sharingMedia, "HAS_SHARING_MEDIA", "paths in media that look for emitters"},
    Flag{&Features::emitterTextures, "HAS_EMITTER_TEXTURES", "emitters with textures"},
    Flag{&Features::areaTextures, "HAS_AREA_TEXTURES", "emitting shapes with textures"},
    Flag{&Features::lightTree, "HAS_LIGHT_TREE", "many emitters"},
    Flag{&Features::hiddenEmitters, "HAS_HIDDEN_EMITTERS", "emitters hidden from the camera"},
    Flag{&Features::countedPassages, "HAS_COUNTED_PASSAGES", "passages that begin segments"},
    Flag{&Features::hiddenBeyondPassages, "HAS_HIDDEN_BEYOND_PASSAGES", "emitters hidden beyond passages"},
    Flag{&Features::directByPhotons, "HAS_DIRECT_BY_PHOTONS", "direct light of some emitters by photons"},
    Flag{&Features::directInMedia, "HAS_DIRECT_IN_MEDIA", "emitters that shine into media"},
};

} // namespace

std::string lobeName(unsigned type) { return lower(lobeNames.at(type)); }
std::string emitterTypeName(unsigned type) { return lower(emitterNames.at(type)); }

std::string Features::options() const {
    std::string text;
    for (const unsigned type : lobes) text += std::string(" -DHAS_LOBE_") + lobeNames.at(type);
    if (lobes.size() == 1) text += " -DONE_LOBE_TYPE";
    for (const unsigned type : emitterTypes) text += std::string(" -DHAS_EMITTER_") + emitterNames.at(type);
    for (const unsigned type : phases) text += std::string(" -DHAS_PHASE_") + phaseNames.at(type);
    for (const auto& flag : flags)
        if (this->*flag.member) text += std::string(" -D") + flag.define;
    return text;
}

std::vector<std::string> Features::names() const {
    std::vector<std::string> list;
    for (const unsigned type : lobes) list.push_back("lobe " + lobeName(type));
    for (const unsigned type : emitterTypes) list.push_back("emitter " + emitterTypeName(type));
    for (const unsigned type : phases) list.push_back("phase " + lower(phaseNames.at(type)));
    for (const auto& flag : flags)
        if (this->*flag.member) list.emplace_back(flag.text);
    if (radianceMeter) list.emplace_back("radiance meter");
    if (irradianceMeter) list.emplace_back("irradiance meter");
    return list;
}

Features Features::generic() {
    Features all;
    for (unsigned type = 0; type < LOBE_TYPES; ++type) all.lobes.insert(type);
    for (unsigned type = 0; type < emitterNames.size(); ++type) all.emitterTypes.insert(type);
    for (unsigned type = 0; type < phaseNames.size(); ++type) all.phases.insert(type);
    for (const auto& flag : flags) all.*flag.member = true;
    all.hiddenEmitters = all.countedPassages = all.hiddenBeyondPassages = false;
    for (const auto kind : scatteringKinds) all.*kind = true;
    return all;
}

Features Features::with(const Features& further) const {
    Features all = *this;
    all.lobes.insert(further.lobes.begin(), further.lobes.end());
    all.emitterTypes.insert(further.emitterTypes.begin(), further.emitterTypes.end());
    all.phases.insert(further.phases.begin(), further.phases.end());
    for (const auto& flag : flags) all.*flag.member |= further.*flag.member;
    all.hiddenEmitters = hiddenEmitters;
    all.countedPassages = countedPassages;
    all.hiddenBeyondPassages = hiddenBeyondPassages;
    for (const auto kind : scatteringKinds) all.*kind |= further.*kind;
    return all;
}

} // namespace quasilux
