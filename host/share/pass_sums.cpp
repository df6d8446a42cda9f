#include "share/pass_sums.h"

#include "render/film_merge.h"
#include "render/render_counters.h"
#include "util/error.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <stdexcept>

namespace quasilux {

namespace {

/// The film alone, as Film::save() names it.
class FilmSink : public StateSink {
public:
    explicit FilmSink(std::vector<float>& film) : film_(film) {}
    void begin(const std::string& name) override { isFilm_ = name == "film"; }
    void write(const void* data, size_t bytes) override {
        if (!isFilm_) return;
        const auto* first = static_cast<const float*>(data);
        film_.insert(film_.end(), first, first + bytes / sizeof(float));
    }

private:
    std::vector<float>& film_;
    bool isFilm_ = false;
};

void requireFinite(const std::vector<float>& film, const std::string& device) {
    const auto bad = std::count_if(film.begin(), film.end(), [](float value) { return !std::isfinite(value); });
    if (bad > 0)
        throw DeviceError(fmt::format("device {}: {} sums of its film are not finite, expected none: its results "
                                      "cannot be trusted",
                                      device, bad));
}

} // namespace

PassSums takeSums(Device& device, Renderer& renderer) {
    PassSums sums;
    sums.shape = renderer.filmShape();
    sums.counters = renderer.counters();
    if (sums.counters.passes == 0) return sums;
    sums.film.reserve(sums.pixels() * sums.shape.layout.floatsPerPixel());
    FilmSink sink(sums.film);
    renderer.film().save(sink, "film");
    requireFinite(sums.film, device.info().name);
    closeBatches(sums.film.data(), renderer.film().counts(), sums.pixels(), sums.shape.layout);
    sums.counts = renderer.film().counts().closed();
    sums.timings = device.timings();
    renderer.clearPasses();
    device.resetTimings({});
    return sums;
}

void addAllButFilm(PassSums& all, const PassSums& part) {
    if (part.counters.passes == 0) return;
    if (all.counters.passes == 0) {
        all.shape = part.shape;
        all.counts = part.counts;
        all.counters = part.counters;
    } else {
        all.counts = mergedCounts(all.counts, part.counts);
        addCounts(all.counters, part.counters);
    }
    addTimings(all.timings, part.timings);
}

void add(PassSums& all, const PassSums& part) {
    if (part.isEmpty()) return;
    if (all.isEmpty()) {
        all = part;
        return;
    }
    if (all.film.size() != part.film.size()) throw std::logic_error("films of different sizes cannot be added");
    mergeFilmSums(all.film.data(), all.counts, part.film.data(), part.counts, all.pixels(), all.shape.layout);
    addAllButFilm(all, part);
}

FilmImage PassSums::develop() const {
    FilmImage image;
    image.width = shape.width;
    image.height = shape.height;
    FilmDeveloper developer(shape.layout, counts, static_cast<unsigned>(counters.passes), image);
    developer.develop(film.data(), 0, pixels());
    developer.finish();
    return image;
}

void PassSums::save(StateSink& sink, const std::string& name) const {
    sink.record(name + " counts", counts);
    sink.record(name + " counters", shared::CameraCounters{}); // only what is added to it matters
    sink.array(name, film);
}

} // namespace quasilux
