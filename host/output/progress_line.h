// One line on the terminal that says how far the render is.
#pragma once

#include "render/renderer.h"

#include <chrono>
#include <cstdio>
#include <string>

namespace quasilux {

/// Such as "rendering: pass 12, 1.25 M photons/s, 310 k paths/s, error 2.31 %, 0:24 left"; unknown values are left out.
std::string progressText(const Progress& progress);

/// On a terminal the line is redrawn at most every 0.5 s, a new phase is shown at once, and it is cleared at the end of
/// the scope. Elsewhere, as in a log, lines follow each other: after `betweenLines`, and then whenever a tenth of the
/// time so far has passed again, though not sooner than that.
class ProgressLine {
public:
    /// Nothing is shown unless `enabled`. `label` goes before all it says.
    ProgressLine(std::FILE* stream, bool enabled, std::string label = "",
                 std::chrono::milliseconds betweenLines = std::chrono::seconds(10));
    ~ProgressLine();
    ProgressLine(const ProgressLine&) = delete;
    ProgressLine& operator=(const ProgressLine&) = delete;

    void update(const Progress& progress);
    /// Removes the line, so that other messages start on an empty one.
    void clear();

private:
    using Clock = std::chrono::steady_clock;
    void redraw(const Progress& progress, Clock::time_point now);
    void append(const Progress& progress, Clock::time_point now);

    std::FILE* stream_;
    bool enabled_, isTerminal_;
    bool drawn_ = false;
    std::string label_, phase_;
    std::chrono::milliseconds betweenLines_;
    Clock::time_point last_, begun_ = Clock::now(), nextLine_;
};

} // namespace quasilux
