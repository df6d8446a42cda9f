// Of the other ranks: does what rank 0 says with its own workers.
#pragma once

#include "ranks/job.h"
#include "ranks/mpi/collectives.h"
#include "ranks/mpi/messages.h"

namespace quasilux {

class RankAgent {
public:
    RankAgent(Messages& messages, std::string name, const OpenWorkers& open)
        : messages_(messages), name_(std::move(name)), open_(open) {}

    /// Some of what there is to do, for some milliseconds at most; false once rank 0 has ended the job.
    bool turn();

private:
    void say(nlohmann::json head);
    void say(WorkerEvent event);
    void obey(const Message& message);
    void open(const nlohmann::json& head);
    std::vector<char> received(const nlohmann::json& head) const;
    void listen();
    void sum();

    Messages& messages_;
    std::string name_;
    const OpenWorkers& open_;
    RankPlan plan_;
    std::unique_ptr<PassWorkers> workers_; ///< null: they could not be opened
    std::unique_ptr<FilmReduction> reduction_;
    bool saidOpen_ = true, isOver_ = false;
};

} // namespace quasilux
