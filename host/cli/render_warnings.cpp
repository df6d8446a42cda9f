#include "cli/render_warnings.h"

#include <algorithm>
#include <fmt/format.h>

namespace quasilux {

namespace {

// Photons of caustics that a pixel of a meter needs for its standard error to mean anything.
constexpr uint64_t causticsPerPixel = 30;
// Light that so few photons have brought is not known, nor its noise; less than this share of the image hardly matters.
constexpr double fewestEffectivePhotons = 100, lightThatMatters = 0.01;

std::string cutPaths(const RenderCounters& counters) {
    return fmt::format(
        "{} paths were cut by the limit on events, with {:.3g} % of the flux and {:.3g} % of the camera paths' "
        "throughput",
        counters.cutPaths, counters.fluxEmitted > 0 ? 100 * counters.fluxCut / counters.fluxEmitted : 0.0,
        counters.cameraPaths > 0 ? 100 * counters.throughputCut / static_cast<double>(counters.cameraPaths) : 0.0);
}

std::string rarePhotons(double share, double effective) {
    return fmt::format(
        "{:.2g} % of the image's light comes from photons, but effectively only {:.2g} photons contribute: too few to "
        "estimate that light or its error; render longer, use more --photons, or follow such paths from the camera "
        "(--bdd 1, or "
        "--quasi-specular all --variant alternative)",
        100 * share, effective);
}

bool isBlack(const FilmImage& image) {
    return std::all_of(image.radiance.begin(), image.radiance.end(), [](float value) { return value == 0; });
}

} // namespace

std::vector<std::string> renderWarnings(const RenderCounters& counters, const SceneReport& report,
                                        const FilmImage& image) {
    const uint64_t pixels = uint64_t{image.width} * image.height;
    std::vector<std::string> warnings;
    if (counters.passes > 0 && !report.emitters.empty() && isBlack(image))
        warnings.push_back(
            fmt::format("the scene has light, but none has reached the image in {} {}, so that its error "
                        "is not known; see whether the sensor looks at anything that is lit (layers of "
                        "the integrator 'aov' show what it sees), or render longer",
                        counters.passes, counters.passes == 1 ? "pass" : "passes"));
    if (counters.nonFinite > 0)
        warnings.push_back(fmt::format("{} samples were not finite and were dropped, the image lacks their light",
                                       counters.nonFinite));
    if (counters.overflows > 0)
        warnings.push_back(fmt::format(
            "{} sums of splats left their range: the image is wrong there, use --map photons", counters.overflows));
    if (counters.clipped > 0)
        warnings.push_back(fmt::format(
            "{} photons carried more flux than can be stored and were cut to that: the image lacks the rest",
            counters.clipped));
    if (counters.meterCaustics && *counters.meterCaustics < causticsPerPixel * pixels)
        warnings.push_back(
            fmt::format("{} photons of caustics have hit the meter's {} pixels: too few to estimate that light or "
                        "its error; use a larger meter or cells, more --photons or passes, or, for "
                        "quasi-caustics, --variant alternative",
                        *counters.meterCaustics, pixels));
    if (counters.cutPaths > 0) warnings.push_back(cutPaths(counters));
    const auto& learned = report.learned;
    if (learned.effectivePhotons && learned.lightOfPhotons >= lightThatMatters) {
        const double effective = *learned.effectivePhotons * static_cast<double>(counters.passes);
        if (effective < fewestEffectivePhotons) warnings.push_back(rarePhotons(learned.lightOfPhotons, effective));
    }
    return warnings;
}

} // namespace quasilux
