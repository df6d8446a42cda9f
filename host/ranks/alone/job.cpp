// Built without MPI: one rank.
#include "ranks/job.h"

#include "util/error.h"

#include <fmt/format.h>

namespace quasilux {

Job::Job() {
    const LaunchedAs launched = launchedAs();
    if (launched.size > 1)
        throw InputError(fmt::format("started as rank {} of {}, but built without MPI, so each would render all of it: "
                                     "build with -DQUASILUX_MPI=ON (scripts/setup.sh --mpi), or start one",
                                     launched.rank, launched.size));
}

Job& Job::current() {
    static Job job;
    return job;
}

std::unique_ptr<PassWorkers> Job::spread(std::unique_ptr<PassWorkers> own, const RankPlan&) { return own; }

void Job::assist(const OpenWorkers&, const std::function<void()>&) {}

void Job::endCurrent() {}

} // namespace quasilux
