// How much of a kernel's work goes into one launch, so that none lasts long: a display driver ends a kernel that runs
// for some two seconds. Knows no device.
#pragma once

#include <algorithm>
#include <cstddef>

namespace quasilux {

/// Launches are to take no longer than this, as far as work-items take as long as those before.
inline constexpr double longestLaunchSeconds = 0.5;

class LaunchPace {
public:
    /// `first`: work-items of the first launch, of which nothing is known; 0: all of them. On CPUs no driver ends it,
    /// and PoCL would compile the kernel once more for a launch that begins elsewhere than at 0.
    explicit LaunchPace(size_t first = 0) : first_(first) {}

    /// A launch of `items` took so long.
    void note(size_t items, double seconds) {
        if (items > 0 && seconds > 0) secondsPerItem_ = seconds / static_cast<double>(items);
    }

    double secondsPerItem() const { return secondsPerItem_; }

    /// Work-items to come have nothing to do with those before.
    void forget() { secondsPerItem_ = 0; }

    /// Work-items of the next launch, whole groups, where `left` are left.
    size_t next(size_t left, size_t group, double longest = longestLaunchSeconds) const {
        size_t items = secondsPerItem_ > 0 ? static_cast<size_t>(std::min(longest / secondsPerItem_, 1e18))
                       : first_ > 0        ? first_
                                           : left;
        items = std::max<size_t>(items / group, 1) * group;
        return std::min(items, left);
    }

private:
    size_t first_;
    double secondsPerItem_ = 0; ///< of the last launch
};

} // namespace quasilux
