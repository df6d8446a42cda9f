// One render whose passes are shared among workers by how fast they are (docs/method/scaling.md). What a worker that
// fails has not given is rendered by others, so the image is the sum of the same passes.
#pragma once

#include "render/worker_record.h"
#include "share/pass_dealer.h"
#include "share/pass_workers.h"
#include "util/stopwatch.h"

namespace quasilux {

/// The passes rendered so far, none of which is missing.
struct SharedPasses {
    const PassSums& sums;
    PassRange passes;
    const MemoryState& radii; ///< Renderer::saveRadii()
};

struct SharedHooks {
    std::function<void(const Progress&)> onProgress;
    /// Whenever all sums are there; `seconds` as the stop rule counts them.
    std::function<void(const SharedPasses& soFar, double seconds, bool isLast)> onSums;
    /// At the end, where passes before or between these are missing, and are nobody's to render: no state to go on
    /// from. May be empty.
    std::function<void(const std::vector<PassRange>& there)> onGap;
    /// What a worker is called, and why it was dropped.
    std::function<void(const std::string& name, const std::string& why)> onDropped;
    /// Seconds until sums are wanted beyond what the estimate of the error asks for; may be empty.
    std::function<double()> secondsToNextSums;
};

/// What it begins with: sums and radii of passes before, as one worker has them to begin with.
struct SharedStart {
    PassSums sums;
    PassRange passes;  ///< the first pass of all, and the one that comes next
    MemoryState radii; ///< of the passes before; workers say themselves whether these are the last ones
    double seconds = 0;
};

class SharedRender {
public:
    SharedRender(PassWorkers& workers, SharedStart start, const StopRule& stop, SharedHooks hooks,
                 const std::atomic<bool>& interrupted);

    /// Until the stop rule, or `interrupted`, ends it: passes that were begun are ended, as are those of workers that
    /// fail. Where all workers fail, what there is until then.
    RenderOutcome run();
    const std::vector<WorkerRecord>& workers() const { return records_; }
    const PassSums& sums() const { return sums_; }

private:
    struct Given {
        PassRange passes;
        bool isAsked = false; ///< its sums have been asked for
    };
    struct Member {
        bool isAlive = false;
        std::deque<PassRange> running; ///< given, not yet rendered
        std::vector<Given> loose;      ///< given, and lost if it fails now
        double secondsPerPass = 0;
        double freeAt = 0; ///< expected, by watch_
    };

    void note(const WorkerEvent& event);
    void noteOpened(const WorkerEvent& event);
    void noteRendered(const WorkerEvent& event);
    void noteGave(const WorkerEvent& event);
    void noteFailed(const WorkerEvent& event);
    void noteSummed();
    void noteRadii(const WorkerEvent& event);
    Member& member(size_t worker);

    void handOut();
    void handOutTo(size_t worker);
    std::vector<size_t> freeWorkers() const;
    std::vector<WorkerLoad> loads() const;
    bool mayBegin() const;
    bool isIdle() const;
    bool hasLoose() const;
    bool isOver() const;
    void askWhereDue();
    void publish(bool isLast);
    void report();
    double elapsed() const;

    PassWorkers& workers_;
    StopRule stop_;
    SharedHooks hooks_;
    const std::atomic<bool>& interrupted_;
    PassDealer dealer_;
    PassSums sums_;
    unsigned first_;
    std::vector<PassRange> arriving_, added_; ///< in sums that are on their way; in sums_
    MemoryState radii_;
    bool radiiAreChosen_ = false;
    bool isSumming_ = false;
    std::vector<Member> members_;
    std::vector<WorkerRecord> records_;
    std::string lastFailure_;
    Progress progress_;
    uint64_t photons_ = 0, paths_ = 0; ///< since it began, also those that were lost
    uint64_t rendered_;                ///< passes, those before among them
    Stopwatch watch_;                  ///< since it began
    double secondsBefore_, renderedBefore_ = 0, lastSums_ = 0, costOfSums_ = 0, slowestGiving_ = 0;
};

} // namespace quasilux
