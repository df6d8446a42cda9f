// A typical lobe, emitter and phase function of every kind.
#pragma once

#include "prepare/environment.h"

#include <string>
#include <vector>

namespace quasilux {

template <typename T>
struct SamplerSubject {
    std::string name, options; ///< options that compile this kind alone
    T value;
    bool hasValues = true; ///< it can be evaluated, since it is not delta
};

std::vector<SamplerSubject<shared::Lobe>> lobeSubjects();
/// They shine on what lies below z = 0. A mesh's triangle is that of emitterTriangle(), an environment map's tables those of
/// emitterEnvironment().
std::vector<SamplerSubject<shared::Emitter>> emitterSubjects();
shared::EmitterTriangle emitterTriangle();
EnvironmentTable emitterEnvironment();
std::vector<SamplerSubject<shared::Medium>> phaseSubjects();

} // namespace quasilux
