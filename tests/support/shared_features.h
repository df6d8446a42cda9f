// What kernels of many tests are compiled for, beside the features of their scene: one program then serves all scenes
// that need no more, of all tests in a run, as PoCL keeps it in a cache. To compile a program takes 3 s of a core, for
// these features 4; a render takes up to a quarter longer. generic_kernels_test holds that images stay the same. What is
// about the kernels of one scene, as what a feature costs or leaves out, does not use this.
#pragma once

#include "bsdf/lobe_list.h"
#include "prepare/features.h"
#include "shared_types.h"

#include <memory>

namespace quasilux::test {

/// Of surfaces, with all classes of photons that the settings leave to them.
inline std::shared_ptr<const Features> surfaceFeatures() {
    static const auto shared = [] {
        Features some;
        some.lobes = {LOBE_LAMBERT,    LOBE_BECKMANN,       LOBE_PHONG,         LOBE_GGX,     LOBE_CONDUCTOR,
                      LOBE_DIELECTRIC, LOBE_THINDIELECTRIC, LOBE_GGXDIELECTRIC, LOBE_PASSAGE, LOBE_BECKMANNDIELECTRIC,
                      LOBE_PANE};
        some.emitterTypes = {EMITTER_RECTANGLE, EMITTER_TRIANGLES,   EMITTER_SPHERE,
                             EMITTER_POINT,     EMITTER_DIRECTIONAL, EMITTER_CONSTANT};
        for (const auto ability :
             {&Features::spheres, &Features::nullPrimitives, &Features::cornerNormals, &Features::borders,
              &Features::depthLimit, &Features::orthographicCamera, &Features::textures, &Features::lobeWeights,
              &Features::sharingLambert, &Features::genuineDiffuse, &Features::quasiSpecular, &Features::specular})
            some.*ability = true;
        return std::make_shared<const Features>(some);
    }();
    return shared;
}

/// Of homogeneous grey media and what stands about them. Colours would cost a fifth of the time of all; emitters that
/// shine into media change the estimate.
inline std::shared_ptr<const Features> mediumFeatures() {
    static const auto shared = [] {
        Features some;
        some.lobes = {LOBE_LAMBERT, LOBE_BECKMANN, LOBE_CONDUCTOR, LOBE_DIELECTRIC};
        some.emitterTypes = {EMITTER_RECTANGLE, EMITTER_POINT, EMITTER_DIRECTIONAL, EMITTER_CONSTANT};
        some.phases = {PHASE_ISOTROPIC, PHASE_HG, PHASE_RAYLEIGH};
        for (const auto ability : {&Features::media, &Features::spheres, &Features::nullPrimitives, &Features::borders,
                                   &Features::orthographicCamera, &Features::sharingLambert, &Features::genuineDiffuse,
                                   &Features::quasiSpecular, &Features::specular, &Features::genuineDiffuseMedia,
                                   &Features::quasiSpecularMedia})
            some.*ability = true;
        return std::make_shared<const Features>(some);
    }();
    return shared;
}

/// Of either.
inline std::shared_ptr<const Features> sharedFeatures(const Scene& scene) {
    return scene.media.empty() ? surfaceFeatures() : mediumFeatures();
}

} // namespace quasilux::test
