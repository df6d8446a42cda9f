// The film on the device (kernels/film.clh): sums over passes by pixel, and what they say of the image.
#pragma once

#include "device/buffer.h"
#include "pass_types.h"
#include "render/film_image.h"
#include "util/state_archive.h"

namespace quasilux {

/// How often a film was added to.
struct FilmCounts {
    double batches = 0, openPasses = 0; ///< batches that are complete; passes of the one that is not
    double biasPasses = 0;              ///< sum of the weights of passes in the estimate of bias
    double openBiasPasses = 0;          ///< in the batch that is open
    double biasSquares = 0;             ///< sum over complete batches of the squares of theirs

    /// 1 / passes of the batch that is open, 0 where none is.
    double openWeight() const { return openPasses > 0 ? 1 / openPasses : 0; }
    /// As if the batch that is open were complete.
    FilmCounts closed() const {
        return {batches + (openPasses > 0 ? 1 : 0), 0, biasPasses, 0, biasSquares + openBiasPasses * openBiasPasses};
    }
};

/// Means over `passes`, their standard errors and bias, from the sums of all pixels, over an older image of this size or an empty one.
void developSums(const std::vector<float>& sums, bool estimatesBias, const FilmCounts& counts, unsigned passes,
                 FilmImage& image);

class Film {
public:
    /// `estimatesBias`: the kernels were compiled with ESTIMATE_BIAS. `owner` goes before the buffers' labels.
    Film(Device& device, unsigned width, unsigned height, bool estimatesBias, const std::string& owner = "");

    static size_t floatsPerPixel(bool estimatesBias);

    /// What the kernels are to know of a pass that adds to the film.
    struct Pass {
        float batchWeight; ///< shared::CameraParams::batchWeight
        float biasWeight;  ///< shared::MapParams::biasWeight
    };
    /// To be called once before each pass is added, and after it.
    Pass beginPass(unsigned pass);
    void endPass() { isWhole_ = true; }
    /// All passes that have begun have ended; or else a part of one may be in the sums.
    bool isWhole() const { return isWhole_; }

    /// Means over `passes`, their standard errors and bias.
    FilmImage develop(unsigned passes) const;
    /// The same over an older image, which stays as it is if the film cannot be read.
    void developOver(FilmImage& image, unsigned passes) const;
    /// Samples dropped and paths cut since the beginning.
    shared::CameraCounters counters() const { return counters_.read().front(); }

    /// All that later passes and the image depend on. `name` goes before the arrays' names.
    void save(StateSink& sink, const std::string& name) const;
    /// Throws InputError where it was saved of another film.
    void restore(const StateSource& source, const std::string& name);

    size_t pixels() const { return size_t(width_) * height_; }
    Buffer<float>& sums() { return sums_; }
    Buffer<shared::CameraCounters>& counterBuffer() { return counters_; }

private:
    unsigned width_, height_;
    bool estimatesBias_;
    size_t pixelFloats_;
    bool isWhole_ = true;
    FilmCounts counts_;
    Buffer<float> sums_;
    Buffer<shared::CameraCounters> counters_;
};

} // namespace quasilux
