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
    const auto& stated = image.fisheye;
    const Projection projection = parseProjection(options.projection.value_or(stated ? stated->first : "equidistant"));
    if (projection == Projection::perspective && !options.degrees)
        throw InputError("--projection perspective: the image does not say how wide it is; give --fov DEGREES");
    // Of another projection the header says no angle.
    const bool isStated = stated && parseProjection(stated->first) == projection;
    const double degrees = options.degrees.value_or(isStated ? stated->second : 180);
    if (projection == Projection::perspective && degrees > 175)
        throw InputError(fmt::format("--fov {}: a perspective image spans at most 175 degrees here", degrees));
    return {projection, degrees * std::numbers::pi / 180};
}

/// As EN 17037 draws the lines.
const char* classOf(double probability) {
    if (probability <= 0.35) return "imperceptible";
    if (probability <= 0.40) return "perceptible";
    return probability <= 0.45 ? "disturbing" : "intolerable";
}

std::vector<std::string> warningsOf(const LuminanceImage& image, const std::string& path, const DaylightGlare& glare) {
    std::vector<std::string> warnings;
    if (const auto warning = warningOfUnits(image.isPerNanometre, image.unit(), path)) warnings.push_back(*warning);
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
        readLuminance(options.input, options.photometric ? ImageUnits::photometric : ImageUnits::asHeaderSays);
    const View view = viewOf(options, image);
    if (image.isIlluminance)
        throw InputError(fmt::format("{}: is an image of irradiance; DGP is of what a camera sees", options.input));
    if (!std::all_of(image.values.begin(), image.values.end(), [](float v) { return v >= 0 && v < 1e30F; }))
        throw InputError(
            fmt::format("{}: some pixels are negative or not finite; DGP needs all of them", options.input));
    const DaylightGlare glare = daylightGlare(image, view, options.threshold, options.illuminance);
    if (!options.illuminance && glare.covered < enoughOfField)
        throw InputError(fmt::format("{}: shows {:.0f} % of what lights the eye, so that the illuminance there is not "
                                     "known; give --illuminance LX, "
                                     "as a meter at the eye reads it, or a fisheye image of 180 degrees",
                                     options.input, 100 * glare.covered));
    const auto warnings = warningsOf(image, options.input, glare);
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
