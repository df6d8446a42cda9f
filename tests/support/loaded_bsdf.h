// A bsdf as it is loaded from a scene file, and its colours.
#pragma once

#include "support/scene_files.h"

namespace quasilux::test {

inline Bsdf loadBsdf(const std::string& bsdf) {
    return loadBody("<shape type=\"rectangle\">" + bsdf + "</shape>").bsdfs.at(0);
}

inline void expectRgb(Rgb value, float r, float g, float b, float tolerance = 1e-6f) {
    expectNear({value.r, value.g, value.b}, {r, g, b}, tolerance);
}

} // namespace quasilux::test
