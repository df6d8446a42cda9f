// How often pictures of a render that goes on are made, and of how many of the film's pixels. Knows neither.
#pragma once

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cstddef>
#include <cstdint>

namespace quasilux {

/// Pictures come no more often than this, and take at most this share of the render's time.
inline constexpr double secondsBetweenFrames = 0.25, mostOfTime = 0.03;

class FramePace {
public:
    using Clock = std::chrono::steady_clock;

    /// A picture of a render, begun at `start`, is made: so many pixels were read. Called by one thread at a time.
    void note(uint64_t render, size_t pixels, Clock::time_point start, Clock::time_point end) {
        // The very first one has compiled its kernel.
        const double cost = render_ == 0 ? 0 : std::chrono::duration<double>(end - start).count();
        if (cost > 0 && pixels > 0) {
            const double now = cost / static_cast<double>(pixels), before = secondsPerPixel_;
            secondsPerPixel_ = before > 0 ? before + ofNewest * (now - before) : now;
        }
        const std::chrono::duration<double> pause(std::max(secondsBetweenFrames, cost / mostOfTime));
        next_ = start.time_since_epoch() + std::chrono::duration_cast<Clock::duration>(pause);
        render_ = render;
    }

    /// When the next picture may be made. The first one of a render is not put off.
    Clock::time_point next(uint64_t render) const {
        return render_ == render ? Clock::time_point(next_.load()) : Clock::time_point{};
    }

    /// So many pixels may be read for a picture that need not wait longer than the shortest pause.
    size_t mostPixels() const {
        const double cost = secondsPerPixel_;
        if (!(cost > 0)) return largest;
        return std::clamp(static_cast<size_t>(std::min(secondsBetweenFrames * mostOfTime / cost, 1e18)), smallest,
                          largest);
    }

private:
    static constexpr size_t smallest = 1u << 16, largest = 1u << 20;
    static constexpr double ofNewest = 0.3; // of the mean of what pixels have cost

    std::atomic<Clock::duration> next_{}; ///< since the clock's epoch
    std::atomic<uint64_t> render_{0};     ///< which that was a picture of
    std::atomic<double> secondsPerPixel_{0};
};

} // namespace quasilux
