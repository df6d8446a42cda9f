// How direct light is to be taken, from what importance paths saw of the emitters (docs/method/learning.md).
#pragma once

#include "prepare/device_scene.h"

#include <vector>

namespace quasilux {

/// Direct light that one importance path found where the camera takes it, or at later events, where paths that follow
/// everything take it.
struct DirectFind {
    unsigned emitter = QL_NONE; ///< QL_NONE: none
    unsigned pixel = 0;
    double value = 0;         ///< relative to the brightness of its part of the image
    double probability = 1;   ///< with which the emitter was chosen
    double gatheredShare = 1; ///< of the value, what photons might bring instead
};

struct DirectChoice {
    /// By emitter: its light is taken from photons where it is genuinely diffusely reflected. True where samples of it
    /// mostly find it hidden.
    std::vector<bool> byPhotons;
    /// As LearnedTables; empty where there is at most one emitter to sample.
    std::vector<shared::LightChoice> lights, laterLights;
    unsigned lightBlockSize = 1;
};

/// `finds`, `later`: one for each importance path, in the same order. `mayUsePhotons`: or else none is taken from
/// photons.
DirectChoice chooseDirect(const std::vector<DirectFind>& finds, const std::vector<DirectFind>& later,
                          const EmitterTables& emitters, const shared::Camera& camera, bool mayUsePhotons);

} // namespace quasilux
