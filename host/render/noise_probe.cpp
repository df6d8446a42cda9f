#include "render/noise_probe.h"

#include "render/coarse_camera.h"
#include "render/error_estimate.h"
#include "util/stopwatch.h"

#include <algorithm>

namespace quasilux {

namespace {

// Of a half: the variance of passes of a pixel is known to some 15 % in the mean over a block and its neighbours.
constexpr double samplesOfHalf = 1 << 15;
constexpr double fewestPasses = 8, mostPasses = 32;
// The paths of a pass lie on nets: what rare paths find stays when what is smooth has gone, and one path does not tell
// them apart. 16 do (docs/notes/camera-paths.md).
constexpr unsigned mostPathsOfPass = 16;
constexpr double mostPathsOfHalf = 1 << 19;
// The brightness, which errors are relative to, needs what photons carry too.
constexpr unsigned passesThatGather = 4;
constexpr unsigned passesThatCount = 2;
// A pass of so many paths of each pixel tells as much about times as one of more.
constexpr unsigned mostTimedPaths = 4;
// Of what a ray that meets nothing costs: shading, choosing an emitter, its ray and the next one
// (docs/notes/camera-paths.md).
constexpr double costOfEvent = 8;
constexpr FilmLayout layout{false, true};
using Brings = CameraStage::Brings;
const std::string owner = "noise probe's ";

shared::Camera coarseOf(const shared::Camera& camera) { return coarseCamera(camera, coarseBlock(camera)); }

unsigned passesOfHalf(const shared::Camera& coarse) {
    return static_cast<unsigned>(
        std::clamp(samplesOfHalf / (double(coarse.width) * coarse.height), fewestPasses, mostPasses));
}

// No more than the image has.
unsigned pathsOfPass(const shared::Camera& coarse, unsigned paths) {
    const double ofOne = double(passesOfHalf(coarse)) * coarse.width * coarse.height;
    unsigned most = 1;
    while (2 * most <= std::min(paths, mostPathsOfPass) && 2 * most * ofOne <= mostPathsOfHalf) most *= 2;
    return most;
}

// What photons carry, of `classes` (bits); paths may find a part of its direct light themselves, which is there
// already.
void addPhotons(const FilmImage& gathered, const FilmImage& found, unsigned classes, std::vector<float>& radiance) {
    const auto at = [](const std::vector<float>& values, size_t k) { return values.empty() ? 0.f : values[k]; };
    for (unsigned c = 0; c < LIGHT_CLASSES; ++c)
        for (size_t k = 0; k < radiance.size() && (classes >> c & 1); ++k)
            radiance[k] += at(gathered.components[c].radiance, k) - at(found.components[c].radiance, k);
}

} // namespace

NoiseProbe::NoiseProbe(Device& device, CameraStage& paths, PassPhotons& photons, const shared::Camera& camera,
                       unsigned classes, unsigned pathsByPixel)
    : device_(device), paths_(paths), photons_(photons), coarse_(coarseOf(camera)), pathsByPixel_(pathsByPixel),
      passes_(passesOfHalf(coarse_)), pathsOfPass_(pathsOfPass(coarse_, pathsByPixel)) {
    measure(classes);
}

BufferSizes NoiseProbe::plan(const shared::Camera& camera) {
    const shared::Camera coarse = coarseOf(camera);
    BufferSizes sizes = Film::plan(size_t(coarse.width) * coarse.height, layout, Film::inOneBuffer, owner);
    sizes.merge(PathCounts::plan(coarse, false, owner));
    return sizes;
}

double NoiseProbe::costByPixel(const shared::Camera& camera, unsigned pathsByPixel) {
    const shared::Camera coarse = coarseOf(camera);
    const double ofHalf = double(passesOfHalf(coarse)) * pathsOfPass(coarse, pathsByPixel);
    const double paths = 2 * ofHalf + passesThatGather + passesThatCount + 4 * mostTimedPaths;
    return paths * coarse.width * coarse.height / (double(camera.width) * camera.height);
}

// Two halves that know nothing of each other, relative to one brightness.
void NoiseProbe::measure(unsigned classes) {
    const FilmImage halves[2] = {render(Brings::ownLight, 0, passes_), render(Brings::ownLight, passes_, passes_)};
    std::vector<float> brightness = halves[0].radiance;
    for (size_t k = 0; k < brightness.size(); ++k) brightness[k] = (brightness[k] + halves[1].radiance[k]) / 2;
    if (photons_.areTaken()) {
        photons_.traceUncounted(0, photons_.parts().front());
        addPhotons(render(Brings::allLight, 0, passesThatGather), halves[0], classes, brightness);
    }
    const std::vector<double> cost = costByBlock();
    for (unsigned k = 0; k < 2; ++k) {
        const unsigned tiles = std::max(coarse_.width, coarse_.height);
        halves_[k] = {coarse_.width, coarse_.height, errorByTile(halves[k], tiles, brightness).noise, cost};
    }
}

std::vector<double> NoiseProbe::costByBlock() {
    const FilmImage counted = render(Brings::rays, 0, passesThatCount);
    std::vector<double> cost;
    cost.reserve(counted.radiance.size() / 3);
    for (size_t k = 0; k < counted.radiance.size(); k += 3)
        cost.push_back(1 + costOfEvent * std::max(0.0, counted.radiance[k] - 1.0));
    return cost;
}

FilmImage NoiseProbe::render(Brings brings, unsigned from, unsigned passes) {
    Film film(device_, coarse_.width, coarse_.height, layout, Film::inOneBuffer, owner);
    const PathCounts counts(device_, coarse_, brings == Brings::ownLight ? pathsOfPass_ : 1, owner);
    for (unsigned pass = 0; pass < passes; ++pass) {
        paths_.runCoarse(film, coarse_, from + pass, brings, counts, photons_.stage());
        film.endPass();
    }
    return film.develop(passes);
}

std::vector<uint32_t> NoiseProbe::allocate() { return allocatePaths(meanOf(halves_[0], halves_[1]), pathsByPixel_); }

double NoiseProbe::secondsOf(const PathCounts& paths) {
    Film film(device_, coarse_.width, coarse_.height, layout, Film::inOneBuffer, owner);
    device_.finish();
    const Stopwatch watch;
    paths_.runCoarse(film, coarse_, 0, Brings::ownLight, paths, photons_.stage());
    device_.finish();
    return watch.seconds();
}

SamplingGain NoiseProbe::gain() {
    const unsigned paths = pathsByPixel_;
    double inverse = 0; // of the variance that is saved
    for (unsigned k = 0; k < 2; ++k)
        inverse += 0.5 / varianceSaved(halves_[1 - k], allocatePaths(halves_[k], paths), paths);
    // Fewer than asked for are timed: how far the modelled cost is off does not depend on the number.
    const PathNoise noise = meanOf(halves_[0], halves_[1]);
    const unsigned timed = std::min(paths, mostTimedPaths);
    const std::vector<uint32_t> counts = allocatePaths(noise, timed);
    const PathCounts byPixel(device_, coarse_, 1, counts, owner), even(device_, coarse_, timed, owner);
    const double first = secondsOf(byPixel), evenly = secondsOf(even) + secondsOf(even), last = secondsOf(byPixel);
    const double measuredOverModel = (first + last) / evenly / costShare(noise, counts, timed);
    return {1 / inverse, measuredOverModel * costShare(noise, allocatePaths(noise, paths), paths)};
}

} // namespace quasilux
