// A piece of the film as it is between two passes, for somebody who looks: little to read, however large the film is.
#pragma once

#include "device/program.h"
#include "render/film.h"

#include <optional>

namespace quasilux {

/// Which piece, and what of it.
struct FilmCutChoice {
    unsigned x = 0, y = 0, width = 0, height = 0; ///< in pixels of the film, not empty and within it
    unsigned step = 1;                            ///< pixels of a block's side, of which one pixel of the piece is made
    /// Means are taken of these of a block's pixels: CUT_ALL, CUT_DIAGONAL, CUT_MIDDLE. Of standard errors the one in
    /// the middle, as those of means would hold the differences between pixels, too.
    unsigned sampling = CUT_ALL;
    /// Values: FilmImage::radiance alone, of the image or, in its place, of a component. Errors: of the image and,
    /// where the film has it, its bias. All: whatever the film has.
    enum class Content { values, errors, all } content = Content::values;
    std::optional<unsigned> component; ///< which the film has
};

class FilmCutter {
public:
    explicit FilmCutter(Device& device) : device_(device) {}

    /// In the middle of a pass, when some pixels have more of them than `passes`, Content::values alone: each is its
    /// own mean then.
    FilmImage develop(const Film& film, unsigned passes, const FilmCutChoice& choice);

private:
    Device& device_;
    std::optional<Program> program_; ///< compiled when somebody looks
};

} // namespace quasilux
