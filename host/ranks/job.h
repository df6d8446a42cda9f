// The MPI job that this program is one rank of (docs/reference/reliability.md, "Machines"). Built without MPI, or
// started alone, there is one rank. Only the main thread may call any of this.
#pragma once

#include "share/pass_workers.h"

#include <functional>

namespace quasilux {

/// What ranks receive of a render before its passes.
struct RankPlan {
    std::string sensor;
    RenderSettings settings;
    SceneChecksums checksums; ///< a rank that reads another scene is dropped
    Renderer::FilmShape shape;
    MemoryState learned; ///< saveLearned()
};

/// Devices of one rank.
using OpenWorkers = std::function<std::unique_ptr<PassWorkers>(const RankPlan& plan)>;

class Job {
public:
    /// Throws InputError where the program was started as one of several ranks, but was built without MPI.
    static Job& current();

    unsigned rank() const { return rank_; }
    unsigned size() const { return size_; }
    /// Among the ranks of this machine.
    unsigned localRank() const { return localRank_; }
    unsigned localSize() const { return localSize_; }
    /// "rank 3 on node7".
    const std::string& name() const { return name_; }

    /// Of rank 0: workers of all ranks, its `own` first. One render after the other.
    std::unique_ptr<PassWorkers> spread(std::unique_ptr<PassWorkers> own, const RankPlan& plan);
    /// Of the others: renders what rank 0 asks for until it ends the job. `onTurn` is called some hundred times a
    /// second.
    void assist(const OpenWorkers& open, const std::function<void()>& onTurn);
    /// Before the program ends, also after an error: on rank 0 it ends the job, if there is one.
    static void endCurrent();

private:
    Job();
    void end();

    unsigned rank_ = 0, size_ = 1, localRank_ = 0, localSize_ = 1;
    std::string name_;
};

/// As what mpirun or srun has started this program, before MPI begins: also of one that is built without MPI.
struct LaunchedAs {
    unsigned rank = 0, size = 1;
};
LaunchedAs launchedAs();

} // namespace quasilux
