// Declares the options of `quasilux dgp`.
#include "cli/dgp_options.h"

#include "cli/option_checks.h"
#include "photometry/daylight_glare.h"

namespace quasilux {

void declareDgp(CLI::App& app, DgpOptions& options) {
    CLI::App& command = *app.add_subcommand("dgp", "Rate the daylight glare of an image (DGP)");
    command
        .add_option("IMAGE", options.input,
                    "Image of radiance along the line of sight, as EXR, PFM or HDR; the whole half space for a rating "
                    "without --illuminance")
        ->type_name("FILE")
        ->required();
    command
        .add_option(
            "--projection", options.projection,
            "perspective, or of a fisheye equidistant, equisolid or orthographic (default: what the image says, "
            "else equidistant)")
        ->type_name("NAME")
        ->check(oneOf(projectionNames()));
    command
        .add_option("--fov", options.degrees,
                    "Angle that the image is wide, in degrees (default: what the image says, else 180 of a fisheye)")
        ->type_name("DEGREES")
        ->check(numberAbove(0, 180));
    command.add_option("--threshold", options.threshold, "Luminance from which pixels glare, in cd/m2 (default: 2000)")
        ->type_name("X")
        ->check(numberAbove(0, 1e30));
    command
        .add_option("--illuminance", options.illuminance,
                    "Vertical illuminance at the eye, in lx, as a meter there reads it (default: that of the image)")
        ->type_name("LX")
        ->check(numberAbove(0, 1e30));
    CLI::Option* const photometric = command.add_flag(
        "--photometric", options.photometric, "The image is in cd/m2 already, whatever its header says (default: off)");
    command
        .add_option(
            "--efficacy", options.efficacy,
            "Luminous efficacy that makes luminance of radiance, 179 of Radiance's pictures (default: 683, or 1 "
            "where the header says photometric)")
        ->type_name("LM/W")
        ->check(numberAbove(0, 1e30))
        ->excludes(photometric);
    command.add_flag("--json", options.json, "The figures on stdout as one JSON object (default: off, text)");
    command.add_flag("--quiet", options.quiet, "No text and no warnings; errors and --json remain (default: off)");
}

} // namespace quasilux
