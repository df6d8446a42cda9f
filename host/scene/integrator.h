// <integrator>: what light it leaves out.
#pragma once

#include "scene/load_context.h"
#include "scene/xml/names.h"

namespace quasilux {

struct IntegratorChoice {
    int maxDepth = -1;          ///< most segments of a path from light to camera, -1 for no limit
    bool hidesEmitters = false; ///< from the camera; where an integrator does not say so, the one nested in it does
    /// What passes straight through a surface (`null`, `mask`, thin panes) begins a segment: not in integrators of
    /// volumes.
    bool countsPassages = true;
    /// Surroundings stay hidden behind such passages, and shapes where the path may not go on from them.
    bool hidesBeyondPassages = true;
};

/// One letter for each channel of a layer.
std::string_view aovChannels(AovQuantity quantity);

/// Throws InputError for unknown plugins and parameters, and for plugins that mean another image.
IntegratorChoice readIntegrator(const Element& element, LoadContext& context);

Names integratorPluginNames();

} // namespace quasilux
