// Pilot passes of all candidates; the worse half is given up again and again, and the last one left is chosen
// (docs/method/auto.md). Knows no device.
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
    size_t mostOpen = 1000;               ///< pilots that memory holds at once; a race has two in any case
    /// Whether Ctrl-C was pressed.
    const std::atomic<bool>* interrupted = nullptr;
};

struct SearchResult {
    RenderSettings settings;
    SearchReport report;
    std::unique_ptr<Pilot> start; ///< where nothing was tried; as it was, or with fewer photons
};

/// Share of the render's time that goes to pilots, opening them included. All of it lost, error grows by 1 / sqrt(1 -
/// 0.16) = 1.09.
inline constexpr double pilotShare = 0.16;

class Search {
public:
    /// `stop` must not be by passes.
    Search(SearchWorld world, const Scene& scene, Freedom freedom, const StopRule& stop);

    /// `start` is the pilot of `settings`, without passes. Its first ones show whether there is time for a search. They
    /// are those of the image where there is not, so the search itself has other random numbers.
    SearchResult run(const RenderSettings& settings, std::unique_ptr<Pilot> start);

private:
    struct Contender {
        RenderSettings settings;
        std::unique_ptr<Pilot> pilot;
        PilotMeasure measure;
        size_t row = 0;
        unsigned earlierPasses = 0; ///< in an earlier race
        double leastGain = 1;       ///< its relMSE must be that much less to win
        std::string failure{};      ///< what ended it, in whichever pass
    };
    using Field = std::vector<Contender>;

    /// Successive halving (Karnin et al. 2013) among these, for so many seconds. All begin anew, as estimates differ
    /// after fewer passes: like must be held against like. All but the first one must have a relMSE that is `leastGain`
    /// times less to win.
    void race(const std::vector<RenderSettings>& candidates, unsigned fewestPasses, double leastGain, double seconds);
    /// Camera paths of a pixel in a pass with which these settings have the least error.
    unsigned cameraPathsOf(const Contender& contender) const;
    static PilotMeasure withPaths(const Contender& contender, unsigned cameraPaths);
    /// What the contender would measure with as many as serve it best. All are compared by it: one whose photons cost
    /// much and carry little is not to be given up for what it is with one path.
    PilotMeasure atItsBest(const Contender& contender) const;
    void chooseCameraPaths();
    /// Whether they are to be by pixel, of settings whose number is chosen. The pilot can render no more after that.
    CameraSampling samplingOf(Contender& contender, const PilotMeasure& measure, unsigned cameraPaths);
    bool mayDiscard(Contender& start);
    std::unique_ptr<Pilot> renderFirst(Contender& start, bool& begun);
    SearchResult withItsPaths(Contender& first, std::unique_ptr<Pilot> kept);
    /// Among the best ones so far and those beside it; whether one of these has won.
    bool raceOfNumbers(double seconds);
    Field enter(const std::vector<RenderSettings>& candidates, unsigned passes, double leastGain, double middle,
                double end);
    /// Goes on from `passes` passes of each to as many as the time until `end` allows, `most` of them; false where that
    /// is none.
    bool renderAll(Field& field, unsigned passes, unsigned most, double end);
    void halve(Field& field, double end);
    unsigned pathsOfTrial(const RenderSettings& settings) const;
    bool isWithinBounds(const RenderSettings& settings) const;
    std::vector<RenderSettings> untried(const std::vector<RenderSettings>& candidates) const;
    size_t rowOf(const RenderSettings& settings, unsigned photons);
    /// Does what concerns one contender; false where it fails, which is then the end of this contender, not of the
    /// search.
    bool dare(Contender& contender, const std::function<void()>& action);
    void dropFailed(Field& field);
    void openContender(Field& field, const RenderSettings& settings, unsigned passes, double leastGain);
    bool renderUpTo(Contender& contender, unsigned passes);
    PilotMeasure measureOf(const Contender& contender, const std::vector<float>& brightness);
    void measureTogether(Field& field);
    void giveUpWorst(Field& field, size_t kept);
    void note(const Contender& contender, const std::string& outcome);
    void noteFailure(const Contender& contender);
    double passCost(const RenderSettings& settings) const;
    double secondsLeft() const;
    bool interrupted() const { return world_.interrupted && *world_.interrupted; }

    SearchWorld world_;
    const Scene& scene_;
    Freedom freedom_;
    StopRule stop_;
    RenderSettings start_;
    unsigned startPhotons_ = 0;
    double startPassSeconds_ = 0, startPathSeconds_ = 0; ///< of a pass, of a camera path of each pixel beside photons
    double openingSeconds_ = 0;                          ///< of the last contender; its kernels are those of the start
    Contender best_;                                     ///< without a pilot before the first race
    double causticsByPaths_ = 0;                         ///< PilotMeasure's, the largest of the pilots by photons
    SearchReport report_;
};

} // namespace quasilux
