// Reading of bsdfs. A new plugin is one file here and one line in the table of bsdf_table.cpp (CONTRIBUTING.md; lobes:
// docs/method/bsdf.md).
#pragma once

#include "scene/properties.h"
#include "scene/textures/texture_plugin.h"

namespace quasilux {

/// What a plugin makes of its parameters.
struct BsdfLobes {
    std::vector<LobeDescription> front, back;
    std::optional<shared::Relief> frontRelief, backRelief; ///< as in Bsdf
    bool isNull = false;
};

/// Reads a <bsdf> and those nested in it. Throws InputError for unknown plugins and parameters, and for cycles.
BsdfLobes readBsdfLobes(const Element& element, LoadContext& context);

/// Index into Scene::bsdfs of the bsdf that `element` describes; read once however often it is used.
int useBsdf(const Element& element, LoadContext& context);
/// The bsdf of shapes without one, as in Mitsuba: diffuse, reflectance 0.5, or black where the shape emits. `shape` is
/// where it is needed first.
int useDefaultBsdf(const Element& shape, bool emits, LoadContext& context);

/// Every bsdf plugin; those of the other kinds have such a function too, for plugin_kinds.h.
Names bsdfPluginNames();

BsdfLobes readDiffuse(Properties& properties);
BsdfLobes readPhong(Properties& properties);
BsdfLobes readConductor(Properties& properties);
BsdfLobes readRoughConductor(Properties& properties);
BsdfLobes readDielectric(Properties& properties);
BsdfLobes readThinDielectric(Properties& properties);
BsdfLobes readPlastic(Properties& properties);
BsdfLobes readRoughPlastic(Properties& properties);
BsdfLobes readRoughDielectric(Properties& properties);
BsdfLobes readPrincipled(Properties& properties);
BsdfLobes readPrincipledThin(Properties& properties);
BsdfLobes readBlend(Properties& properties);
BsdfLobes readMask(Properties& properties);
BsdfLobes readNormalMap(Properties& properties);
BsdfLobes readBumpMap(Properties& properties);
BsdfLobes readTwoSided(Properties& properties);
BsdfLobes readNull(Properties& properties);

/// A lobe of type LOBE_* with everything else zero. `halfWidth` in radians.
LobeDescription makeLobe(unsigned type, const std::string& name, const Reflectance& reflectance, double halfWidth);

/// Of both parts of a lobe: offset + factor times the texture's value.
shared::LobeWeight weightBy(unsigned texture, double offset = 0, double factor = 1);

/// Lets all light pass straight on: what a `null` bsdf is as part of another.
LobeDescription passageLobe();

/// (1 - weight) of the first plus weight of the second; `null` ones let pass. Throws InputError at `where` for too many
/// lobes.
BsdfLobes blend(BsdfLobes first, BsdfLobes second, const Scalar& weightOfSecond, const SourceLocation& where);

constexpr double lambertHalfWidth = 0.78539816339744831; ///< cos² = 1/2
/// Half the energy of cos^n about the mirror direction: cos^(n+1) = 1/2.
double phongHalfWidth(double exponent);
/// Twice the tilt of the microfacets within which half of D(h) cos lies; the lobe moves by twice the facet's tilt.
double ggxHalfWidth(double alpha);      ///< tan² = alpha²
double beckmannHalfWidth(double alpha); ///< tan² = alpha² ln 2

/// Index of refraction `name`: a number, or a material of Mitsuba's list.
double readRefractiveIndex(Properties& properties, const std::string& name, const std::string& missing);

/// A border between two dielectrics: their indices, and its lobe as far as both sides share it.
struct DielectricBorder {
    double inside = 1, outside = 1;
    LobeDescription lobe;

    /// The lobe with the index of the far side relative to the one on the side that light is seen from.
    LobeDescription seenFrom(double near, double far) const;
    BsdfLobes bothSides() const;
};
DielectricBorder readDielectricBorder(Properties& properties, unsigned lobeType, double halfWidth);

/// Unpolarised reflectance of a smooth border, as kernels/fresnel.clh has it; eta: index beyond over the near one.
double dielectricReflectance(double cosine, double eta);

/// What lies under the coat of <bsdf type="plastic|roughplastic">.
struct CoatedBase {
    Reflectance reflectance;
    bool nonlinear = false; ///< light that comes back from the coat is coloured again each time

    /// Its lobe, by what is seen of it through a coat of relative index `eta` that sends the share `sentBack` of
    /// diffuse light back from inside.
    LobeDescription lobe(unsigned type, double eta, double sentBack) const;
};
/// `diffuse_reflectance` and `nonlinear`.
CoatedBase readCoatedBase(Properties& properties);

/// Microfacets of <bsdf type="roughconductor|roughdielectric|roughplastic">.
struct Roughness {
    bool ggx = false;                                     ///< else Beckmann
    float alphaU = 0, alphaV = 0;                         ///< of textures the mean
    std::optional<unsigned> alphaTextureU, alphaTextureV; ///< index into Scene::textures, of equal channels

    double halfWidth() const; ///< of what is reflected, radians
    void applyTo(LobeDescription& lobe) const;
};
/// `distribution`, and `alpha` or `alpha_u` and `alpha_v`, as textures too where `byTexture`. `smooth` is the bsdf to
/// use without roughness.
Roughness readRoughness(Properties& properties, const std::string& smooth, bool byTexture);

/// eta and k of <bsdf type="conductor|roughconductor">: `material`, or `eta` and `k`, which may be textures. Without
/// Fresnel reflection (material "none") they are 0 and 1, which makes the factor |(eta - 1 - ik)/(eta + 1 - ik)|²
/// exactly 1.
void readConductorIndex(Properties& properties, shared::Lobe& lobe);

} // namespace quasilux
