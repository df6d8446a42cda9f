// Who renders passes: devices of this process, or ranks of an MPI job with theirs. Each takes passes by their numbers;
// their sums are asked for all at once.
#pragma once

#include "output/render_checkpoint.h"
#include "share/pass_sums.h"
#include "util/memory_state.h"

#include <memory>
#include <optional>
#include <string>

namespace quasilux {

/// Renderer::saveRadii().
struct RadiiState {
    MemoryState state;
    bool areChosen = false; ///< Renderer::radiiAreChosen()
};

struct WorkerEvent {
    enum class Kind {
        opened,   ///< and may be given passes; has a `name`
        rendered, ///< the `passes` that it was given, in `seconds`
        gave,     ///< the sums of all passes that it had rendered when it was asked
        failed,   ///< and says no more; all that it has not given is lost
        summed    ///< none of one worker: the sums of all that were asked and have not failed are there
    };
    Kind kind = Kind::opened;
    size_t worker = 0;
    std::string name, why;
    PassRange passes;
    double seconds = 0, squaredSeconds = 0;  ///< the sum, and that of the squares of single passes
    uint64_t photons = 0, paths = 0;         ///< of those passes
    std::shared_ptr<const RadiiState> radii; ///< of one that has chosen them, or is about to; null: known already
};

class PassWorkers {
public:
    virtual ~PassWorkers() = default;

    /// The next event, waiting for it for so long at most. Workers are numbered as they are opened or fail.
    virtual std::optional<WorkerEvent> wait(double seconds) = 0;
    /// Are there some that have neither opened nor failed yet?
    virtual bool areOpening() const = 0;

    /// After what it was given before.
    virtual void render(size_t worker, const PassRange& passes) = 0;
    /// To all, also those that are still opening: these are the radii of all passes to come.
    virtual void giveRadii(const RadiiState& radii) = 0;
    /// Each that is open gives its sums once it has rendered what it was given before. Not again before `summed`.
    virtual void askForSums() = 0;
    /// After `summed`, once.
    virtual PassSums takeSums() = 0;
};

} // namespace quasilux
