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
    std::string split; ///< all | level:NUMBER | none
    Variant variant = Variant::main;
    unsigned bdd = 0;
    DirectLight direct = DirectLight::emitters;
};

/// What a render says, with its standard error from `batches` independent batches of `passes`. In a wide tube little of
/// the light comes by way of its mirrors, which make photons of it; in a narrow one no photon is lost beside the image.
MeanAndError measureSlab(const Slab& slab, SlabSide side, const RenderSettings& settings, unsigned batches,
                         unsigned passes, bool wideTube = false);

RenderSettings settingsOf(const SlabMethod& method);

} // namespace quasilux
