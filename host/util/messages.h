// What the program says on stderr beside its results: one line each.
#pragma once

#include <cstdio>
#include <string>

namespace quasilux {

/// `text` as it is. What cannot be written, as on a full disk or to a pipe that nobody reads, is left out: no render
/// ends for it.
void printTo(std::FILE* stream, const std::string& text);
/// "quasilux: …"
void printNote(const std::string& message);
/// "quasilux: error: …". On a terminal the word is coloured, unless the environment has NO_COLOR
/// (https://no-color.org).
void printError(const std::string& message);
/// "quasilux: warning: …"
void printWarning(const std::string& message);

} // namespace quasilux
