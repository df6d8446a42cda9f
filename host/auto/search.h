// Pilot passes of all candidates; the worse half is given up again and again, and the last one left is chosen (docs/auto.md).
// Knows no device.
#pragma once

#include "auto/candidates.h"
#include "auto/pilot.h"
#include "auto/search_report.h"

#include <atomic>
#include <functional>
#include <memory>

namespace quasilux {

/// What the search needs of the world.
struct SearchWorld {
    std::function<std::unique_ptr<Pilot>(const RenderSettings&)> open;
    std::function<double()> clock;        ///< seconds since the render began
    std::function<void(unsigned)> onPass; ///< after each pass, how many there were; may be empty
    size_t mostOpen = 1000;               ///< pilots that memory holds at once
    /// Whether Ctrl-C was pressed.
    const std::atomic<bool>* interrupted = nullptr;
};

struct SearchResult {
    RenderSettings settings;
    SearchReport report;
    std::unique_ptr<Pilot> start; ///< as it was, where nothing was tried
};

/// Share of the render's time that goes to pilots, opening them included. All of it lost, error grows by 1 / sqrt(1 - 0.2) = 1.12.
inline constexpr double pilotShare = 0.2;

class Search {
public:
    /// `stop` must not be by passes.
    Search(SearchWorld world, const Scene& scene, Freedom freedom, const StopRule& stop);

    /// `start` is the pilot of `settings`, without passes. Its first ones tell whether there is time for a search; they are those of the
    /// image, so the search itself has other random numbers.
    SearchResult run(const RenderSettings& settings, std::unique_ptr<Pilot> start);

private:
    struct Contender {
        RenderSettings settings;
        std::unique_ptr<Pilot> pilot;
        PilotMeasure measure;
        size_t row = 0;
    };
    using Field = std::vector<Contender>;

    /// Successive halving (Karnin et al. 2013) among the best one so far and these, for so many seconds; whether one of these has won.
    bool race(const std::vector<RenderSettings>& candidates, double seconds);
    Field enter(const std::vector<RenderSettings>& candidates, unsigned passes, double end);
    void halve(Field& field, double end);
    bool isWithinBounds(const RenderSettings& settings) const;
    std::vector<RenderSettings> untried(const std::vector<RenderSettings>& candidates) const;
    void openContender(Field& field, const RenderSettings& settings, unsigned passes);
    bool renderUpTo(Contender& contender, unsigned passes);
    std::vector<double> errorsOf(const Field& field) const;
    void giveUpWorst(Field& field, size_t kept);
    void note(const Contender& contender, const std::string& outcome);
    double openingCost(const RenderSettings& settings) const;
    double passCost(const RenderSettings& settings) const;
    double secondsLeft() const;
    bool interrupted() const { return world_.interrupted && *world_.interrupted; }

    SearchWorld world_;
    const Scene& scene_;
    Freedom freedom_;
    StopRule stop_;
    RenderSettings start_;
    unsigned startPhotons_ = 0;
    double startPassSeconds_ = 0;
    double coldOpening_ = 0,
           warmOpening_ = 0; ///< seconds with kernels to be compiled, maybe, and with those of the start
    std::vector<std::string> tried_;
    Contender best_; ///< without a pilot before the first race
    SearchReport report_;
};

} // namespace quasilux
