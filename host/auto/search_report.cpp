#include "auto/search_report.h"

#include "auto/candidates.h"

#include <algorithm>
#include <fmt/format.h>

namespace quasilux {

std::string SearchReport::line() const {
    if (!notSearched.empty()) return "auto: nothing searched: " + notSearched;
    if (!freedom.any()) return "auto: nothing searched: all settings are given";
    if (interrupted) return "auto: interrupted before settings were chosen";
    const PilotRow& row = rows.at(chosen);
    std::string line = "auto: " + text(row.settings, row.photonsPerPass);
    const auto failed = std::count_if(rows.begin(), rows.end(),
                                      [](const PilotRow& each) { return each.outcome.starts_with(failedOutcome); });
    if (!(row.predictedError > 0)) return line + ": no time to try other settings";
    line += fmt::format(": expected error {:.3g} % after {:.3g} s", 100 * row.predictedError, horizon);
    if (chosen != 0) line += fmt::format(" ({:.3g} % with the first settings)", 100 * rows.front().predictedError);
    return line + fmt::format("; tried {} {}{} in {:.1f} s ({} passes{})", rows.size(),
                              rows.size() == 1 ? "setting" : "settings",
                              failed > 0 ? fmt::format(" ({} failed)", failed) : "", seconds, passes,
                              outOfTime ? "; the search's time limit" : "");
}

} // namespace quasilux
