// Several renders at once, each in a process of its own: none can break another, and each is as it would be alone.
#pragma once

#include "cli/command_end.h"
#include "cli/options.h"

namespace quasilux {

/// At most `jobs` at a time. What each says on stdout and stderr is printed in one piece when it is done. A signal that
/// ends this program is handed on. No OpenCL call may come before it in this process. The ends, in the order of `all`;
/// after a signal those of scenes that had begun.
std::vector<CommandEnd> renderAtOnce(const std::vector<RenderOptions>& all, unsigned jobs);

} // namespace quasilux
