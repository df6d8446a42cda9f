// Pilot passes of one candidate after the other; the best one goes on (docs/auto.md). Knows no device.
#pragma once

#include "auto/candidates.h"
#include "auto/pilot.h"
#include "auto/search_report.h"

#include <atomic>
#include <functional>
#include <map>
#include <memory>
#include <optional>

namespace quasilux {

/// What the search needs of the world.
struct SearchWorld {
    std::function<std::unique_ptr<Pilot>(const RenderSettings&)> open;
    std::function<double()> clock;        ///< seconds since the render began
    std::function<void(unsigned)> onPass; ///< after each pass, how many there were; may be empty
    /// Whether Ctrl-C was pressed.
    const std::atomic<bool>* interrupted = nullptr;
};

struct SearchResult {
    RenderSettings settings;
    std::unique_ptr<Pilot> best;
    SearchReport report;
};

/// Share of the render's time that goes to pilots of candidates, opening them included; those of the best one so far take about as
/// long again. All of it lost, error grows by 1 / sqrt(1 - 2 * 0.12) = 1.15.
inline constexpr double pilotShare = 0.12;

class Search {
public:
    /// `stop` must not be by passes. Candidates are neighbours() of the best one, where `freedom` allows.
    Search(SearchWorld world, const Scene& scene, Freedom freedom, const StopRule& stop);

    /// `start` is the pilot of `settings`, without passes.
    SearchResult run(const RenderSettings& settings, std::unique_ptr<Pilot> start);

private:
    struct Contender {
        RenderSettings settings;
        std::unique_ptr<Pilot> pilot;
        PilotMeasure measure;
        /// Of fewer passes too, by their number: noise and cost of a pass fall while radii do, so like is held against like.
        std::map<unsigned, PilotMeasure> stages;
        size_t row = 0;
    };
    enum class Verdict { better, worse, undecided };

    bool tryRound(const RenderSettings& start); ///< whether there was anything new to try
    void tryNeighbours(Coordinate coordinate);
    bool tryCandidate(Coordinate coordinate, const RenderSettings& settings);
    Verdict duel(Contender& challenger);
    /// Predicted errors of it and of the best one after as many passes.
    ErrorRatio against(const Contender& challenger) const;
    bool isHopeless(const Contender& challenger) const;
    bool isCloseCall(const Contender& challenger) const;
    Verdict judge(const Contender& challenger, bool isLast) const;
    static unsigned fewestToWinAgainst(const Contender& best, const Contender& challenger);
    bool renderUpTo(Contender& contender, unsigned passes);
    static void measure(Contender& contender);
    bool fits(double seconds) const; ///< into the pilots' share of the time
    bool affords(double seconds);    ///< the same, and notes it where it does not
    bool isWorthTrying(Coordinate coordinate, const RenderSettings& settings) const;
    std::optional<double> opening(const std::string& key) const;
    double openingCost(const RenderSettings& settings) const;
    void enter(Contender& contender);
    void note(const Contender& contender, const std::string& outcome);
    double spent() const;
    double secondsAllowed() const;
    double horizon() const;
    double secondsLeft() const;
    bool interrupted() const { return world_.interrupted && *world_.interrupted; }

    SearchWorld world_;
    const Scene& scene_;
    Freedom freedom_;
    StopRule stop_;
    Contender best_;
    std::vector<std::string> tried_;
    std::vector<std::pair<std::string, double>> openings_; ///< seconds by kernelKey, in the order of first openings
    SearchReport report_;
    double began_ = 0, ofBest_ = 0; ///< clock when the first candidate is due; seconds of the best one's passes since
    unsigned startPhotons_ = 0;
    double startRadius_ = 1;
    bool triesAll_ = false; ///< photons also where they do not promise much, once nothing else is left
};

} // namespace quasilux
