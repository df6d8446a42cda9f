// The film on the device (kernels/film.clh): sums over passes by pixel, and what they say of the image.
#pragma once

#include "pass_types.h"
#include "render/film_image.h"
#include "render/film_layout.h"
#include "render/pass_part.h"
#include "render/planned_buffer.h"
#include "util/state_archive.h"

#include <functional>
#include <string>
#include <vector>

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

/// Means over passes, their standard errors and bias, from the sums of pixels.
class FilmDeveloper {
public:
    /// `image`: of the film's size, an older one or empty.
    FilmDeveloper(const FilmLayout& layout, const FilmCounts& counts, unsigned passes, FilmImage& image);
    /// From the sums of so many pixels from the first one on.
    void develop(const float* sums, size_t firstPixel, size_t pixels);
    /// All pixels are there.
    void finish();

private:
    bool knowsBias() const;

    FilmLayout layout_;
    FilmCounts counts_;
    unsigned passes_;
    FilmImage& image_;
};

class Film {
public:
    /// `layout.bias`: the kernels were compiled with ESTIMATE_BIAS. `owner` goes before the buffers' labels.
    Film(Device& device, unsigned width, unsigned height, FilmLayout layout, uint64_t largestBuffer = inOneBuffer,
         const std::string& owner = "");

    static constexpr uint64_t inOneBuffer = UINT64_MAX;

    /// Rows one after the other; as many pixels as `largestBuffer` bytes hold.
    struct Part {
        size_t firstPixel = 0, pixels = 0;
        Buffer<float> sums;
    };
    /// The buffers that it has, by label.
    static BufferSizes plan(size_t pixels, FilmLayout layout, uint64_t largestBuffer = inOneBuffer,
                            const std::string& owner = "");

    /// What the kernels are to know of a pass that adds to the film.
    struct Pass {
        float batchWeight = 0; ///< shared::CameraParams::batchWeight
        float biasWeight = 0;  ///< shared::MapParams::biasWeight
        unsigned layout = 0;   ///< shared::CameraParams::filmLayout
    };
    /// To be called once before each part of a pass is added; endPass() after the last one.
    Pass beginPass(unsigned pass, PassPart part = {});
    /// The same of a pass that is a batch of its own: those of a meter have no positions in common, and differ by less
    /// than the sum of a batch is rounded by.
    Pass beginBatch(PassPart part = {});
    void endPass() {
        isWhole_ = true;
        pixelsAhead_ = 0;
    }
    /// The first pixels, so many, have all of the pass that has begun. Where it has several parts, none are noted.
    void noteAhead(size_t pixels) {
        if (pass_.layout & FILM_IN_PARTS) return;
        pixelsAhead_ = pixels;
        if (onRows_) onRows_();
    }
    size_t pixelsAhead() const { return pixelsAhead_; }
    /// Called whenever more pixels have all of a pass, by the thread that renders; empty: no more. Who looks on changes
    /// nothing. `isAwaited`: somebody waits for them now.
    void watchRows(std::function<void()> onRows, bool isAwaited = false) const {
        onRows_ = std::move(onRows);
        isAwaited_ = isAwaited;
    }
    bool isAwaited() const { return isAwaited_; }
    /// All passes that have begun have ended; or else a part of one may be in the sums.
    bool isWhole() const { return isWhole_; }

    /// Means over `passes`, their standard errors and bias.
    FilmImage develop(unsigned passes) const;
    /// The same over an older image. Pixels that cannot be read stay as they are, and the image has as many passes as
    /// before.
    void developOver(FilmImage& image, unsigned passes) const;
    /// Samples dropped and paths cut since the beginning.
    shared::CameraCounters counters() const { return counters_.read().front(); }

    /// All that later passes and the image depend on. `name` goes before the arrays' names.
    void save(StateSink& sink, const std::string& name) const;
    /// As if no pass had been added.
    void clear();
    /// Throws InputError where it was saved of another film.
    void restore(const StateSource& source, const std::string& name);

    size_t pixels() const { return size_t(width_) * height_; }
    std::vector<Part>& parts() { return parts_; }
    const std::vector<Part>& parts() const { return parts_; }
    unsigned width() const { return width_; }
    unsigned height() const { return height_; }
    const FilmCounts& counts() const { return counts_; }
    /// Of a film that was made to be in one buffer: kernels that add to all of it at once need that.
    Buffer<float>& sums();
    const FilmLayout& layout() const { return layout_; }
    Buffer<shared::CameraCounters>& counterBuffer() { return counters_; }

private:
    Pass ofPart(const Pass& last, PassPart part);
    Pass countPass(unsigned pass);
    Pass countBatch();
    void forEachPiece(const std::function<void(const std::vector<float>& sums, size_t firstPixel)>& use) const;

    unsigned width_, height_;
    FilmLayout layout_;
    bool isWhole_ = true;
    size_t pixelsAhead_ = 0;
    mutable std::function<void()> onRows_;
    mutable bool isAwaited_ = false;
    FilmCounts counts_;
    Pass pass_; ///< that was begun last: its last part
    std::vector<Part> parts_;
    Buffer<shared::CameraCounters> counters_;
};

} // namespace quasilux
