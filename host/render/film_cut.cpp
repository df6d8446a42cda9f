#include "render/film_cut.h"

namespace quasilux {

namespace {

// Components lie behind all else, so that what is wanted comes first in a pixel (kernels/film_sums.h).
FilmLayout layoutOf(const FilmLayout& film, const FilmCutChoice& choice) {
    if (film.components && choice.hasComponents) return film;
    return {film.bias && choice.hasBias, false};
}

shared::FilmCut cutOf(const Film& film, const FilmCutChoice& choice, size_t floats) {
    shared::FilmCut cut{};
    cut.x = choice.x;
    cut.y = choice.y;
    cut.step = choice.step;
    cut.columns = (choice.width + choice.step - 1) / choice.step;
    cut.rows = (choice.height + choice.step - 1) / choice.step;
    cut.isMean = choice.isMean;
    cut.filmWidth = film.width();
    cut.filmHeight = film.height();
    cut.filmFloats = static_cast<unsigned>(film.layout().floatsPerPixel());
    cut.floats = static_cast<unsigned>(floats);
    return cut;
}

} // namespace

FilmImage FilmCutter::develop(const Film& film, unsigned passes, const FilmCutChoice& choice) {
    const FilmLayout layout = layoutOf(film.layout(), choice);
    shared::FilmCut cut = cutOf(film, choice, layout.floatsPerPixel());
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
    FilmDeveloper developer(layout, film.counts(), passes, image);
    developer.develop(sums.read().data(), 0, pixels);
    developer.finish();
    device_.resetTimings(std::move(timings));
    return image;
}

} // namespace quasilux
