// Prints what is found as lines or as JSON.
#include "cli/commands.h"

#include "cli/doctor_checks.h"

#include <algorithm>
#include <fmt/format.h>
#include <iterator>
#include <nlohmann/json.hpp>

namespace quasilux {

namespace {

std::vector<Finding> allFindings() {
    std::vector<Finding> findings{{Health::good, "quasilux", QUASILUX_VERSION, ""}};
    const auto add = [&](std::vector<Finding> more) {
        std::move(more.begin(), more.end(), std::back_inserter(findings));
    };
    add(checkDevices());
    add({checkKernelCache()});
    add(checkLibraries());
    add(checkMemory());
    add({checkTemporaryFolder()});
    return findings;
}

const char* name(Health health) {
    return health == Health::good ? "ok" : health == Health::warning ? "warning" : "problem";
}

} // namespace

int doctorCommand(bool json) {
    const std::vector<Finding> findings = allFindings();
    const auto count = [&](Health health) {
        return std::count_if(findings.begin(), findings.end(), [&](const auto& one) { return one.health == health; });
    };
    const auto problems = count(Health::problem), warnings = count(Health::warning);
    if (json) {
        nlohmann::json rows = nlohmann::json::array();
        for (const Finding& one : findings)
            rows.push_back(
                {{"state", name(one.health)}, {"what", one.what}, {"found", one.found}, {"advice", one.advice}});
        fmt::print("{}\n", rows.dump(2, ' ', false, nlohmann::json::error_handler_t::replace));
    } else {
        for (const Finding& one : findings) {
            fmt::print("{:<8} {}: {}\n", name(one.health), one.what, one.found);
            if (!one.advice.empty()) fmt::print("         {}\n", one.advice);
        }
        fmt::print("{} {}, {} {}\n", problems, problems == 1 ? "problem" : "problems", warnings,
                   warnings == 1 ? "warning" : "warnings");
    }
    return problems > 0 ? 1 : 0;
}

} // namespace quasilux
