// The parts of `quasilux bench` besides error over time.
#pragma once

#include "bench/bench_section.h"
#include "cli/bench_attempt.h"
#include "cli/bench_options.h"
#include "scene/scene.h"

namespace quasilux {

/// Throws InputError where scenes or devices that the parts need are missing.
void checkParts(const BenchOptions& options);

/// Adds a section for each part that was asked for and can be measured. `scenes` are those of the options; -1 among
/// `devices` is the default one.
void runParts(const BenchOptions& options, const std::vector<Scene>& scenes, const std::vector<int>& devices,
              Attempts& attempts, std::vector<BenchSection>& sections);

} // namespace quasilux
