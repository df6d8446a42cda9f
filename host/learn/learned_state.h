// What was learned, to be kept and taken up again: the same bits.
#pragma once

#include "learn/learning.h"
#include "util/state_archive.h"

namespace quasilux {

void saveLearned(StateSink& sink, const LearnedScene& learned);
/// Throws InputError.
LearnedScene restoreLearned(const StateSource& source);

} // namespace quasilux
