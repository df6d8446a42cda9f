// Lobes and directions that the lobe tests run over, and the kernels of tests/kernels/lobes.cl as functions.
#pragma once

#include "bsdf/lobe_list.h"
#include "shared_types.h"

#include <glm/glm.hpp>
#include <string>
#include <vector>

namespace quasilux {

/// Compiles every lobe.
#define QUASILUX_LOBE_OPTION(ID, argument) " -DHAS_LOBE_" #ID
inline const std::string allLobes = LOBE_LIST(QUASILUX_LOBE_OPTION, ) " -DHAS_LOW_COATS";
#undef QUASILUX_LOBE_OPTION

struct LobeCase {
    std::string name;
    shared::Lobe lobe;
};

/// Lambert, the same under a coat, Phong, GGX and Beckmann from broad to narrow, with reflectance 1 and Fresnel factor
/// 1.
std::vector<LobeCase> finiteLobes();

/// A lobe of this type with reflectance and transmittance 1 and Fresnel factor 1.
shared::Lobe makeLobe(unsigned type);

/// Rounded to float and back, so that kernel and test see the same direction; `cosine` to the normal, at an odd
/// azimuth.
glm::dvec3 outgoing(double cosine);

/// Outgoing cosines from normal to grazing incidence at which lobes are tested.
std::vector<double> outgoingCosines();

struct SampledDirection {
    glm::dvec3 wi, weight;
    double pdf;
    bool valid;
};
/// `numbers` holds uChoice, u.x, u.y per sample.
std::vector<SampledDirection> sampleLobe(const shared::Lobe& lobe, glm::dvec3 wo, const std::vector<float>& numbers,
                                         int transport = 0);

struct EvaluatedDirection {
    glm::dvec3 f;
    double pdf;
};
std::vector<EvaluatedDirection> evaluateLobe(const shared::Lobe& lobe, const std::vector<glm::dvec3>& wo,
                                             const std::vector<glm::dvec3>& wi, const std::string& options = allLobes);

std::vector<glm::dvec3> lobeAlbedos(const shared::Lobe& lobe, const std::vector<glm::dvec3>& wo);

} // namespace quasilux
