// What the program says on stderr beside its results: one line each.
#pragma once

#include <string>

namespace quasilux {

/// "quasilux: error: …". On a terminal the word is coloured, unless the environment has NO_COLOR (https://no-color.org).
void printError(const std::string& message);
/// "quasilux: warning: …"
void printWarning(const std::string& message);

} // namespace quasilux
