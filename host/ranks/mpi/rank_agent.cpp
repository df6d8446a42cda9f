#include "ranks/mpi/rank_agent.h"

#include "ranks/mpi/wire.h"
#include "util/error.h"

#include <chrono>
#include <fmt/format.h>
#include <thread>

namespace quasilux {

void RankAgent::say(nlohmann::json head) { messages_.send(0, {0, std::move(head)}); }

void RankAgent::say(WorkerEvent event) {
    event.name = event.name.empty() ? name_ : fmt::format("{}, {}", name_, event.name);
    messages_.send(0, toMessage(event));
}

bool RankAgent::turn() {
    while (!isOver_) {
        const auto message = messages_.receive();
        if (!message) break;
        obey(*message);
    }
    if (isOver_) return false;
    if (reduction_ && reduction_->isDone()) reduction_.reset();
    if (workers_)
        listen();
    else
        std::this_thread::sleep_for(std::chrono::duration<double>(secondsOfTurn));
    return true;
}

void RankAgent::obey(const Message& message) {
    const std::string what = message.head.at("do");
    if (what == "plan") open(message.head);
    if (what == "render" && workers_)
        workers_->render(message.head.at("worker"), {message.head.at("first"), message.head.at("end")});
    if (what == "radii") {
        const auto bytes = received(message.head);
        if (workers_) workers_->giveRadii({MemoryState::unpacked(bytes), true});
    }
    if (what == "sums") {
        if (workers_)
            workers_->askForSums();
        else
            sum();
    }
    if (what == "end") workers_.reset();
    if (what == "over") isOver_ = true;
}

std::vector<char> RankAgent::received(const nlohmann::json& head) const {
    Broadcast broadcast(std::vector<char>(head.at("bytes").get<size_t>()));
    while (!broadcast.isDone()) std::this_thread::sleep_for(std::chrono::duration<double>(secondsOfTurn));
    return broadcast.bytes();
}

void RankAgent::open(const nlohmann::json& head) {
    plan_ = planOf(head.at("plan"));
    plan_.learned = MemoryState::unpacked(received(head));
    const auto why = failureOf([&] { workers_ = open_(plan_); });
    saidOpen_ = false;
    if (!why) return;
    WorkerEvent failed;
    failed.kind = WorkerEvent::Kind::failed;
    failed.why = *why;
    say(std::move(failed));
    say({{"is", "open"}});
}

void RankAgent::listen() {
    if (auto event = workers_->wait(secondsOfTurn)) {
        if (event->kind == WorkerEvent::Kind::summed)
            sum();
        else
            say(std::move(*event));
    }
    if (saidOpen_ || workers_->areOpening()) return;
    saidOpen_ = true;
    say({{"is", "open"}});
}

void RankAgent::sum() {
    PassSums sums;
    if (workers_) sums = workers_->takeSums();
    say({{"is", "sums"}, {"sums", toJson(sums)}});
    reduction_ = std::make_unique<FilmReduction>(std::move(sums.film), plan_.shape);
}

} // namespace quasilux
