// Programs that are built without MPI, whatever this build has: the job is one rank, and one of several is refused.
#include "ranks/job.h"
#include "util/error.h"

#include <cstdlib>
#include <gmock/gmock.h>

namespace quasilux {
namespace {

class JobAlone : public testing::Test {
protected:
    JobAlone() {
        for (const char* name :
             {"OMPI_COMM_WORLD_RANK", "OMPI_COMM_WORLD_SIZE", "PMI_RANK", "PMI_SIZE", "PMIX_RANK", "SLURM_NTASKS"})
            unsetenv(name);
    }
};

struct Launcher {
    const char *rank, *size;
};
constexpr Launcher launchers[] = {
    {"OMPI_COMM_WORLD_RANK", "OMPI_COMM_WORLD_SIZE"}, {"PMI_RANK", "PMI_SIZE"}, {"PMIX_RANK", "SLURM_NTASKS"}};

TEST_F(JobAlone, RefusesToBeOneOfSeveral) {
    for (const Launcher& launcher : launchers) {
        setenv(launcher.rank, "1", 1);
        setenv(launcher.size, "2", 1);
        EXPECT_EQ(launchedAs().size, 2u) << launcher.rank;
        try {
            Job::current();
            ADD_FAILURE() << launcher.rank;
        } catch (const InputError& error) {
            EXPECT_THAT(error.what(), testing::HasSubstr("started as rank 1 of 2, but built without MPI"));
        }
        unsetenv(launcher.rank);
        unsetenv(launcher.size);
    }
    EXPECT_EQ(Job::current().size(), 1u) << "control: nothing has started it";
}

// srun sets SLURM_NTASKS of programs that are no MPI program, too.
TEST_F(JobAlone, NeedsBothNumbersToBeARank) {
    for (const Launcher& launcher : launchers) {
        setenv(launcher.size, "2", 1);
        EXPECT_EQ(launchedAs().size, 1u) << launcher.size;
        unsetenv(launcher.size);
    }
}

} // namespace
} // namespace quasilux
