// The stages of a comparison: read, measure, judge, report.
#include "cli/commands.h"

#include "cli/text_table.h"
#include "compare/comparison_json.h"
#include "compare/html_page.h"
#include "output/atomic_file.h"
#include "util/error.h"
#include "util/messages.h"

#include <cmath>
#include <filesystem>
#include <fmt/format.h>

namespace quasilux {

namespace {

void warn(const CompareOptions& options, const std::string& message) {
    if (!options.quiet) printWarning(message);
}

std::vector<Region> regionsOf(const CompareOptions& options, const RadianceImage& image) {
    std::vector<RegionGroup> groups;
    for (const auto& text : options.regions) groups.push_back(parseRegionGroup(text));
    return chooseRegions(options.mask, groups, image.width, image.height);
}

/// "X" or "NAME=X".
void addReferenceNoise(const std::string& text, const std::vector<Region>& regions,
                       std::map<std::string, double>& noise) {
    const auto equals = text.find('=');
    const std::string name = equals == std::string::npos ? "" : text.substr(0, equals);
    const std::string number = equals == std::string::npos ? text : text.substr(equals + 1);
    double value = -1;
    if (!CLI::detail::lexical_cast(number, value) || !(value >= 0) || !std::isfinite(value))
        throw InputError(fmt::format("--reference-noise: '{}' given, expected a number from 0, or NAME=NUMBER", text));
    checkReferenceNoise("--reference-noise " + text, name, value, regions);
    noise[name] = value;
}

std::string pixelNames(const Comparison& comparison, unsigned width) {
    constexpr size_t most = 10;
    std::string text;
    for (size_t i = 0; i < comparison.nonFinitePixels.size() && i < most; ++i)
        text += fmt::format("{}({}, {})", i > 0 ? ", " : "", comparison.nonFinitePixels[i] % width,
                            comparison.nonFinitePixels[i] / width);
    return comparison.nonFinitePixels.size() > most ? text + ", ..." : text;
}

/// One line for each limit that a region exceeds. What is not a number exceeds every limit.
std::vector<std::string> exceededLimits(const CompareOptions& options, const Comparison& comparison) {
    std::vector<std::string> lines;
    const auto check = [&](const std::string& region, const char* measure, double value,
                           const std::optional<double>& limit) {
        if (limit && !(value <= *limit))
            lines.push_back(
                fmt::format("{} of region {} is {:.4g}, the limit is {:g}", measure, region, value, *limit));
    };
    for (const auto& region : comparison.regions) {
        check(region.name, "relMSE", region.netRelMse, options.maximumRelMse);
        check(region.name, "RMSE", region.rmse, options.maximumRmse);
        check(region.name, "relative bias", std::abs(region.relativeBias()), options.maximumBias);
    }
    if (comparison.nonFinitePixels.size() > options.maximumNonFinite)
        lines.push_back(fmt::format("{} pixels are not finite, the limit is {}", comparison.nonFinitePixels.size(),
                                    options.maximumNonFinite));
    return lines;
}

/// Noise in the denominators is reported where it is more than this share of a region's net relMSE.
constexpr double muchOfNet = 0.1;

void warnOfDenominators(const CompareOptions& options, const Comparison& comparison) {
    for (const RegionMeasures& region : comparison.regions) {
        if (!region.denominatorNoise || std::abs(*region.denominatorNoise) <= muchOfNet * std::abs(region.netRelMse))
            continue;
        warn(options,
             fmt::format("relMSE is divided by the squared reference, whose noise adds about {:.1e} to the net "
                         "relMSE {:.1e} of region {}; --scale FILE divides by another image",
                         *region.denominatorNoise, region.netRelMse, region.name));
        return; // one line will do
    }
}

/// Throws InputError.
RadianceImage readScale(const std::string& path, const RadianceImage& reference) {
    RadianceImage scale = readRadiance(path);
    requireEqualSizes(scale, reference);
    for (size_t i = 0; i < scale.radiance.size(); ++i)
        if (!std::isfinite(scale.radiance[i]))
            throw InputError(fmt::format("--scale: {} is not finite at ({}, {}), expected finite values", path,
                                         i / 3 % scale.width, i / 3 / scale.width));
    return scale;
}

/// Infinite is what is divided by a black reference.
std::string numberText(const std::optional<double>& value) {
    return !value ? "unknown" : std::isinf(*value) ? "undefined" : fmt::format("{:.3e}", *value);
}

bool isBlack(const RegionMeasures& region) { return region.referenceLuminance == 0; }

std::vector<TableRow> regionRows(const Comparison& comparison) {
    std::vector<TableRow> rows{{"region", "pixels", "not finite", "relMSE", "reference's noise", "image's noise", "net",
                                "RMSE", "mean", "reference's mean", "bias", "standard error"}};
    for (const auto& region : comparison.regions) {
        const auto error = region.standardError();
        rows.push_back({region.name, std::to_string(region.pixels), std::to_string(region.nonFinite),
                        numberText(region.relMse), numberText(region.referenceNoise), numberText(region.imageNoise),
                        numberText(region.netRelMse), numberText(region.rmse),
                        fmt::format("{:.5g}", region.meanLuminance), fmt::format("{:.5g}", region.referenceLuminance),
                        isBlack(region) ? "undefined" : fmt::format("{:+.3f} %", 100 * region.relativeBias()),
                        isBlack(region) ? "undefined"
                        : error         ? fmt::format("{:.3f} %", 100 * *error / region.referenceLuminance)
                                        : "unknown"});
    }
    return rows;
}

std::string rgbText(const std::array<float, 3>& rgb) {
    return fmt::format("{:.4g} {:.4g} {:.4g}", rgb[0], rgb[1], rgb[2]);
}

std::vector<TableRow> worstRows(const Comparison& comparison) {
    std::vector<TableRow> rows{{"x, y", "image R G B", "reference R G B", "relMSE", "standard errors"}};
    for (const auto& pixel : comparison.worst)
        rows.push_back({fmt::format("{}, {}", pixel.x, pixel.y), rgbText(pixel.image), rgbText(pixel.reference),
                        numberText(pixel.relativeSquare),
                        pixel.standardErrors ? fmt::format("{:+.2f}", *pixel.standardErrors) : "unknown"});
    return rows;
}

/// What holds for the images as a whole, a line each.
std::vector<std::string> remarks(const Comparison& comparison, unsigned width, const std::string& scale) {
    std::vector<std::string> lines;
    if (!comparison.nonFinitePixels.empty())
        lines.push_back(
            fmt::format("not finite: {} pixels of the image, {} of the reference, at {}; {}", comparison.nonFiniteImage,
                        comparison.nonFiniteReference, pixelNames(comparison, width),
                        comparison.nonFiniteLeftOut ? "left out of all measures" : "they spoil what they are part of"));
    for (const auto& region : comparison.regions)
        if (isBlack(region))
            lines.push_back(fmt::format(
                "the reference is black in region {}: what is relative to it is undefined there", region.name));
    if (!scale.empty()) lines.push_back("relMSE is divided by the square of " + scale + ", not of the reference");
    if (comparison.beyondThreeStandardErrors)
        lines.push_back(
            fmt::format("{:.2f} % of values are further than 3 standard errors apart (0.27 % of normal errors "
                        "without bias)",
                        100 * *comparison.beyondThreeStandardErrors));
    return lines;
}

void printJson(const CompareOptions& options, const Comparison& comparison, const std::vector<std::string>& exceeded) {
    nlohmann::json report = comparisonJson(comparison);
    report["version"] = QUASILUX_VERSION;
    report["image"] = options.image;
    report["reference"] = options.reference;
    report["scale"] = options.scale.empty() ? nlohmann::json() : nlohmann::json(options.scale);
    report["exceeded"] = exceeded;
    fmt::print("{}\n", report.dump(2, ' ', false, nlohmann::json::error_handler_t::replace));
}

} // namespace

int compareCommand(const CompareOptions& options) {
    if (!options.html.empty()) checkOutputPath(options.html, "--html", ".html");
    const RadianceImage image = readRadiance(options.image);
    RadianceImage reference = readRadiance(options.reference);
    requireEqualSizes(image, reference);
    if (!options.referenceStandardError.empty())
        reference.standardError = readStandardError(options.referenceStandardError, reference, "--reference-stderr");
    else if (!reference.warning.empty())
        warn(options, reference.warning);
    if (!image.warning.empty()) warn(options, image.warning);
    const std::vector<Region> regions = regionsOf(options, image);

    CompareSettings settings;
    for (const auto& text : options.referenceNoise) addReferenceNoise(text, regions, settings.referenceNoise);
    settings.netOfImageNoise = options.netOfImageNoise;
    if (options.netOfImageNoise && image.standardError.empty())
        throw InputError("--net-of-image-noise: " + image.path + " has no usable layers stderr.R, stderr.G, stderr.B");
    settings.maximumNonFinite = options.maximumNonFinite;
    settings.worstPixels = options.worstPixels;
    std::optional<RadianceImage> scale;
    if (!options.scale.empty()) settings.scale = &scale.emplace(readScale(options.scale, reference));
    const Comparison comparison = compareImages(image, reference, regions, settings);

    warnOfDenominators(options, comparison);
    const std::vector<std::string> exceeded = exceededLimits(options, comparison);
    PageText text;
    const auto fileName = [](const std::string& path) { return std::filesystem::path(path).filename().string(); };
    text.title = fileName(options.image) + " against " + fileName(options.reference);
    text.regions = regionRows(comparison);
    text.worst = worstRows(comparison);
    text.remarks = remarks(comparison, image.width, options.scale);
    for (const auto& line : exceeded) text.remarks.push_back("exceeded: " + line);
    if (!options.html.empty()) writeText(options.html, htmlPage(image, reference, comparison, text));

    if (options.json)
        printJson(options, comparison, exceeded);
    else if (!options.quiet) {
        fmt::print("{}", tableText(text.regions));
        for (const auto& line : text.remarks) fmt::print("{}\n", line);
        if (!comparison.worst.empty()) fmt::print("worst pixels\n{}", tableText(text.worst));
        if (!options.html.empty()) fmt::print("wrote {}\n", options.html);
    }
    return exceeded.empty() ? 0 : 1;
}

} // namespace quasilux
