#include "cli/commands.h"

#include "cli/text_table.h"
#include "photometry/daylight_glare.h"
#include "util/error.h"
#include "util/messages.h"

#include <algorithm>
#include <fmt/format.h>
#include <nlohmann/json.hpp>
#include <numbers>

namespace quasilux {

namespace {

// What an image must show of the illuminance of a uniform field for its own to stand for that at the eye; and how many
// sources are listed.
constexpr double enoughOfField = 0.98;
constexpr size_t listedSources = 10;

View viewOf(const DgpOptions& options, const LuminanceImage& image) {
    const auto& stated = image.view;
    if (image.isViewUnknown && !options.projection)
        throw InputError(options.input +
                         ": its header does not say how it shows directions, as of a part of a view, an orthographic "
                         "camera or an older version; render it anew as a whole, by a "
                         "quasilux_fisheye, or give --projection NAME and --fov DEGREES");
    const std::string name = options.projection.value_or(stated ? stated->first : "equidistant");
    const Projection projection = parseProjection(name);
    const bool isStated = stated && stated->first == name; // of another projection the header says no angle
    if (projection == Projection::perspective && !options.degrees && !isStated)
        throw InputError("--projection perspective: the image does not say how wide it is; give --fov DEGREES");
    const double degrees = options.degrees.value_or(isStated ? stated->second : 180);
    if (projection == Projection::perspective && degrees > 175)
        throw InputError(
            fmt::format("{}: is {} degrees wide; a perspective image spans at most 175 here", options.input, degrees));
    return {projection, degrees * std::numbers::pi / 180};
}

void checkPixels(const DgpOptions& options, const LuminanceImage& image) {
    if (image.isIlluminance)
        throw InputError(fmt::format("{}: is an image of irradiance; DGP is of what a camera sees", options.input));
    if (!image.part.empty())
        throw InputError(fmt::format("{0}: has {1}; DGP needs all of them: render the whole view or, where all about "
                                     "these pixels is black, make it whole: oiiotool {0} --croptofull -o whole.exr",
                                     options.input, image.part));
    if (!std::all_of(image.values.begin(), image.values.end(), [](float v) { return v >= 0 && v < 1e30F; }))
        throw InputError(
            fmt::format("{}: some pixels are negative or not finite; DGP needs all of them", options.input));
}

/// As EN 17037 draws the lines.
const char* classOf(double probability) {
    if (probability <= 0.35) return "imperceptible";
    if (probability <= 0.40) return "perceptible";
    return probability <= 0.45 ? "disturbing" : "intolerable";
}

std::vector<std::string> warningsOf(const LuminanceImage& image, const DaylightGlare& glare) {
    std::vector<std::string> warnings;
    if (!image.unitsWarning.empty()) warnings.push_back(image.unitsWarning);
    if (glare.illuminance < leastIlluminanceOfGlare)
        warnings.push_back(fmt::format("{:.4g} lx at the eye: DGP was made from {:g} lx on", glare.illuminance,
                                       leastIlluminanceOfGlare));
    if (glare.probability < leastProbability || glare.probability > largestProbability)
        warnings.push_back(fmt::format("DGP was made between {:g} and {:g}: beyond it is no probability",
                                       leastProbability, largestProbability));
    return warnings;
}

nlohmann::json glareJson(const DgpOptions& options, const DaylightGlare& glare,
                         const std::vector<std::string>& warnings) {
    nlohmann::json sources = nlohmann::json::array();
    for (const auto& source : glare.sources)
        sources.push_back({{"luminance", source.luminance},
                           {"solidAngle", source.solidAngle},
                           {"positionIndex", source.positionIndex},
                           {"pixels", source.pixels}});
    return {{"version", QUASILUX_VERSION},
            {"image", options.input},
            {"DGP", glare.probability},
            {"standardErrorAtMost", glare.standardError ? nlohmann::json(*glare.standardError) : nlohmann::json()},
            {"class", classOf(glare.probability)},
            {"illuminance", glare.illuminance},
            {"illuminanceStandardErrorAtMost",
             glare.illuminanceError ? nlohmann::json(*glare.illuminanceError) : nlohmann::json()},
            {"covered", glare.covered},
            {"threshold", options.threshold},
            {"sources", sources},
            {"warnings", warnings}};
}

std::string within(const std::optional<double>& error) {
    return error ? fmt::format(" +- {:.2g} at most", *error) : ", standard error not known";
}

void printGlare(const DgpOptions& options, const DaylightGlare& glare) {
    fmt::print("DGP {:.4f}{}: {}\n", glare.probability, within(glare.standardError), classOf(glare.probability));
    fmt::print("vertical illuminance {:.5g} lx{}\n", glare.illuminance,
               options.illuminance ? ", as given" : within(glare.illuminanceError));
    fmt::print("{} sources from {:g} cd/m2 on\n", glare.sources.size(), options.threshold);
    TextTable table({"luminance (cd/m2)", "solid angle (sr)", "position index", "pixels"});
    for (size_t k = 0; k < std::min(glare.sources.size(), listedSources); ++k) {
        const auto& source = glare.sources[k];
        table.add({fmt::format("{:.5g}", source.luminance), fmt::format("{:.4g}", source.solidAngle),
                   fmt::format("{:.3g}", source.positionIndex), fmt::format("{}", source.pixels)});
    }
    if (!glare.sources.empty()) fmt::print("{}", table.text());
}

} // namespace

int dgpCommand(const DgpOptions& options) {
    const LuminanceImage image =
        readLuminance(options.input, options.photometric ? std::optional(1.0) : options.efficacy);
    checkPixels(options, image);
    const View view = viewOf(options, image);
    const DaylightGlare glare = daylightGlare(image, view, options.threshold, options.illuminance);
    if (!options.illuminance && glare.covered < enoughOfField)
        throw InputError(fmt::format("{}: shows {:.0f} % of what lights the eye, so that the illuminance there is not "
                                     "known; give --illuminance LX, "
                                     "as a meter at the eye reads it, or a fisheye image of 180 degrees",
                                     options.input, 100 * glare.covered));
    const auto warnings = warningsOf(image, glare);
    if (!options.quiet)
        for (const auto& warning : warnings) printWarning(warning);
    if (options.json)
        fmt::print("{}\n",
                   glareJson(options, glare, warnings).dump(2, ' ', false, nlohmann::json::error_handler_t::replace));
    else if (!options.quiet)
        printGlare(options, glare);
    return 0;
}

} // namespace quasilux
