// Declares the options of `quasilux falsecolour`.
#include "cli/false_colour_options.h"

#include "cli/option_checks.h"
#include "drawing/colour_map.h"

namespace quasilux {

void declareFalseColour(CLI::App& app, FalseColourOptions& options) {
    CLI::App& command = *app.add_subcommand(
        "falsecolour", "Draw luminance, illuminance or a grid in false colours, a grid with isolux lines");
    command
        .add_option("FILE", options.input,
                    "Image of radiance or irradiance, as EXR, PFM or HDR, or a grid's table, .csv, as render --grid "
                    "writes it")
        ->type_name("FILE")
        ->required();
    command.add_option("-o,--output", options.output, "Picture with its scale, .png or .svg")
        ->type_name("FILE")
        ->required();
    command
        .add_option("--range", options.range,
                    "Values of the first and the last colour, in lx, cd/m2 or per cent (default: automatic)")
        ->type_name("A:B")
        ->check(numberRange());
    command.add_flag("--log", options.logarithmic, "Logarithmic scale (default: off, linear)");
    command.add_option("--map", options.map, "Colours: viridis, cividis or grey (default: viridis)")
        ->type_name("NAME")
        ->check(oneOf(colourMapNames()));
    command
        .add_option("--levels", options.levels,
                    "Values that isolux lines of a grid are drawn at, with commas between (default: the scale's marks)")
        ->type_name("LIST")
        ->delimiter(',')
        ->allow_extra_args(false)
        ->check(numberAbove(0, 1e30));
    command
        .add_option("--grid", options.grid,
                    "Which grid of a table of several, by the name that its rows have (default: the only one)")
        ->type_name("NAME");
    command.add_flag("--daylight-factor", options.daylightFactor,
                     "Of a grid the daylight factor in per cent instead of the illuminance (default: off)");
    CLI::Option* const photometric = command.add_flag(
        "--photometric", options.photometric,
        "The image is in cd/m2 or lx already, whatever its header says (default: off, W unless the header "
        "says photometric)");
    command
        .add_option("--efficacy", options.efficacy,
                    "Luminous efficacy that makes luminance of an image's radiance, 179 of Radiance's pictures "
                    "(default: 683, or 1 where the header says photometric)")
        ->type_name("LM/W")
        ->check(numberAbove(0, 1e30))
        ->excludes(photometric);
    command.add_flag("--quiet", options.quiet, "No text; errors remain (default: off)");
}

} // namespace quasilux
