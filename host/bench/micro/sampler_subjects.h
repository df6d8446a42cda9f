// A typical lobe, emitter and phase function of every kind.
#pragma once

#include "shared_types.h"

#include <cstdint>
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
/// They shine on what lies below z = 0. A mesh's triangle is that of emitterTriangle(), the tables of a map or a
/// luminaire those of emitterTables().
std::vector<SamplerSubject<shared::Emitter>> emitterSubjects();
shared::EmitterTriangle emitterTriangle();
/// What an emitter of this type reads beside its record; of most a single word.
std::vector<uint32_t> emitterTables(unsigned type);
std::vector<SamplerSubject<shared::Medium>> phaseSubjects();

} // namespace quasilux
