#include "view/errands.h"

namespace quasilux {

bool Errands::run(Errand errand, const Due& due, std::chrono::milliseconds patience) {
    Entry entry{std::move(errand), due, false, false, nullptr};
    std::unique_lock lock(mutex_);
    if (isClosed_) return false;
    entries_.push_back(&entry);
    waiting_ = entries_.size();
    done_.wait_for(lock, patience, [&] { return entry.isDone || entry.isDismissed || isClosed_; });
    if (!entry.isDone) entries_.remove(&entry);
    waiting_ = entries_.size();
    if (entry.failure) std::rethrow_exception(entry.failure);
    return entry.isDone;
}

void Errands::doDue(const RenderMoment& moment) {
    if (waiting_ == 0) return;
    const std::lock_guard lock(mutex_);
    const auto now = Clock::now();
    entries_.remove_if([&](Entry* entry) {
        if (moment.number <= entry->due.after || now < entry->due.notBefore) return false;
        if (moment.inPass && !entry->due.inPasses) return false;
        try {
            entry->errand(moment);
        } catch (...) {
            entry->failure = std::current_exception();
        }
        entry->isDone = true;
        return true;
    });
    waiting_ = entries_.size();
    done_.notify_all();
}

void Errands::hurry() {
    const std::lock_guard lock(mutex_);
    for (Entry* entry : entries_) entry->due.notBefore = {};
}

void Errands::dismiss() {
    const std::lock_guard lock(mutex_);
    for (Entry* entry : entries_) entry->isDismissed = true;
    done_.notify_all();
}

void Errands::close() {
    const std::lock_guard lock(mutex_);
    isClosed_ = true;
    done_.notify_all();
}

} // namespace quasilux
