#include "render/film_cut.h"

#include <algorithm>

namespace quasilux {

namespace {

using Content = FilmCutChoice::Content;

// Components lie behind all else, so that errors of the image come first in a pixel (kernels/film_sums.h).
FilmLayout layoutOf(const FilmLayout& film, Content content) {
    return {film.bias, film.components && content == Content::all};
}

shared::FilmCut cutOf(const Film& film, unsigned passes, const FilmCutChoice& choice) {
    shared::FilmCut cut{};
    cut.x = choice.x;
    cut.y = choice.y;
    cut.step = choice.step;
    cut.columns = (choice.width + choice.step - 1) / choice.step;
    cut.rows = (choice.height + choice.step - 1) / choice.step;
    cut.sampling = choice.sampling;
    cut.filmWidth = film.width();
    cut.filmHeight = film.height();
    cut.filmFloats = static_cast<unsigned>(film.layout().floatsPerPixel());
    cut.pixelsAhead = static_cast<unsigned>(film.pixelsAhead());
    cut.aheadWeight = passes > 0 ? static_cast<float>(passes) / static_cast<float>(passes + 1) : 1.f;
    if (choice.component)
        cut.firstFloat = FILM_COMPONENT_SUMS(film.layout().bits()) + *choice.component * FILM_SUM_FLOATS;
    cut.floats = choice.content == Content::values
                     ? FILM_SUM_FLOATS
                     : static_cast<unsigned>(layoutOf(film.layout(), choice.content).floatsPerPixel());
    return cut;
}

void developValues(const std::vector<float>& sums, unsigned passes, FilmImage& image) {
    image.passes = passes;
    image.radiance.resize(size_t(image.width) * image.height * 3);
    for (size_t k = 0; k < image.radiance.size(); ++k)
        image.radiance[k] =
            static_cast<float>(valueOfSum(&sums[k / 3 * FILM_SUM_FLOATS], k % 3) / std::max(1u, passes));
}

} // namespace

FilmImage FilmCutter::develop(const Film& film, unsigned passes, const FilmCutChoice& choice) {
    shared::FilmCut cut = cutOf(film, passes, choice);
    const size_t pixels = size_t(cut.columns) * cut.rows;
    auto timings = device_.timings(); // of passes alone
    if (!program_) program_.emplace(device_, "film_cut.cl", "");
    Buffer<float> sums(device_, pixels * cut.floats, "piece of the film");
    sums.fill(0);
    Kernel kernel = program_->kernel("cutFilm");
    for (const Film::Part& part : film.parts()) {
        cut.firstPixel = static_cast<unsigned>(part.firstPixel);
        cut.pixels = static_cast<unsigned>(part.pixels);
        kernel.launch(pixels, part.sums, sums, cut);
    }
    FilmImage image;
    image.width = cut.columns;
    image.height = cut.rows;
    if (choice.content == Content::values) {
        developValues(sums.read(), passes, image);
    } else {
        FilmDeveloper developer(layoutOf(film.layout(), choice.content), film.counts(), passes, image);
        developer.develop(sums.read().data(), 0, pixels);
        developer.finish();
    }
    device_.resetTimings(std::move(timings));
    return image;
}

} // namespace quasilux
