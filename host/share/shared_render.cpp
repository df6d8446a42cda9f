#include "share/shared_render.h"

#include "render/error_estimate.h"
#include "render/stop_rule.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace quasilux {

namespace {

constexpr double secondsToWait = 0.02; // for what workers say, until a signal is looked for again

} // namespace

SharedRender::SharedRender(PassWorkers& workers, SharedStart start, const StopRule& stop, SharedHooks hooks,
                           const std::atomic<bool>& interrupted)
    : workers_(workers), stop_(withDefault(stop)), hooks_(std::move(hooks)), interrupted_(interrupted),
      dealer_(start.passes.end, stop.passes), sums_(std::move(start.sums)), first_(start.passes.first),
      radii_(std::move(start.radii)), rendered_(sums_.counters.passes), secondsBefore_(start.seconds) {
    if (!sums_.isEmpty()) added_ = {start.passes};
    renderedBefore_ = sums_.counters.renderSeconds;
    progress_.phase = "rendering";
    lastSums_ = elapsed();
}

double SharedRender::elapsed() const { return secondsBefore_ + watch_.seconds(); }

RenderOutcome SharedRender::run() {
    for (;;) {
        handOut();
        askWhereDue();
        if (isOver()) break;
        if (const auto event = workers_.wait(secondsToWait))
            note(*event);
        else
            report();
    }
    RenderOutcome outcome;
    publish(true);
    if (!sums_.isEmpty()) outcome.image = sums_.develop();
    outcome.counters = sums_.counters;
    const bool allFailed = std::none_of(members_.begin(), members_.end(), [](const Member& m) { return m.isAlive; });
    if (allFailed && (dealer_.hasAgain() || mayBegin()) && !lastFailure_.empty())
        outcome.failure =
            std::make_exception_ptr(std::runtime_error("no device is left; the last one: " + lastFailure_));
    if (outcome.failure && sums_.isEmpty()) std::rethrow_exception(outcome.failure);
    return outcome;
}

void SharedRender::note(const WorkerEvent& event) {
    using enum WorkerEvent::Kind;
    switch (event.kind) {
    case opened:
        return noteOpened(event);
    case rendered:
        return noteRendered(event);
    case gave:
        return noteGave(event);
    case failed:
        return noteFailed(event);
    case summed:
        return noteSummed();
    }
}

SharedRender::Member& SharedRender::member(size_t worker) {
    if (worker >= members_.size()) {
        members_.resize(worker + 1);
        records_.resize(worker + 1);
    }
    return members_[worker];
}

void SharedRender::noteOpened(const WorkerEvent& event) {
    member(event.worker).isAlive = true;
    records_[event.worker].name = event.name;
    noteRadii(event);
}

void SharedRender::noteRendered(const WorkerEvent& event) {
    Member& one = member(event.worker);
    one.running.pop_front();
    const unsigned passes = event.passes.end - event.passes.first;
    one.secondsPerPass = event.seconds / passes;
    WorkerRecord& record = records_[event.worker];
    record.passes += passes;
    record.seconds += event.seconds;
    record.timed += passes;
    record.squaredSeconds += event.squaredSeconds;
    rendered_ += passes;
    photons_ += event.photons;
    paths_ += event.paths;
    noteRadii(event);
    report();
}

// What it was given before it was asked is safe now.
void SharedRender::noteGave(const WorkerEvent& event) {
    Member& one = member(event.worker);
    for (const Given& given : one.loose)
        if (given.isAsked) arriving_.push_back(given.passes);
    std::erase_if(one.loose, [](const Given& given) { return given.isAsked; });
    slowestGiving_ = std::max(slowestGiving_, event.seconds);
    noteRadii(event);
}

void SharedRender::noteFailed(const WorkerEvent& event) {
    Member& one = member(event.worker);
    WorkerRecord& record = records_[event.worker];
    if (record.name.empty()) record.name = event.name;
    for (const Given& given : one.loose) {
        dealer_.giveBack(given.passes);
        const uint64_t passes = given.passes.end - given.passes.first;
        const bool wasRendered = std::none_of(one.running.begin(), one.running.end(), [&](const PassRange& range) {
            return range.first == given.passes.first;
        });
        if (!wasRendered) continue;
        rendered_ -= passes;
        record.passes -= passes;
    }
    one = {};
    record.failure = event.why;
    lastFailure_ = record.name + ": " + event.why;
    if (hooks_.onDropped) hooks_.onDropped(record.name, event.why);
}

void SharedRender::noteRadii(const WorkerEvent& event) {
    if (!event.radii || radiiAreChosen_) return;
    radii_ = event.radii->state;
    radiiAreChosen_ = event.radii->areChosen;
    if (radiiAreChosen_) workers_.giveRadii(*event.radii);
}

void SharedRender::noteSummed() {
    const Stopwatch watch;
    add(sums_, workers_.takeSums());
    added_.insert(added_.end(), arriving_.begin(), arriving_.end());
    added_ = joined(std::move(added_));
    arriving_.clear();
    isSumming_ = false;
    if (!isIdle() || mayBegin()) publish(false);
    costOfSums_ = watch.seconds() + slowestGiving_;
    slowestGiving_ = 0;
    lastSums_ = elapsed();
}

// Sums that lack passes of a worker that has failed are no state to go on from; the next ones will have them.
void SharedRender::publish(bool isLast) {
    const bool isWhole = added_.size() == 1 && added_.front().first == first_;
    if (sums_.isEmpty() || (!isWhole && !isLast)) return;
    sums_.counters.renderSeconds = renderedBefore_ + watch_.seconds();
    if (!isLast && sums_.counters.passes >= fewestPassesForError)
        if (const ErrorEstimate error = estimateError(sums_.develop()); error.isKnown())
            progress_.relativeError = error.sum();
    if (isWhole && hooks_.onSums) hooks_.onSums({sums_, {first_, added_.front().end}, radii_}, elapsed(), isLast);
    if (isLast && !isWhole && hooks_.onGap) hooks_.onGap(added_);
    report();
}

void SharedRender::report() {
    progress_.passes = static_cast<unsigned>(rendered_);
    progress_.seconds = elapsed();
    const double seconds = std::max(1e-9, watch_.seconds());
    progress_.photonsPerSecond = static_cast<double>(photons_) / seconds;
    progress_.pathsPerSecond = static_cast<double>(paths_) / seconds;
    progress_.secondsLeft = secondsLeft(stop_, progress_);
    if (hooks_.onProgress) hooks_.onProgress(progress_);
}

bool SharedRender::mayBegin() const {
    if (interrupted_ || !dealer_.hasMore()) return false;
    if (stop_.seconds && elapsed() >= *stop_.seconds && rendered_ > 0) return false;
    return !(stop_.relativeError && progress_.relativeError >= 0 && progress_.relativeError <= *stop_.relativeError);
}

std::vector<WorkerLoad> SharedRender::loads() const {
    std::vector<WorkerLoad> all;
    for (const Member& one : members_) {
        WorkerLoad load;
        if (one.isAlive) load.secondsPerPass = one.secondsPerPass;
        // One that should be done already may take as long again.
        if (!one.running.empty()) load.busyFor = std::abs(one.freeAt - watch_.seconds());
        all.push_back(load);
    }
    return all;
}

// The fastest first. Until radii are chosen one renders alone, since later ones are chosen with the photons of its
// passes.
std::vector<size_t> SharedRender::freeWorkers() const {
    std::vector<size_t> free;
    for (size_t k = 0; k < members_.size(); ++k) {
        if (!members_[k].isAlive) continue;
        if (members_[k].running.empty()) free.push_back(k);
        if (!radiiAreChosen_) break;
    }
    std::stable_sort(free.begin(), free.end(),
                     [&](size_t a, size_t b) { return members_[a].secondsPerPass < members_[b].secondsPerPass; });
    return free;
}

void SharedRender::handOut() {
    for (const size_t worker : freeWorkers()) handOutTo(worker);
}

void SharedRender::handOutTo(size_t worker) {
    const double left = stop_.seconds ? *stop_.seconds - elapsed() : INFINITY;
    Member& one = members_[worker];
    // The batch is to end nearer to the time's end than it begins; the first one of all is rendered whatever it takes.
    const bool isInTime = passesInBatch * one.secondsPerPass < 2 * left || rendered_ == 0;
    const bool onlyAgain = !mayBegin() || !isInTime;
    const auto passes = dealer_.take(worker, loads(), left, onlyAgain);
    if (!passes) return;
    one.running.push_back(*passes);
    one.loose.push_back({*passes});
    one.freeAt = watch_.seconds() + one.secondsPerPass * (passes->end - passes->first);
    workers_.render(worker, *passes);
}

bool SharedRender::isIdle() const {
    return std::all_of(members_.begin(), members_.end(), [](const Member& one) { return one.running.empty(); });
}

bool SharedRender::hasLoose() const {
    return std::any_of(members_.begin(), members_.end(), [](const Member& one) { return !one.loose.empty(); });
}

void SharedRender::askWhereDue() {
    if (isSumming_ || !hasLoose()) return;
    const double since = elapsed() - lastSums_;
    const bool isDue = isErrorDue(since, costOfSums_) ||
                       (hooks_.secondsToNextSums && since > costOfSums_ && hooks_.secondsToNextSums() <= 0);
    if (!isDue && !isIdle()) return;
    for (Member& one : members_)
        for (Given& given : one.loose) given.isAsked = true;
    workers_.askForSums();
    isSumming_ = true;
}

// All that was begun has ended and been added, and nothing may be begun, or nobody is there to do it.
bool SharedRender::isOver() const {
    if (isSumming_ || !isIdle() || hasLoose()) return false;
    const bool someoneIsThere =
        std::any_of(members_.begin(), members_.end(), [](const Member& one) { return one.isAlive; });
    return (!mayBegin() && !dealer_.hasAgain()) || (!someoneIsThere && !workers_.areOpening());
}

} // namespace quasilux
