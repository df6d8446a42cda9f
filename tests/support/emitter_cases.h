// Emitters of radiance 1 for tests, and the kernels of tests/kernels/emitters.cl as functions.
#pragma once

#include "prepare/environment.h"

#include <glm/glm.hpp>
#include <utility>
#include <vector>

namespace quasilux {

shared::Emitter makeRectangle(glm::dvec3 corner, glm::dvec3 edgeU, glm::dvec3 edgeV);
shared::Emitter makeSphere(glm::dvec3 centre, double radius, double normalSign);
shared::Emitter makePoint(glm::dvec3 position);
/// Angles in radians.
shared::Emitter makeSpot(glm::dvec3 position, glm::dvec3 axis, double beamAngle, double cutoffAngle);
/// Parallel light of irradiance 1 along `direction` onto a scene within this sphere.
shared::Emitter makeDirectional(glm::dvec3 direction, glm::dvec3 centre, double radius);
/// Surroundings of a scene within this sphere.
shared::Emitter makeConstant(glm::dvec3 centre, double radius);

/// With its tables; radiance is that of the image, the mean of it in the record.
std::pair<shared::Emitter, std::vector<uint32_t>> makeEnvmap(const EnvironmentImage& image, glm::dvec3 centre,
                                                             double radius);

struct TriangleSpec {
    glm::dvec3 p0, e1, e2;
};
std::pair<shared::Emitter, std::vector<shared::EmitterTriangle>> makeTriangles(const std::vector<TriangleSpec>& specs);

/// Kind 0: a square of side 0.5 at z = 1 that shines upwards; 1: a thin rectangle, rotated in space.
shared::Emitter testRectangle(int kind);
/// Sets probabilities of selection and their sums.
void setSelection(std::vector<shared::Emitter>& emitters, const std::vector<double>& probabilities);

struct EmitterMixture {
    std::vector<shared::Emitter> emitters;
    std::vector<shared::EmitterTriangle> triangles;
};
/// One emitter of each kind, chosen with unequal probabilities.
EmitterMixture mixedEmitters();

inline glm::dvec3 wide(const shared::Packed3& p) { return {p.x, p.y, p.z}; }

struct SampledEmitter {
    glm::dvec3 direction, radianceOverPdf;
    double distance, pdf;
    bool valid;
};
/// `numbers` holds uSelect, u.x, u.y per sample.
std::vector<SampledEmitter> sampleDirections(const std::vector<shared::Emitter>& emitters,
                                             const std::vector<shared::EmitterTriangle>& triangles, glm::dvec3 from,
                                             const std::vector<float>& numbers,
                                             const std::vector<uint32_t>& environment = {});

/// emitterPdfSolidAngle of emitter `index` for points on it with their normals.
std::vector<double> directionPdfs(const std::vector<shared::Emitter>& emitters, unsigned index, glm::dvec3 from,
                                  const std::vector<glm::dvec3>& points, const std::vector<glm::dvec3>& normals,
                                  const std::vector<uint32_t>& environment = {});

struct EmittedParticle {
    glm::dvec3 position, direction, normal, flux;
    unsigned emitter;
};
/// `numbers` holds uSelect, uPosition and uDirection per photon.
std::vector<EmittedParticle> samplePhotons(const std::vector<shared::Emitter>& emitters,
                                           const std::vector<shared::EmitterTriangle>& triangles,
                                           const std::vector<float>& numbers,
                                           const std::vector<uint32_t>& environment = {});

/// emitterRadiance against each direction.
std::vector<glm::dvec3> radiances(const shared::Emitter& emitter, const std::vector<glm::dvec3>& directions,
                                  const std::vector<uint32_t>& environment = {});
/// What emitterInvertEmission gives of the photons that samplePhotons makes of these numbers.
std::vector<float> invertedNumbers(const shared::Emitter& emitter, const std::vector<float>& numbers,
                                   const std::vector<uint32_t>& environment = {});

} // namespace quasilux
