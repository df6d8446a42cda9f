// Lobes and directions that the lobe tests run over, and the kernels of tests/kernels/lobes.cl as functions.
#pragma once

#include "shared_types.h"

#include <glm/glm.hpp>
#include <string>
#include <vector>

namespace quasilux {

/// Compiles every lobe.
inline const std::string allLobes = "-DHAS_LOBE_LAMBERT -DHAS_LOBE_PHONG -DHAS_LOBE_GGX -DHAS_LOBE_BECKMANN "
                                    "-DHAS_LOBE_CONDUCTOR -DHAS_LOBE_DIELECTRIC -DHAS_LOBE_THINDIELECTRIC "
                                    "-DHAS_LOBE_GGXDIELECTRIC -DHAS_LOBE_BECKMANNDIELECTRIC "
                                    "-DHAS_LOBE_COATEDLAMBERT";

struct LobeCase {
    std::string name;
    shared::Lobe lobe;
};

/// Lambert, the same under a coat, Phong, GGX and Beckmann from broad to narrow, with reflectance 1 and Fresnel factor 1.
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
