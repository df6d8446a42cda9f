// Declares the options of `quasilux report`.
#include "cli/report_options.h"

#include "cli/option_checks.h"

namespace quasilux {

void declareReport(CLI::App& app, ReportOptions& options) {
    CLI::App& command = *app.add_subcommand(
        "report", "Write a page on a scene's lighting: luminaires, illuminance with isolux lines, UGR, false colours");
    declareSceneFile(command, options);
    declareScene(command, options, "");
    command.add_option("-o,--output", options.output, "Page that needs nothing besides itself, .html")
        ->type_name("FILE")
        ->required();
    command
        .add_option("--time", options.seconds,
                    "Time for all of it, in seconds; the picture takes what the figures leave (default: 60)")
        ->type_name("SECONDS")
        ->check(numberAbove(0, 1e9));
    command
        .add_option("--precision", options.precision,
                    "What figures are to be known to with 95 %, a ratio; then they are rendered no further (default: "
                    "0.01, 1 %)")
        ->type_name("RATIO")
        ->check(numberAbove(0, 1));
    declareSettings(command, options);
    declareDevice(command, options);
    for (const char* ofFiles : {"--energy-balance", "--without"}) command.remove_option(optionOf(command, ofFiles));
}

} // namespace quasilux
