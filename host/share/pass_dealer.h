// Which passes a worker that is free is given, by how fast it has been (docs/method/scaling.md). Knows no device.
#pragma once

#include "output/render_checkpoint.h"

#include <deque>
#include <optional>
#include <vector>

namespace quasilux {

/// Passes in a row that go to one worker: standard errors come from their sums (film.cpp).
inline constexpr unsigned passesInBatch = 4;

/// How busy one of those that may be given passes is.
struct WorkerLoad {
    double secondsPerPass = 0; ///< of its last ones; 0: not known yet
    double busyFor = 0;        ///< seconds until it has ended what it was given, about
};

class PassDealer {
public:
    /// From this pass on, up to `end`.
    PassDealer(unsigned next, std::optional<unsigned> end) : next_(next), end_(end) {}

    /// What a worker was given that has failed.
    void giveBack(const PassRange& passes) { again_.push_back(passes); }
    bool hasAgain() const { return !again_.empty(); }
    bool hasMore() const { return hasAgain() || !end_ || next_ < *end_; }
    /// Passes before this one have been given to somebody.
    unsigned next() const { return next_; }

    /// Whole batches, of which the last one may be cut by the end, for worker number `who`, which is free; as many as
    /// take about a time that is long beside what giving them costs, and short beside `secondsLeft`. None where all
    /// that is left is done sooner by others, or only what was given back is to be done (`onlyAgain`) and there is
    /// none.
    std::optional<PassRange> take(size_t who, const std::vector<WorkerLoad>& workers, double secondsLeft,
                                  bool onlyAgain = false);

private:
    double batchesLeft() const;
    unsigned batchesFor(const WorkerLoad& worker, size_t workers, double secondsLeft) const;
    static bool isWorthIt(size_t who, const std::vector<WorkerLoad>& workers, double batches);

    unsigned next_;
    std::optional<unsigned> end_;
    std::deque<PassRange> again_;
};

} // namespace quasilux
