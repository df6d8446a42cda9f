// Of rank 0: the workers of all ranks.
#pragma once

#include "ranks/job.h"
#include "ranks/mpi/collectives.h"
#include "ranks/mpi/messages.h"

#include <map>
#include <set>

namespace quasilux {

class RankWorkers : public PassWorkers {
public:
    RankWorkers(Messages& messages, unsigned ranks, std::unique_ptr<PassWorkers> own, const RankPlan& plan);
    ~RankWorkers() override;
    RankWorkers(const RankWorkers&) = delete;
    RankWorkers& operator=(const RankWorkers&) = delete;

    std::optional<WorkerEvent> wait(double seconds) override;
    bool areOpening() const override { return own_->areOpening() || !opening_.empty(); }
    void render(size_t worker, const PassRange& passes) override;
    void giveRadii(const RadiiState& radii) override;
    void askForSums() override;
    PassSums takeSums() override;

private:
    struct Place {
        unsigned rank;
        size_t worker; ///< among those of the rank
    };
    void tell(unsigned rank, nlohmann::json head, std::vector<char> body = {});
    void tellAll(const nlohmann::json& head, const std::vector<char>& body = {});
    std::optional<WorkerEvent> ofOwn(double seconds);
    std::optional<WorkerEvent> ofOthers();
    WorkerEvent numbered(WorkerEvent event, unsigned rank);
    bool sumsAreThere();
    void forgetBroadcasts();

    Messages& messages_;
    unsigned ranks_;
    std::unique_ptr<PassWorkers> own_;
    Renderer::FilmShape shape_;
    std::vector<Place> places_;
    std::set<unsigned> opening_, summing_; ///< ranks of which not all workers have opened; whose sums are not there yet
    std::deque<std::unique_ptr<Broadcast>> broadcasts_;
    std::unique_ptr<FilmReduction> reduction_;
    std::vector<PassSums> parts_; ///< by rank, without films
};

} // namespace quasilux
