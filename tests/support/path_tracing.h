// Settings with which all light but that of lamps which no path can meet is found by camera paths: path tracing.
#pragma once

#include "render/settings.h"

namespace quasilux {

inline RenderSettings pathTracing() {
    RenderSettings settings;
    settings.quasiSpecular = "all";
    settings.quasiSpecularOverridesScene = true;
    settings.variant = Variant::alternative;
    settings.caustics = CausticLight::paths;
    settings.photonsPerPass = 4000;
    return settings;
}

} // namespace quasilux
