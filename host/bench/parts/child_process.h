// This program once more, in a process and an environment of its own.
#pragma once

#include <string>
#include <utility>
#include <vector>

namespace quasilux {

/// What it writes to stdout. `environment` is set besides this process's own. Throws std::runtime_error where it
/// fails; what it then says on stderr is seen there.
std::string outputOfChild(const std::vector<std::string>& arguments,
                          const std::vector<std::pair<std::string, std::string>>& environment);

} // namespace quasilux
