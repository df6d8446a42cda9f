// A scene as the parts of a benchmark get it: loaded, and as another process can load it again
// (docs/reference/benchmarks.md, "Parts").
#pragma once

#include "bench/pass_times.h"

#include <functional>
#include <string>
#include <utility>
#include <vector>

namespace quasilux {

struct PartScene {
    std::string path;
    std::vector<std::string> definitions; ///< "name=value", as -D takes them
    const Scene* scene = nullptr;
};

/// Called before each step of a part, for the progress line.
using OnStep = std::function<void(const std::string&)>;

/// measurePass of the scene as it is on this device (-1: the default one), in a process of its own with these
/// variables besides its environment.
PassMeasurement measureInChild(const PartScene& scene, int device, double seconds,
                               const std::vector<std::pair<std::string, std::string>>& environment);

} // namespace quasilux
