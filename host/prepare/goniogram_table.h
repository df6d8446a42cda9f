// Luminaire types as the kernels take them: intensities, luminous shape, and the probabilities by which directions are
// sampled (kernels/emitters/goniogram.clh).
#pragma once

#include "scene/scene.h"

#include <cstdint>
#include <vector>

namespace quasilux {

/// Where the table of a type lies, and what its emitters need of it.
struct GoniogramKind {
    unsigned first = 0;   ///< word
    double lumens = 0;    ///< of the table's candela
    double spread = 0;    ///< radians: shared::Emitter::cutoffAngle of EMITTER_GONIOGRAM
    double radius = 0;    ///< of a sphere about the shape, scene units
    glm::dmat3 axes{1.0}; ///< of the table in the luminaire's frame
};

/// Appends the table of a type to `words`.
GoniogramKind addGoniogram(const LuminaireType& type, std::vector<uint32_t>& words);

} // namespace quasilux
