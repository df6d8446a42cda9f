#include "render/stop_rule.h"

#include <algorithm>

namespace quasilux {

StopRule withDefault(StopRule stop) {
    if (!stop.seconds && !stop.passes && !stop.relativeError) stop.seconds = defaultSeconds;
    return stop;
}

bool isErrorDue(double sinceLast, double costOfLast) { return sinceLast > std::max(1.0, 50 * costOfLast); }

double secondsLeft(const StopRule& stop, const Progress& now) {
    double left = -1;
    const auto earlier = [&](double candidate) { left = left < 0 ? candidate : std::min(left, candidate); };
    if (stop.seconds) earlier(*stop.seconds - now.seconds);
    if (stop.passes && now.passes > 0)
        earlier(now.seconds / now.passes * std::max(0.0, double(*stop.passes) - stop.firstPass - now.passes));
    // The standard error falls with the square root of the passes.
    if (stop.relativeError && now.relativeError > 0) {
        const double factor = now.relativeError / *stop.relativeError;
        earlier(now.seconds * std::max(0.0, factor * factor - 1));
    }
    return left;
}

} // namespace quasilux
