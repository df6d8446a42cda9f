// Turbid plates without lateral bounds (scenes/slab.xml), with what they reflect and transmit by other methods.
#pragma once

#include "support/render_statistics.h"

#include <string>
#include <vector>

namespace quasilux {

struct Slab {
    std::string name;
    double opticalDepth, albedo, g;
    bool glass;   ///< refractive index 1.5 instead of 1
    bool oblique; ///< light comes at 45 degrees instead of along the normal
    double reflectance, transmittance;
    double error; ///< of these two
};

/// All of them; the first ones are published or are the plate of the method's paper.
const std::vector<Slab>& slabs();
const Slab& slab(const std::string& name);

enum class SlabSide { reflectance, transmittance };

struct SlabMethod {
    std::string name;
    unsigned bdd = 0;
    Variant variant = Variant::main;
    std::string split = "all"; ///< all | level:NUMBER | none
};

/// What a render says, with its standard error from `batches` independent batches of `passes`.
MeanAndError measureSlab(const Slab& slab, SlabSide side, const RenderSettings& settings, unsigned batches,
                         unsigned passes);

RenderSettings settingsOf(const SlabMethod& method);

} // namespace quasilux
