// Declares the options of `quasilux compare`.
#include "cli/compare_options.h"

#include "cli/option_checks.h"

namespace quasilux {

namespace {

constexpr uint64_t maximumPixels = 1000000000;

void declareNoise(CLI::App& command, CompareOptions& options) {
    const char* group = "Noise";
    auto* file = command
                     .add_option("--reference-stderr", options.referenceStandardError,
                                 "Standard errors of the reference, an image as it is one (default: the reference's "
                                 "stderr layers, else unknown)")
                     ->type_name("FILE")
                     ->group(group);
    command
        .add_option(
            "--reference-noise", options.referenceNoise,
            "The reference's own relMSE where its standard errors are not known, of all regions or, as NAME=X, of "
            "one; may be given several times (default: unknown)")
        ->type_name("X")
        ->allow_extra_args(false)
        ->excludes(file)
        ->group(group);
    command
        .add_option("--scale", options.scale,
                    "Image whose values stand for the reference's in the denominators of relMSE: of the same view, and "
                    "of noise that is not IMAGE's or REFERENCE's, or of little (default: the reference)")
        ->type_name("FILE")
        ->group(group);
    command
        .add_flag("--net-of-image-noise", options.netOfImageNoise,
                  "Subtract the image's own noise from relMSE too, which leaves bias (default: off)")
        ->group(group);
}

void declareThresholds(CLI::App& command, CompareOptions& options) {
    const char* group = "Thresholds (exit code 1 where a region exceeds one)";
    command
        .add_option("--max-relmse", options.maximumRelMse,
                    "relMSE, net of the noise that is subtracted, a ratio (default: no limit)")
        ->type_name("X")
        ->check(numberBetween(0, 1e30))
        ->group(group);
    command.add_option("--max-rmse", options.maximumRmse, "RMSE, in the images' unit of radiance (default: no limit)")
        ->type_name("X")
        ->check(numberBetween(0, 1e30))
        ->group(group);
    command
        .add_option("--max-bias", options.maximumBias,
                    "Difference of mean luminance, either way, as a ratio: 0.01 is 1 % (default: no limit)")
        ->type_name("RATIO")
        ->check(numberBetween(0, 1e30))
        ->group(group);
    command
        .add_option("--max-nonfinite", options.maximumNonFinite,
                    "Pixels that are not finite, a count; up to so many are left out of all measures (default: 0)")
        ->type_name("N")
        ->transform(wholeNumber(0, maximumPixels))
        ->group(group);
}

} // namespace

void declareCompare(CLI::App& app, CompareOptions& options) {
    CLI::App& command = *app.add_subcommand("compare", "Measure the error of an image against a reference");
    command.add_option("IMAGE", options.image, "Image to judge, linear RGB: EXR, PFM, HDR")
        ->required()
        ->type_name("FILE");
    command.add_option("REFERENCE", options.reference, "Image that counts as right, of the same view and size")
        ->required()
        ->type_name("FILE");
    auto* mask =
        command
            .add_option("--mask", options.mask,
                        "Image of the same size; each distinct value or colour is a region (default: the whole "
                        "picture)")
            ->type_name("FILE");
    command
        .add_option(
            "--region", options.regions,
            "Name of one or more values of the mask, which makes one region of them; may be given several times "
            "(default: each value is a region and its name)")
        ->type_name("NAME=VALUE,...")
        ->allow_extra_args(false)
        ->needs(mask);
    command
        .add_option("--html", options.html, "Page with both images, error pictures and figures, .html (default: none)")
        ->type_name("FILE");
    command.add_option("--worst", options.worstPixels, "Pixels listed as the worst, a count (default: 5)")
        ->type_name("N")
        ->transform(wholeNumber(0, 10000));
    command.add_flag("--json", options.json, "The result on stdout as one JSON object (default: off, text)");
    command.add_flag("--quiet", options.quiet,
                     "No warnings and no text; errors, --json and the exit code remain (default: off)");
    declareNoise(command, options);
    declareThresholds(command, options);
}

} // namespace quasilux
