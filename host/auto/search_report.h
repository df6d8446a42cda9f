// What a search tried, what it chose and why.
#pragma once

#include "auto/freedom.h"

#include <string>
#include <vector>

namespace quasilux {

/// One candidate and what became of it.
struct PilotRow {
    RenderSettings settings;
    unsigned photonsPerPass = 0, passes = 0;
    double secondsPerPass = 0, openingSeconds = 0;
    double predictedError = 0; ///< root of relMSE at the end, as predicted when it was judged
    std::string outcome;       ///< "chosen", "given up", or failedOutcome and why
};
inline constexpr const char* failedOutcome = "failed: ";

struct SearchReport {
    Freedom freedom;
    std::string notSearched;    ///< why; empty where candidates were sought
    std::vector<PilotRow> rows; ///< in the order of their pilots; the first one is where the search started
    size_t chosen = 0;          ///< row
    unsigned passes = 0;        ///< of all candidates
    double seconds = 0;         ///< on the clock, for opening candidates and for their passes
    double horizon = 0;         ///< seconds for which errors were predicted
    bool outOfTime = false;     ///< candidates were left when the pilots' share of the time was used up
    bool interrupted = false;   ///< before anything could be chosen

    /// "auto: BDD 0, main, …: predicted 1.2 % after 30 s (…)".
    std::string line() const;
};

} // namespace quasilux
