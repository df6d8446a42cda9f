// Ways to render that are compared.
#pragma once

#include "render/settings.h"

#include <string>
#include <vector>

namespace quasilux {

/// "scene": what the scene says, else the defaults. "standard", "main", "alternative": without quasi-specular lobes and
/// media, or with those that the scene or `auto` chooses, in that variant. Then, each after a colon: a number, the BDD;
/// "photons", direct light from photons; "camera", camera points stored; "generic", kernels with everything compiled;
/// "level=X", the split of phase functions.
struct BenchMethod {
    std::string name;

    /// Writes over what the scene says.
    void apply(RenderSettings& settings) const;
};

/// Throws InputError that says what was expected.
BenchMethod parseBenchMethod(const std::string& text);

std::vector<BenchMethod> defaultBenchMethods();

} // namespace quasilux
