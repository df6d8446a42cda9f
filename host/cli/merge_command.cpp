#include "cli/commands.h"

#include "cli/interrupt.h"
#include "cli/written_files.h"
#include "output/exr.h"
#include "output/merge_checkpoints.h"
#include "output/png.h"
#include "output/statistics.h"
#include "util/messages.h"

#include <cmath>
#include <filesystem>
#include <fmt/format.h>

namespace quasilux {

namespace {

void checkOutputs(const MergeOptions& options) {
    if (options.output.empty() && options.png.empty() && options.checkpoint.empty())
        throw InputError("merge: nothing to write, expected --output, --png or --checkpoint");
    if (!options.output.empty()) checkOutputPath(options.output, "--output", ".exr");
    if (!options.png.empty()) checkOutputPath(options.png, "--png", ".png");
    if (!options.checkpoint.empty()) checkOutputPath(options.checkpoint, "--checkpoint", checkpointExtension);
    std::error_code status;
    for (const std::string& part : options.parts)
        if (!options.checkpoint.empty() && std::filesystem::equivalent(options.checkpoint, part, status))
            throw InputError(fmt::format("--checkpoint {}: is {}, one of those to be merged, and would be replaced: "
                                         "choose another name",
                                         options.checkpoint, part));
}

/// The scene is not at hand, and some layers are made from it alone.
void warnOfLayers(const MergeOptions& options, const Checkpoint& merged) {
    if (options.quiet || options.output.empty() || merged.layersOfScene.empty()) return;
    printWarning(fmt::format("--output {}: without the layers {}, which take the scene: render --resume of a merged "
                             "checkpoint, with as many --passes as it has, writes them",
                             options.output, merged.layersOfScene));
}

RenderRecord recordOf(const Checkpoint& merged, const FilmImage& image) {
    RenderRecord record;
    record.scene = merged.scene;
    record.settings = merged.settings;
    record.isPerNanometre = merged.isPerNanometre;
    record.view = merged.view;
    record.stop = merged.stop;
    record.device = merged.device;
    record.report.photonsPerPass = merged.photonsPerPass;
    record.counters = merged.counters;
    record.search = merged.search;
    record.error = estimateError(image);
    record.meter = merged.meter;
    record.kernels = merged.timings;
    return record;
}

WrittenFiles writeFiles(const MergeOptions& options, const MergedPasses& merged, const FilmImage& image,
                        const RenderRecord& record) {
    WrittenFiles written;
    written.write(options.output, [&] { writeExr(options.output, image, record); });
    written.write(options.png, [&] { writePng(options.png, image, chooseToneCurve(image, {}), record); });
    written.write(options.checkpoint, [&] { merged.write(options.checkpoint); });
    return written;
}

void printSummary(const RenderRecord& record, const Checkpoint& merged, const std::vector<std::string>& written) {
    fmt::print("{} passes ({})", record.counters.passes, text(merged.passes));
    if (std::isfinite(record.error.sum())) fmt::print(", estimated relative error {:.3g} %", 100 * record.error.sum());
    fmt::print("\n");
    for (const auto& path : written) fmt::print("wrote {}\n", path);
}

void printJson(const RenderRecord& record, const Checkpoint& merged, const std::vector<std::string>& written) {
    nlohmann::json ranges = nlohmann::json::array();
    for (const PassRange& range : merged.passes) ranges.push_back({range.first, range.end});
    const nlohmann::json summary{{"version", record.version},           {"scene", record.scene},
                                 {"passes", record.counters.passes},    {"passRanges", ranges},
                                 {"relativeError", record.error.sum()}, {"files", written}};
    fmt::print("{}\n", summary.dump(2, ' ', false, nlohmann::json::error_handler_t::replace));
}

} // namespace

int mergeCommand(const MergeOptions& options) {
    exitOnInterrupt();
    checkOutputs(options);
    const MergedPasses merged(options.parts);
    warnOfLayers(options, merged.checkpoint());
    const FilmImage image = merged.develop();
    const RenderRecord record = recordOf(merged.checkpoint(), image);
    WrittenFiles written = writeFiles(options, merged, image, record);
    const auto& files = written.paths();
    written.attempt([&] {
        if (options.json)
            printJson(record, merged.checkpoint(), files);
        else if (!options.quiet)
            printSummary(record, merged.checkpoint(), files);
    });
    written.rethrow();
    return 0;
}

} // namespace quasilux
