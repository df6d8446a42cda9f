// Complex indices of refraction of metals.
#include "scene/bsdfs/bsdf_plugin.h"

#include <fmt/format.h>

namespace quasilux {

namespace {

struct Metal {
    std::string_view name;
    Rgb eta, k; ///< linear sRGB
};

/// Mitsuba 3.9's named materials as its RGB mode has them: projections of measured spectra, negative channels cut.
constexpr Metal metals[] = {
    {"a-C", {2.94405f, 2.22714f, 1.96816f}, {0.887465f, 0.799299f, 0.81529f}},
    {"Ag", {0.155276f, 0.116728f, 0.138388f}, {4.82835f, 3.12222f, 2.1469f}},
    {"Al", {1.6575f, 0.880405f, 0.521244f}, {9.22381f, 6.2695f, 4.837f}},
    {"AlAs", {3.6053f, 3.23294f, 2.21632f}, {0.000679437f, 0, 0.00751271f}},
    {"AlAs_palik", {3.6053f, 3.23294f, 2.21632f}, {0.000679437f, 0, 0.00751271f}},
    {"AlSb", {0, 4.13937f, 4.66925f}, {0, 0.0940091f, 1.30057f}},
    {"AlSb_palik", {0, 4.13937f, 4.66925f}, {0, 0.0940091f, 1.30057f}},
    {"Au", {0.143036f, 0.375307f, 1.44205f}, {3.983f, 2.38556f, 1.60336f}},
    {"Be", {4.18501f, 3.18503f, 2.78406f}, {3.83547f, 3.01012f, 2.86899f}},
    {"Be_palik", {4.18501f, 3.18503f, 2.78406f}, {3.83547f, 3.01012f, 2.86899f}},
    {"Cr", {4.36967f, 2.91651f, 1.6549f}, {5.20655f, 4.23131f, 3.7547f}},
    {"CsI", {2.1449f, 1.70232f, 1.66243f}, {0, 0, 0}},
    {"CsI_palik", {2.1449f, 1.70232f, 1.66243f}, {0, 0, 0}},
    {"Cu", {0.201005f, 0.92375f, 1.10222f}, {3.91326f, 2.45305f, 2.14209f}},
    {"Cu2O", {3.55177f, 2.94987f, 2.75188f}, {0.114207f, 0.193897f, 0.606134f}},
    {"Cu2O_palik", {3.55177f, 2.94987f, 2.75188f}, {0.114207f, 0.193897f, 0.606134f}},
    {"CuO", {3.24754f, 2.44781f, 2.21022f}, {0.52109f, 0.570031f, 0.722179f}},
    {"CuO_palik", {3.24754f, 2.44781f, 2.21022f}, {0.52109f, 0.570031f, 0.722179f}},
    {"Cu_palik", {0.213229f, 0.919715f, 1.10241f}, {3.92187f, 2.45733f, 2.13658f}},
    {"d-C", {2.70872f, 2.31883f, 2.2289f}, {0, 0, 0}},
    {"d-C_palik", {2.70872f, 2.31883f, 2.2289f}, {0, 0, 0}},
    {"Hg", {2.39894f, 1.44003f, 0.90957f}, {6.32759f, 4.37192f, 3.42176f}},
    {"HgTe", {4.77904f, 3.2312f, 2.6599f}, {1.63161f, 1.58081f, 1.72929f}},
    {"HgTe_palik", {4.77904f, 3.2312f, 2.6599f}, {1.63161f, 1.58081f, 1.72929f}},
    {"Hg_palik", {2.39894f, 1.44003f, 0.90957f}, {6.32759f, 4.37192f, 3.42176f}},
    {"Ir", {3.0863f, 2.08219f, 1.61791f}, {5.59215f, 4.06709f, 3.26731f}},
    {"Ir_palik", {3.0863f, 2.08219f, 1.61791f}, {5.59215f, 4.06709f, 3.26731f}},
    {"K", {0.0640432f, 0.0464098f, 0.0381849f}, {2.1042f, 1.34894f, 0.913126f}},
    {"K_palik", {0.0640432f, 0.0464098f, 0.0381849f}, {2.1042f, 1.34894f, 0.913126f}},
    {"Li", {0.265791f, 0.195618f, 0.220949f}, {3.54015f, 2.31112f, 1.66861f}},
    {"Li_palik", {0.265791f, 0.195618f, 0.220949f}, {3.54015f, 2.31112f, 1.66861f}},
    {"MgO", {2.08958f, 1.65072f, 1.59488f}, {4.3327e-12f, 0, 2.49865e-11f}},
    {"MgO_palik", {2.08958f, 1.65072f, 1.59488f}, {4.3327e-12f, 0, 2.49865e-11f}},
    {"Mo", {4.48397f, 3.52513f, 2.77631f}, {4.11144f, 3.42083f, 3.15061f}},
    {"Mo_palik", {4.48397f, 3.52513f, 2.77631f}, {4.11144f, 3.42083f, 3.15061f}},
    {"Na_palik", {0.0602694f, 0.0561409f, 0.0619884f}, {3.17927f, 2.11249f, 1.57904f}},
    {"Nb", {3.42007f, 2.79009f, 2.39563f}, {3.44139f, 2.73767f, 2.57975f}},
    {"Nb_palik", {3.42007f, 2.79009f, 2.39563f}, {3.44139f, 2.73767f, 2.57975f}},
    {"Ni_palik", {2.3673f, 1.66337f, 1.46708f}, {4.49881f, 3.05015f, 2.34544f}},
    {"Rh", {2.58579f, 1.86022f, 1.55426f}, {6.78226f, 4.70299f, 3.97607f}},
    {"Rh_palik", {2.58579f, 1.86022f, 1.55426f}, {6.78226f, 4.70299f, 3.97607f}},
    {"Se", {4.05831f, 2.84294f, 2.82085f}, {0.75405f, 0.638444f, 0.521808f}},
    {"Se-e", {5.72285f, 4.16574f, 4.08134f}, {0.871136f, 1.10516f, 1.56532f}},
    {"Se-e_palik", {5.72285f, 4.16574f, 4.08134f}, {0.871136f, 1.10516f, 1.56532f}},
    {"Se_palik", {4.05831f, 2.84294f, 2.82085f}, {0.75405f, 0.638444f, 0.521808f}},
    {"SiC", {3.17234f, 2.52597f, 2.47937f}, {7.53766e-07f, 0, 1.01925e-05f}},
    {"SiC_palik", {3.17234f, 2.52597f, 2.47937f}, {7.53766e-07f, 0, 1.01925e-05f}},
    {"SnTe", {4.52425f, 1.98164f, 1.28159f}, {0, 0, 0}},
    {"SnTe_palik", {4.52425f, 1.98164f, 1.28159f}, {0, 0, 0}},
    {"Ta", {2.06272f, 2.39294f, 2.62793f}, {2.40836f, 1.74149f, 1.94703f}},
    {"Ta_palik", {2.06272f, 2.39294f, 2.62793f}, {2.40836f, 1.74149f, 1.94703f}},
    {"Te", {7.39023f, 4.4821f, 2.63711f}, {3.25602f, 3.52706f, 3.29205f}},
    {"Te-e", {7.50891f, 4.29643f, 2.36999f}, {5.58393f, 4.94721f, 3.99759f}},
    {"Te-e_palik", {7.50891f, 4.29643f, 2.36999f}, {5.58393f, 4.94721f, 3.99759f}},
    {"Te_palik", {7.39023f, 4.4821f, 2.63711f}, {3.25602f, 3.52706f, 3.29205f}},
    {"ThF4", {1.83071f, 1.44223f, 1.38765f}, {0, 0, 0}},
    {"ThF4_palik", {1.83071f, 1.44223f, 1.38765f}, {0, 0, 0}},
    {"TiC", {3.70053f, 2.83742f, 2.58229f}, {3.26564f, 2.35159f, 2.17279f}},
    {"TiC_palik", {3.70053f, 2.83742f, 2.58229f}, {3.26564f, 2.35159f, 2.17279f}},
    {"TiN", {1.64845f, 1.15052f, 1.37982f}, {3.36833f, 1.9435f, 1.10207f}},
    {"TiN_palik", {1.64845f, 1.15052f, 1.37982f}, {3.36833f, 1.9435f, 1.10207f}},
    {"TiO2", {3.45661f, 2.80174f, 2.90517f}, {0.000105265f, 0, 0.000652887f}},
    {"TiO2-e", {3.10656f, 2.51317f, 2.58244f}, {2.97516e-05f, 0, 0.000182698f}},
    {"TiO2-e_palik", {3.10656f, 2.51317f, 2.58244f}, {2.97516e-05f, 0, 0.000182698f}},
    {"TiO2_palik", {3.45661f, 2.80174f, 2.90517f}, {0.000105265f, 0, 0.000652887f}},
    {"VC", {3.65757f, 2.75274f, 2.53267f}, {3.0683f, 2.19869f, 1.96319f}},
    {"VC_palik", {3.65757f, 2.75274f, 2.53267f}, {3.0683f, 2.19869f, 1.96319f}},
    {"VN", {2.8656f, 2.11919f, 1.94009f}, {3.03224f, 2.05612f, 1.61631f}},
    {"VN_palik", {2.8656f, 2.11919f, 1.94009f}, {3.03224f, 2.05612f, 1.61631f}},
    {"V_palik", {4.27758f, 3.51295f, 2.76107f}, {3.4913f, 2.88945f, 3.11152f}},
    {"W", {4.37082f, 3.30025f, 2.99841f}, {3.50064f, 2.60487f, 2.27323f}},
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

/// Fits to measured spectra, converted to RGB, may have a channel below 0, which Mitsuba takes as it is.
Reflectance readIndex(Properties& properties, const std::string& name, Rgb missing) {
    if (properties.texture(name)) return readReflectance(properties, name, 0, TextureUse::index);
    const Rgb given = properties.unboundedColor(name, missing);
    if (smallest(given) < 0)
        properties.context().warn(properties.where(name),
                                  fmt::format("parameter '{}' of {} has a negative channel, which is taken as 0.", name,
                                              properties.describe()));
    return Rgb{std::max(given.r, 0.f), std::max(given.g, 0.f), std::max(given.b, 0.f)};
}

} // namespace

void readConductorIndex(Properties& properties, shared::Lobe& lobe) {
    const auto isGiven = [&](const std::string& name) { return properties.has(name) || properties.texture(name); };
    const bool measured = isGiven("eta") || isGiven("k");
    const std::string material = properties.string("material", "none");
    if (measured && material != "none")
        throw InputError(properties.where("material"),
                         fmt::format("{} has both material and eta or k; keep one.", properties.describe()));
    const Reflectance eta = readIndex(properties, "eta", {0, 0, 0}), k = readIndex(properties, "k", {1, 1, 1});
    lobe.eta = eta.scale;
    lobe.etaTexture = eta.texture;
    lobe.k = k.scale;
    lobe.kTexture = k.texture;
    if (material != "none") {
        const Metal& metal = findMetal(material, properties.where("material"));
        lobe.eta = metal.eta;
        lobe.k = metal.k;
    }
    if (eta.texture > 0 || k.texture > 0) return; // kernels/surface.clh sees where both are 0
    // Where both are 0 everything is reflected, as where k alone is not; but at normal incidence Fresnel has 0 / 0.
    const auto notBothZero = [](float n, float absorption) { return n == 0 && absorption == 0 ? 1.0f : absorption; };
    lobe.k = {notBothZero(lobe.eta.r, lobe.k.r), notBothZero(lobe.eta.g, lobe.k.g), notBothZero(lobe.eta.b, lobe.k.b)};
}

} // namespace quasilux
