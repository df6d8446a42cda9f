#include "ranks/mpi/rank_workers.h"

#include "ranks/mpi/wire.h"
#include "util/stopwatch.h"

#include <algorithm>

namespace quasilux {

RankWorkers::RankWorkers(Messages& messages, unsigned ranks, std::unique_ptr<PassWorkers> own, const RankPlan& plan)
    : messages_(messages), ranks_(ranks), own_(std::move(own)), shape_(plan.shape), parts_(ranks) {
    auto learned = plan.learned.packed();
    tellAll({{"do", "plan"}, {"plan", toJson(plan)}, {"bytes", learned.size()}});
    broadcasts_.push_back(std::make_unique<Broadcast>(std::move(learned)));
    for (unsigned rank = 1; rank < ranks_; ++rank) opening_.insert(rank);
}

RankWorkers::~RankWorkers() {
    own_.reset();
    tellAll({{"do", "end"}});
}

void RankWorkers::tell(unsigned rank, nlohmann::json head, std::vector<char> body) {
    messages_.send(rank, {0, std::move(head), std::move(body)});
}

void RankWorkers::tellAll(const nlohmann::json& head, const std::vector<char>& body) {
    for (unsigned rank = 1; rank < ranks_; ++rank) tell(rank, head, body);
}

std::optional<WorkerEvent> RankWorkers::wait(double seconds) {
    const Stopwatch watch;
    do {
        forgetBroadcasts();
        if (auto event = ofOthers()) return event;
        if (reduction_ && sumsAreThere()) {
            WorkerEvent summed;
            summed.kind = WorkerEvent::Kind::summed;
            return summed;
        }
        if (auto event = ofOwn(secondsOfTurn)) return event;
    } while (watch.seconds() < seconds);
    return std::nullopt;
}

void RankWorkers::forgetBroadcasts() {
    while (!broadcasts_.empty() && broadcasts_.front()->isDone()) broadcasts_.pop_front();
}

std::optional<WorkerEvent> RankWorkers::ofOwn(double seconds) {
    auto event = own_->wait(seconds);
    if (!event) return std::nullopt;
    if (event->kind != WorkerEvent::Kind::summed) return numbered(std::move(*event), 0);
    parts_[0] = own_->takeSums();
    reduction_ = std::make_unique<FilmReduction>(std::move(parts_[0].film), shape_);
    return std::nullopt;
}

std::optional<WorkerEvent> RankWorkers::ofOthers() {
    while (auto message = messages_.receive()) {
        const std::string is = message->head.at("is");
        if (is == "event") return numbered(eventOf(*message), message->from);
        if (is == "open") opening_.erase(message->from);
        if (is == "sums") {
            parts_[message->from] = sumsOf(message->head.at("sums"));
            summing_.erase(message->from);
        }
    }
    return std::nullopt;
}

WorkerEvent RankWorkers::numbered(WorkerEvent event, unsigned rank) {
    size_t k = 0;
    while (k < places_.size() && !(places_[k].rank == rank && places_[k].worker == event.worker)) ++k;
    if (k == places_.size()) places_.push_back({rank, event.worker});
    event.worker = k;
    return event;
}

void RankWorkers::render(size_t worker, const PassRange& passes) {
    const Place& place = places_.at(worker);
    if (place.rank == 0) return own_->render(place.worker, passes);
    tell(place.rank, {{"do", "render"}, {"worker", place.worker}, {"first", passes.first}, {"end", passes.end}});
}

void RankWorkers::giveRadii(const RadiiState& radii) {
    own_->giveRadii(radii);
    auto bytes = radii.state.packed();
    tellAll({{"do", "radii"}, {"bytes", bytes.size()}});
    broadcasts_.push_back(std::make_unique<Broadcast>(std::move(bytes)));
}

void RankWorkers::askForSums() {
    for (unsigned rank = 1; rank < ranks_; ++rank) summing_.insert(rank);
    tellAll({{"do", "sums"}});
    own_->askForSums();
}

bool RankWorkers::sumsAreThere() { return reduction_->isDone() && summing_.empty(); }

PassSums RankWorkers::takeSums() {
    PassSums all;
    for (const PassSums& part : parts_) addAllButFilm(all, part);
    if (all.counters.passes > 0) {
        all.shape = shape_;
        all.film = reduction_->takeFilm();
    }
    reduction_.reset();
    std::fill(parts_.begin(), parts_.end(), PassSums{});
    return all;
}

} // namespace quasilux
