#include "share/pass_dealer.h"

#include <algorithm>
#include <climits>
#include <cmath>

namespace quasilux {

namespace {

// Of passes that are given at once: messages take milliseconds at most.
constexpr double secondsAtOnce = 0.5;
constexpr double mostBatches = 256;

/// The end of so many batches from `first` on, the first of which may have begun.
unsigned endOf(unsigned first, unsigned batches) { return (first / passesInBatch + batches) * passesInBatch; }

} // namespace

double PassDealer::batchesLeft() const {
    if (!end_) return INFINITY;
    double passes = *end_ - std::min(next_, *end_);
    for (const PassRange& range : again_) passes += range.end - range.first;
    return std::ceil(passes / passesInBatch);
}

// Towards the end ever fewer, so that all end at about the same time (guided self-scheduling, Polychronopoulos and Kuck
// 1987).
unsigned PassDealer::batchesFor(const WorkerLoad& worker, size_t workers, double secondsLeft) const {
    if (!(worker.secondsPerPass > 0)) return 1;
    const double ofBatch = passesInBatch * worker.secondsPerPass;
    const double most = std::min(
        {mostBatches, secondsAtOnce / ofBatch, secondsLeft / 2 / ofBatch, batchesLeft() / (2 * double(workers))});
    return static_cast<unsigned>(std::max(1.0, most));
}

// Others would have done all batches before this one has done the first of them. Of equal ones none waits for the
// other.
bool PassDealer::isWorthIt(size_t who, const std::vector<WorkerLoad>& workers, double batches) {
    const double mine = workers[who].secondsPerPass;
    double byOthers = 0;
    for (size_t k = 0; k < workers.size() && byOthers < batches; ++k) {
        if (k == who || !(workers[k].secondsPerPass > 0)) continue;
        const double within = (mine - workers[k].busyFor / passesInBatch) / workers[k].secondsPerPass;
        byOthers += std::max(0.0, std::ceil(within) - 1); // those that are done before
    }
    return byOthers < batches;
}

std::optional<PassRange> PassDealer::take(size_t who, const std::vector<WorkerLoad>& workers, double secondsLeft,
                                          bool onlyAgain) {
    if (onlyAgain ? !hasAgain() : !hasMore()) return std::nullopt;
    if (!isWorthIt(who, workers, batchesLeft())) return std::nullopt;
    const unsigned batches = batchesFor(workers[who], workers.size(), secondsLeft);
    if (!again_.empty()) {
        PassRange& range = again_.front();
        const PassRange taken{range.first, std::min(range.end, endOf(range.first, batches))};
        range.first = taken.end;
        if (range.first == range.end) again_.pop_front();
        return taken;
    }
    const PassRange taken{next_, std::min(end_.value_or(UINT_MAX), endOf(next_, batches))};
    next_ = taken.end;
    return taken;
}

} // namespace quasilux
