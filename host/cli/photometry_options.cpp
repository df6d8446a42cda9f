// Declares the options of `quasilux photometry`.
#include "cli/photometry_options.h"

#include "cli/option_checks.h"

namespace quasilux {

void declarePhotometry(CLI::App& app, PhotometryOptions& options) {
    CLI::App& command = *app.add_subcommand("photometry", "Print the photometry of a luminaire's file");
    command.add_option("FILE", options.file, "Luminaire, IES LM-63 (.ies) or EULUMDAT (.ldt)")
        ->type_name("FILE")
        ->required();
    command.add_option("--svg", options.svg, "Polar curve, .svg (default: none)")->type_name("FILE");
    command
        .add_option("--lamp-set", options.lampSet,
                    "Set of lamps of an EULUMDAT file, a number from 1 in the order of the file (default: 1)")
        ->type_name("N")
        ->transform(wholeNumber(1, 1000));
    command.add_flag("--json", options.json, "The figures on stdout as one JSON object (default: off, text)");
    command.add_flag("--quiet", options.quiet, "No text; errors and --json remain (default: off)");
}

} // namespace quasilux
