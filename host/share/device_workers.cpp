#include "share/device_workers.h"

#include <algorithm>
#include <fmt/format.h>

namespace quasilux {

namespace {

constexpr double passesOfPatience = 10;
constexpr double longestWait = 1;   // seconds that one wait() adds to a device's silence at most
constexpr double secondsToOpen = 1; // at the end, for those that are just about to have opened their device
std::atomic<bool> someAreAbandoned{false};

} // namespace

bool hasAbandonedThreads() { return someAreAbandoned; }

DeviceWorkers::~DeviceWorkers() {
    waitForOpening();
    for (size_t k = 0; k < members_.size(); ++k) {
        if (members_[k].isAlive && opening_.contains(k)) abandon(members_[k]);
        members_[k].worker->end();
    }
    for (Member& member : members_)
        if (member.thread.joinable()) member.thread.join();
}

// Opening a device compiles kernels, which may take minutes, or for ever where the device gives no answer; what others
// have rendered is still to be written.
void DeviceWorkers::waitForOpening() {
    const Stopwatch watch;
    while (!opening_.empty() && watch.seconds() < secondsToOpen)
        if (auto event = events_->wait(secondsToOpen - watch.seconds())) note(std::move(*event));
}

void DeviceWorkers::add(const std::string& name, std::function<OpenedRenderer()> open) {
    const size_t number = members_.size();
    Member member;
    member.worker = std::make_shared<DeviceWorker>(number, name, std::move(open), events_);
    member.thread = std::thread(&DeviceWorker::run, member.worker);
    members_.push_back(std::move(member));
    opening_.insert(number);
}

std::optional<WorkerEvent> DeviceWorkers::wait(double seconds) {
    if (isSumming_ && asked_.empty()) {
        isSumming_ = false;
        std::sort(gave_.begin(), gave_.end());
        WorkerEvent summed;
        summed.kind = WorkerEvent::Kind::summed;
        return summed;
    }
    if (auto silent = silentOne()) return silent;
    if (auto event = events_->wait(seconds)) return note(std::move(*event));
    return std::nullopt;
}

std::optional<WorkerEvent> DeviceWorkers::note(WorkerEvent event) {
    if (!members_[event.worker].isAlive) return std::nullopt; // it answers after all: too late
    using enum WorkerEvent::Kind;
    if (event.kind == opened || event.kind == failed) opening_.erase(event.worker);
    if (event.kind == gave || event.kind == failed) asked_.erase(event.worker);
    if (event.kind == gave) gave_.push_back(event.worker);
    if (event.kind == failed) members_[event.worker].isAlive = false;
    return event;
}

// Time in which nobody waited is none of the devices': a program that is stopped (Ctrl-Z) stops them, and the clock
// runs on.
double DeviceWorkers::secondsWaited() {
    const double before = std::exchange(lastWait_, watch_.seconds());
    return std::min(longestWait, lastWait_ - before);
}

void DeviceWorkers::countSilence(Member& member, double seconds) {
    const unsigned signs = member.worker->signs();
    const bool isSilent = member.worker->isBusy() && signs == member.signs;
    member.silence = isSilent ? member.silence + seconds : 0;
    member.signs = signs;
}

std::optional<WorkerEvent> DeviceWorkers::silentOne() {
    const double seconds = secondsWaited();
    for (size_t k = 0; k < members_.size(); ++k) {
        Member& member = members_[k];
        if (!member.isAlive) continue;
        countSilence(member, seconds);
        const double patience = std::max(answerSeconds_, passesOfPatience * member.worker->longestPass());
        if (member.silence <= patience) continue;
        abandon(member);
        WorkerEvent event;
        event.kind = WorkerEvent::Kind::failed;
        event.worker = k;
        event.name = member.worker->name();
        event.why = fmt::format("no answer for {:.3g} s", patience);
        return note(std::move(event));
    }
    return std::nullopt;
}

void DeviceWorkers::abandon(Member& member) {
    member.worker->end();
    member.thread.detach();
    someAreAbandoned = true;
}

void DeviceWorkers::giveRadii(const RadiiState& radii) {
    const auto shared = std::make_shared<const RadiiState>(radii);
    for (Member& member : members_)
        if (member.isAlive) member.worker->giveRadii(shared);
}

void DeviceWorkers::askForSums() {
    gave_.clear();
    for (size_t k = 0; k < members_.size(); ++k)
        if (members_[k].isAlive && !opening_.contains(k)) {
            asked_.insert(k);
            members_[k].worker->askForSums();
        }
    isSumming_ = true;
}

PassSums DeviceWorkers::takeSums() {
    PassSums all;
    for (const size_t k : gave_) quasilux::add(all, members_[k].worker->takeSums());
    gave_.clear();
    return all;
}

} // namespace quasilux
