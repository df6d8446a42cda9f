// Micro-benchmarks of single stages, each against the best native way to do the same (docs/reference/benchmarks.md).
#pragma once

#include "bench/micro/micro_report.h"

#include <atomic>
#include <functional>

namespace quasilux {

struct MicroSettings {
    int device = -1;
    std::vector<std::string> parts; ///< of microParts()
    unsigned rounds = 7;            ///< of which the best counts
    size_t rays = 1u << 19;         ///< of a set, at most
    unsigned sphereRings = 200;     ///< 80 k triangles
    size_t forestTriangles = 2000000;
    unsigned photons = 1u << 20, queries = 1u << 16;
    size_t samples = 1u << 19;
};

/// traversal, map, gather, samplers, tree.
const std::vector<std::string>& microParts();

/// "" or "all": every part; else names between commas. Throws InputError that says what was expected.
std::vector<std::string> parseMicroParts(const std::string& text);

using MicroProgress = std::function<void(const std::string&)>; ///< gets what is measured next

MicroReport runMicro(const MicroSettings& settings, const MicroProgress& progress,
                     const std::atomic<bool>& interrupted);

} // namespace quasilux
