#include "auto/search_report.h"

#include "auto/candidates.h"

#include <fmt/format.h>

namespace quasilux {

std::string SearchReport::line() const {
    if (!notSearched.empty()) return "auto: nothing searched: " + notSearched;
    if (!freedom.any()) return "auto: nothing searched: all is given";
    const PilotRow& row = rows.at(chosen);
    std::string line = "auto: " + text(row.settings, row.photonsPerPass);
    const auto count = fmt::format("{} {}, {} passes, {:.1f} s", rows.size(),
                                   rows.size() == 1 ? "candidate" : "candidates", passes, seconds);
    if (!(row.predictedError > 0)) return line + " (" + count + ": no time to try others)";
    line += fmt::format(": predicted {:.3g} % after {:.3g} s (", 100 * row.predictedError, horizon);
    if (chosen != 0) line += fmt::format("start: {:.3g} %; ", 100 * rows.front().predictedError);
    return line + count + (outOfTime ? ", then the time for pilots was up" : "") + ")";
}

} // namespace quasilux
