// One line on the terminal that says how far the render is.
#pragma once

#include "render/renderer.h"

#include <chrono>
#include <cstdio>
#include <string>

namespace quasilux {

/// Such as "rendering: pass 12, 1.25 M photons/s, 310 k paths/s, error 2.31 %, 0:24 left"; unknown values are left out.
std::string progressText(const Progress& progress);

/// Redraws the line at most every 0.5 s; a new phase is shown at once. Clears it at the end of the scope.
class ProgressLine {
public:
    /// Draws only if `enabled` and `stream` is a terminal.
    ProgressLine(std::FILE* stream, bool enabled);
    ~ProgressLine();
    ProgressLine(const ProgressLine&) = delete;
    ProgressLine& operator=(const ProgressLine&) = delete;

    void update(const Progress& progress);
    /// Removes the line, so that other messages start on an empty one.
    void clear();

private:
    std::FILE* stream_;
    bool enabled_;
    bool drawn_ = false;
    std::string phase_;
    std::chrono::steady_clock::time_point last_;
};

} // namespace quasilux
