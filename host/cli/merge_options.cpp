// Declares the options of `quasilux merge`.
#include "cli/merge_options.h"

namespace quasilux {

void declareMerge(CLI::App& app, MergeOptions& options) {
    CLI::App& command =
        *app.add_subcommand("merge", "Add the passes of several checkpoints of one render: the image of all of them");
    command.add_option("CHECKPOINT", options.parts, "Checkpoints whose passes have different numbers")->required();
    const char* group = "Files";
    command
        .add_option("-o,--output", options.output,
                    "OpenEXR image with all layers that the checkpoints hold, .exr (default: none)")
        ->type_name("FILE")
        ->group(group);
    command.add_option("--png", options.png, "Tone-mapped picture, .png (default: none)")
        ->type_name("FILE")
        ->group(group);
    command
        .add_option("--checkpoint", options.checkpoint,
                    "Checkpoint of all passes, .ckpt, to be merged again or resumed (default: none)")
        ->type_name("FILE")
        ->group(group);
    command.add_flag("--json", options.json, "The result on stdout as one JSON object (default: off, text)");
    command.add_flag("--quiet", options.quiet, "No text; errors and --json remain (default: off)");
}

} // namespace quasilux
