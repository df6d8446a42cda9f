#include "ranks/job.h"

#include <cstdlib>
#include <initializer_list>
#include <utility>

namespace quasilux {

// Open MPI's own names, then those of PMI-2 and PMIx as srun sets them.
LaunchedAs launchedAs() {
    LaunchedAs launched;
    using Names = std::pair<const char*, const char*>;
    for (const auto& [rank, size] : {Names("OMPI_COMM_WORLD_RANK", "OMPI_COMM_WORLD_SIZE"),
                                     Names("PMI_RANK", "PMI_SIZE"), Names("PMIX_RANK", "SLURM_NTASKS")}) {
        const char *number = std::getenv(rank), *count = std::getenv(size);
        if (!number || !count) continue;
        launched.rank = static_cast<unsigned>(std::strtoul(number, nullptr, 10));
        launched.size = static_cast<unsigned>(std::strtoul(count, nullptr, 10));
        break;
    }
    return launched;
}

} // namespace quasilux
