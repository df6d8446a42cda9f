// What <bsdf type="principled"> and <bsdf type="principledthin"> share.
#pragma once

#include "scene/bsdfs/bsdf_plugin.h"

namespace quasilux {

/// Their parameters, each with the name of its own; those that only one of them has are 0 for the other.
struct Principled {
    Reflectance base{Rgb{0.5f, 0.5f, 0.5f}};
    Scalar roughness{0.5, std::nullopt}, anisotropic, metallic, specTrans, specTint, sheen, sheenTint, flatness,
        clearcoat, clearcoatGloss;
    Scalar eta{1.5, std::nullopt};
    bool passed = false; ///< by light between facets of a thin sheet: bent at both faces, it is spread less

    bool textured() const { return base.texture != 0; }
    /// Of the facets; where textures say them, of their means.
    double alphaU() const;
    double alphaV() const;
    /// A factor on the roughness of facets, by the index.
    double narrowing(double index) const { return passed ? 0.65 * index - 0.35 : 1; }
    /// The base colour at luminance 1; white where it is black.
    Rgb tint() const;
    /// Reflectance of the sheet or body at normal incidence, where no texture says the index.
    double normalReflectance() const;
};

/// A product of shares, some of which go by textures.
struct Share {
    double constant = 1;
    std::vector<shared::LobeWeight> weights;

    Share operator*(const Share& other) const;
    Share operator*(double factor) const { return {constant * factor, weights}; }
    bool isZero() const { return constant == 0; }
};
Share share(const Scalar& parameter);
/// 1 less `factor` times the parameter.
Share rest(const Scalar& parameter, double factor = 1);

/// Those that both have, but for the index.
Principled readSharedParameters(Properties& properties);

Rgb grey(double value);
Rgb sum(Rgb a, Rgb b);

/// The lobe with the textures of a share, on those parts of it; not with its constant.
LobeDescription weighted(LobeDescription lobe, const Share& by, unsigned parts = WEIGHS_REFLECTED | WEIGHS_TRANSMITTED);
/// The function of the base's texture as a weight.
Share ofBase(const Principled& p, unsigned function);
/// The function of the texture of `eta`, which must be one, as a weight.
Share ofIndex(const Principled& p, unsigned function);

/// GGX facets of this type.
LobeDescription facets(const Principled& p, unsigned type, const Reflectance& reflectance);
/// Those whose reflectance goes by Schlick from `normal` at normal incidence to `grazing`.
LobeDescription schlick(const Principled& p, const Reflectance& scale, Rgb normal, Rgb grazing);
/// Metal, of the base colour, and what has its tint, whose reflectances go by Schlick, times these shares.
void addSchlick(const Principled& p, const Share& metal, const Share& tinted, std::vector<LobeDescription>& lobes);
/// Diffuse reflection and sheen, times these shares.
void addDiffuse(const Principled& p, const Share& diffuse, const Share& sheen, std::vector<LobeDescription>& lobes);

} // namespace quasilux
