// Which settings are left to a search (docs/method/auto.md).
#pragma once

#include "render/settings.h"

#include <string>

namespace quasilux {

/// What the user asked for on the command line.
enum class AutoMode {
    open, ///< search what neither the command line nor the scene says
    all,  ///< `--auto`: what the command line does not say; the scene's word is where the search starts
    off,  ///< `--fixed`
};

/// true: may be changed by the search.
struct Freedom {
    bool bdd = false, split = false, variant = false, photons = false, radius = false, cameraPaths = false,
         caustics = false, cameraSampling = false;

    bool any() const {
        return bdd || split || variant || photons || radius || cameraPaths || caustics || cameraSampling;
    }
};

/// What the scene leaves open in this mode; options of the command line close more.
Freedom freedomOf(const Scene& scene, AutoMode mode);

/// Why nothing can be searched for this sensor or these stop rules; empty if it can.
std::string whyNotSearched(const Scene& scene, const RenderSettings& settings, const StopRule& stop);

/// "BDD, split, radius", or "nothing".
std::string text(const Freedom& freedom);

} // namespace quasilux
