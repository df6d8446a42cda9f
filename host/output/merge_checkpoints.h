// Passes of several checkpoints as those of one.
#pragma once

#include "output/render_checkpoint.h"
#include "render/film.h"

namespace quasilux {

class MergedPasses {
public:
    /// In the order of their passes, whatever that of `paths`. Throws InputError where one is damaged, where two are
    /// not of one image, or have a pass in common.
    explicit MergedPasses(const std::vector<std::string>& paths);

    const Checkpoint& checkpoint() const { return checkpoint_; }
    FilmImage develop() const;
    /// A checkpoint like the others. What was learned, and radii, are those of the part with the last passes.
    void write(const std::string& path) const;

private:
    void add(const CheckpointReader& reader, const Checkpoint& part);

    Checkpoint checkpoint_;
    std::vector<float> sums_;
    FilmCounts counts_;
    std::unique_ptr<CheckpointReader> last_;
};

} // namespace quasilux
