// What <bsdf type="principled"> and <bsdf type="principledthin"> share.
#pragma once

#include "scene/bsdfs/bsdf_plugin.h"

namespace quasilux {

/// Their parameters, each with the name of its own; those that only one of them has are 0 for the other.
struct Principled {
    Reflectance base{Rgb{0.5f, 0.5f, 0.5f}};
    double roughness = 0.5, anisotropic = 0, metallic = 0, specTrans = 0, specTint = 0, sheen = 0, sheenTint = 0,
           flatness = 0, clearcoat = 0, clearcoatGloss = 0;
    double eta = 1.5;
    std::optional<unsigned> alphaTextureU,
        alphaTextureV; ///< of facets, where the roughness is a texture; `roughness` is its mean then

    double dielectric() const { return 1 - metallic; }
    bool textured() const { return base.texture != 0; }
    double alphaU() const;
    double alphaV() const;
    /// The base colour at luminance 1; white where it is black.
    Rgb tint() const;
    /// alphaV over alphaU is the square of it.
    double aspect() const;
};

/// Those that both have, but for the index and the roughness.
Principled readSharedParameters(Properties& properties);
/// `roughness`, a number or a texture.
void readPrincipledRoughness(Properties& properties, Principled& p);
/// `eta`, an index of at least 1.
double readPrincipledIndex(Properties& properties);
/// Throws InputError where `coloured`, a parameter or nullptr, needs one colour and the base has a texture.
void checkOneColor(const Principled& p, const char* coloured, Properties& properties);

Rgb grey(double value);
Rgb sum(Rgb a, Rgb b);

/// GGX facets of this type.
LobeDescription facets(const Principled& p, unsigned type, const Reflectance& reflectance);
/// Those whose reflectance goes by Schlick from `normal` at normal incidence to `grazing`.
LobeDescription schlick(const Principled& p, const Reflectance& scale, Rgb normal, Rgb grazing);
/// Diffuse reflection and sheen, times these shares.
void addDiffuse(const Principled& p, double diffuseShare, double sheenShare, std::vector<LobeDescription>& lobes);

} // namespace quasilux
