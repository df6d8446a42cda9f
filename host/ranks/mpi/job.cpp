#include "ranks/job.h"

#include "ranks/mpi/rank_agent.h"
#include "ranks/mpi/rank_workers.h"

#include <array>
#include <fmt/format.h>
#include <optional>

namespace quasilux {

namespace {

// Between the beginning and the end of MPI.
std::optional<Messages> messages;
bool hasMpi = false;

struct LocalPlace {
    int rank = 0, size = 1;
};

// Among ranks that share this machine's memory.
LocalPlace placeOnMachine() {
    MPI_Comm machine = MPI_COMM_NULL;
    LocalPlace place;
    MPI_Comm_split_type(MPI_COMM_WORLD, MPI_COMM_TYPE_SHARED, 0, MPI_INFO_NULL, &machine);
    MPI_Comm_rank(machine, &place.rank);
    MPI_Comm_size(machine, &place.size);
    MPI_Comm_free(&machine);
    return place;
}

} // namespace

Job::Job() {
    if (launchedAs().size < 2) return; // beginning takes half a second
    int provided = 0, rank = 0, size = 1, length = 0;
    MPI_Init_thread(nullptr, nullptr, MPI_THREAD_FUNNELED, &provided);
    hasMpi = true;
    messages.emplace();
    openCollectives();
    MPI_Comm_rank(MPI_COMM_WORLD, &rank);
    MPI_Comm_size(MPI_COMM_WORLD, &size);
    const LocalPlace place = placeOnMachine();
    rank_ = static_cast<unsigned>(rank);
    size_ = static_cast<unsigned>(size);
    localRank_ = static_cast<unsigned>(place.rank);
    localSize_ = static_cast<unsigned>(place.size);
    std::array<char, MPI_MAX_PROCESSOR_NAME + 1> host{};
    MPI_Get_processor_name(host.data(), &length);
    name_ = fmt::format("rank {} on {}", rank_, host.data());
}

Job& Job::current() {
    static Job job;
    return job;
}

std::unique_ptr<PassWorkers> Job::spread(std::unique_ptr<PassWorkers> own, const RankPlan& plan) {
    if (size_ == 1) return own;
    return std::make_unique<RankWorkers>(*messages, size_, std::move(own), plan);
}

void Job::assist(const OpenWorkers& open, const std::function<void()>& onTurn) {
    RankAgent agent(*messages, name_, open);
    while (agent.turn()) onTurn();
}

void Job::endCurrent() {
    if (hasMpi) current().end();
}

void Job::end() {
    hasMpi = false;
    if (rank_ == 0)
        for (unsigned rank = 1; rank < size_; ++rank) messages->send(rank, {0, {{"do", "over"}}});
    messages->flush();
    messages.reset();
    closeCollectives();
    MPI_Finalize();
}

} // namespace quasilux
