// `quasilux manual FOLDER`: man pages and completions as files.
#pragma once

#include <CLI/CLI.hpp>
#include <string>

namespace quasilux {

/// Of `program`, into the folders below `folder` where systems look for them (as in /usr/share). Throws InputError, std::system_error.
void manualCommand(CLI::App& program, const std::string& folder);

} // namespace quasilux
