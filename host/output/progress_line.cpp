// Text of the progress line and when to redraw it.
#include "output/progress_line.h"

#include "util/messages.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <sys/ioctl.h>
#include <unistd.h>
#include <utility>

namespace quasilux {

namespace {

std::string rateText(double perSecond) {
    if (perSecond >= 1e6) return fmt::format("{:.2f} M", perSecond / 1e6);
    if (perSecond >= 1e3) return fmt::format("{:.0f} k", perSecond / 1e3);
    return fmt::format("{:.0f}", perSecond);
}

std::string clockText(double seconds) {
    const auto whole = static_cast<long long>(std::ceil(seconds));
    if (whole >= 3600) return fmt::format("{}:{:02}:{:02}", whole / 3600, whole / 60 % 60, whole % 60);
    return fmt::format("{}:{:02}", whole / 60, whole % 60);
}

/// A line that wraps could not be redrawn in place.
size_t terminalColumns(std::FILE* stream) {
    winsize size{};
    return ioctl(fileno(stream), TIOCGWINSZ, &size) == 0 && size.ws_col > 0 ? size.ws_col : 80;
}

} // namespace

std::string progressText(const Progress& progress) {
    std::string text = progress.phase;
    const char* separator = ": ";
    const auto add = [&](const std::string& part) {
        text += separator + part;
        separator = ", ";
    };
    if (progress.passes > 0) add(fmt::format("pass {}", progress.passes));
    if (progress.photonsPerSecond > 0) add(rateText(progress.photonsPerSecond) + " photons/s");
    if (progress.pathsPerSecond > 0) add(rateText(progress.pathsPerSecond) + " paths/s");
    if (progress.relativeError >= 0 && std::isfinite(progress.relativeError))
        add(fmt::format("error {:.2f} %", 100 * progress.relativeError));
    if (progress.secondsLeft >= 0 && std::isfinite(progress.secondsLeft))
        add(clockText(progress.secondsLeft) + " left");
    return text;
}

ProgressLine::ProgressLine(std::FILE* stream, bool enabled, std::string label, std::chrono::milliseconds betweenLines)
    : stream_(stream), enabled_(enabled), isTerminal_(isatty(fileno(stream)) == 1), label_(std::move(label)),
      betweenLines_(betweenLines), nextLine_(begun_ + betweenLines) {}

ProgressLine::~ProgressLine() { clear(); }

void ProgressLine::update(const Progress& progress) {
    if (!enabled_) return;
    if (isTerminal_)
        redraw(progress, Clock::now());
    else
        append(progress, Clock::now());
}

void ProgressLine::append(const Progress& progress, Clock::time_point now) {
    if (now < nextLine_) return;
    printTo(stream_, fmt::format("quasilux: {}{}\n", label_, progressText(progress)));
    nextLine_ = now + std::max<Clock::duration>(betweenLines_, (now - begun_) / 10);
}

void ProgressLine::redraw(const Progress& progress, Clock::time_point now) {
    using namespace std::chrono_literals;
    if (drawn_ && progress.phase == phase_ && now - last_ < 500ms) return;
    const std::string text = label_ + progressText(progress);
    printTo(stream_, fmt::format("\r{}\033[K", text.substr(0, terminalColumns(stream_) - 1)));
    drawn_ = true;
    phase_ = progress.phase;
    last_ = now;
}

void ProgressLine::clear() {
    if (!drawn_) return;
    printTo(stream_, "\r\033[K");
    drawn_ = false;
}

} // namespace quasilux
