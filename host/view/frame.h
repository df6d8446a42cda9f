// A picture as the page draws it: one layer, linear, in half precision.
#pragma once

#include "output/png.h"
#include "render/film_cut.h"

#include <optional>
#include <string>
#include <vector>

namespace quasilux {

/// What the page wants to see.
struct FrameWish {
    std::string layer = "image";                  ///< one of layersOf()
    unsigned x = 0, y = 0, width = 0, height = 0; ///< pixels of the film
    unsigned step = 1;                            ///< pixels of the film, each way, for one of the frame
};

/// "image", components, "stderr", "bias", "relative_error", as far as the film has them.
std::vector<std::string> layersOf(const FilmLayout& film);

/// Whether a layer is of values, as image and components are; or else of errors.
bool isValueLayer(const std::string& layer);

/// The wish as far as the film goes, thinned to what a screen shows. `mostRead`: while the render goes on, how many of
/// the film's pixels may be read where the picture is thinned. Throws InputError where the film has no such layer.
FilmCutChoice cutFor(const FrameWish& wish, const Film& film, std::optional<size_t> mostRead);
/// How many pixels of the film that reads.
size_t pixelsRead(const FilmCutChoice& choice);

struct Frame {
    unsigned x = 0, y = 0, step = 1; ///< where it lies in the film
    unsigned width = 0, height = 0;  ///< pixels of the frame
    unsigned channels = 3;           ///< 3: colours; 1: figures
    unsigned passes = 0;
    bool isKnown = true;          ///< or else the figures say nothing: standard errors after a single pass
    double scale = 1;             ///< on the values, so that halves hold them
    ToneCurve curve;              ///< the automatic one, for what this piece shows, of a figure for the image
    double meanRadiance = 0;      ///< of this piece
    std::vector<uint16_t> halves; ///< row by row, channels side by side
};

/// `mean`: what relative errors are relative to where the image is dark, the mean radiance of the whole image; 0: that
/// of the piece. Figures of a pixel are over R, G, B: of "stderr" the root mean square, W sr^-1 m^-2; of
/// "relative_error" the same, each relative to sqrt(value^2 + 0.01 mean^2); of "bias" the mean, relative likewise.
Frame makeFrame(const FrameWish& wish, const FilmCutChoice& choice, const FilmImage& cut, double mean);

/// IEEE 754 binary16 nearest to `value`, ties to even; what is too large becomes the largest one.
uint16_t toHalf(float value);

} // namespace quasilux
