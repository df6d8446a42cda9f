// The statistics of a render as JSON: every key, also in the documents; and the line of progress.
#include "output/progress_line.h"
#include "support/folder_files.h"
#include "support/read_text.h"
#include "support/render_records.h"
#include "util/temporary_folder.h"

#include <cmath>
#include <gmock/gmock.h>

namespace quasilux {
namespace {

using testing::HasSubstr;

nlohmann::json written(const RenderRecord& record) {
    const TemporaryFolder folder;
    const std::string path = (folder.path() / "a.json").string();
    writeJson(path, statisticsJson(record, distinctImage()));
    return nlohmann::json::parse(readText(path));
}

TEST(Statistics, HoldEveryKeyAndParse) {
    const auto json = written(exampleRecord());
    const std::vector<std::string> pointers{"/version",
                                            "/scene",
                                            "/image/width",
                                            "/image/height",
                                            "/settings/bdd",
                                            "/settings/variant",
                                            "/settings/direct",
                                            "/settings/map",
                                            "/settings/quasiSpecular",
                                            "/settings/quasiSpecularOverridesScene",
                                            "/settings/photonsPerPass",
                                            "/settings/seed",
                                            "/settings/radiusScale",
                                            "/settings/kernels",
                                            "/stop/seconds",
                                            "/stop/passes",
                                            "/stop/relativeError",
                                            "/stop/interrupted",
                                            "/stop/failure",
                                            "/device/name",
                                            "/device/platform",
                                            "/device/version",
                                            "/device/driver",
                                            "/device/computeUnits",
                                            "/device/globalMemory",
                                            "/device/maximumAllocation",
                                            "/device/isCpu",
                                            "/device/workGroupSize",
                                            "/sceneReport/triangles",
                                            "/sceneReport/spheres",
                                            "/sceneReport/patches",
                                            "/sceneReport/borderSegments",
                                            "/sceneReport/features",
                                            "/sceneReport/emitters/0/id",
                                            "/sceneReport/emitters/0/type",
                                            "/sceneReport/emitters/0/power",
                                            "/sceneReport/lobes/0/bsdf",
                                            "/sceneReport/lobes/0/lobe",
                                            "/sceneReport/lobes/0/scattering",
                                            "/sceneReport/lobes/0/why",
                                            "/sceneReport/media",
                                            "/sceneReport/photonClasses",
                                            "/sceneReport/bufferBytes",
                                            "/sceneReport/photonsPerPass",
                                            "/sceneReport/initialRadius",
                                            "/sceneReport/warnings",
                                            "/counters/passes",
                                            "/counters/photonsEmitted",
                                            "/counters/photonsStored",
                                            "/counters/cameraPointsStored",
                                            "/counters/storedPoints",
                                            "/counters/storedBytes",
                                            "/counters/overflows",
                                            "/counters/meterCaustics",
                                            "/counters/cameraPaths",
                                            "/counters/nonFinite",
                                            "/counters/cutPaths",
                                            "/counters/fluxEmitted",
                                            "/counters/fluxCut",
                                            "/counters/throughputCut",
                                            "/error/relativeError",
                                            "/error/relativeMse",
                                            "/error/total/noiseMean",
                                            "/error/total/noisePercentile95",
                                            "/error/total/noiseRms",
                                            "/error/total/biasRms",
                                            "/error/total/biasNoiseRms",
                                            "/error/components/direct",
                                            "/kernels",
                                            "/phases/load",
                                            "/phases/prepare",
                                            "/phases/compile",
                                            "/phases/firstPass",
                                            "/phases/render",
                                            "/phases/write",
                                            "/peakBufferBytes"};
    const std::string documentation = readText(QUASILUX_SOURCE_DIR "/docs/reference/command-line.md");
    for (const auto& pointer : pointers) {
        EXPECT_TRUE(json.contains(nlohmann::json::json_pointer(pointer))) << pointer;
        EXPECT_THAT(documentation, HasSubstr("`" + pointer.substr(pointer.rfind('/') + 1) + "`"));
    }
    EXPECT_EQ(json["settings"]["seed"], 18446744073709551615u);
    EXPECT_EQ(json["kernels"]["tracePhotons"]["launches"], 7);
    EXPECT_EQ(json["kernels"]["tracePhotons"]["seconds"], 3.5);
    EXPECT_EQ(json["peakBufferBytes"], 123456789012);
    EXPECT_EQ(json["error"]["relativeError"], 0.5625);
    EXPECT_EQ(json["error"]["relativeMse"], 0.125 * 0.125 + 0.25);
    EXPECT_EQ(json["error"]["components"].size(), 1u) << "components without light are left out";
    EXPECT_EQ(json["error"]["components"]["direct"]["biasNoiseRms"], 4.5);
    EXPECT_TRUE(json["stop"]["passes"].is_null());
}

TEST(Statistics, SurviveUnknownErrorsAndOddBytes) {
    RenderRecord record = exampleRecord();
    record.error.total.noiseMean = INFINITY;
    record.error.hasBias = false;
    record.device.name = "bad \xff byte";
    const auto json = written(record);
    EXPECT_TRUE(json["error"]["relativeError"].is_null());
    EXPECT_TRUE(json["error"]["total"]["biasRms"].is_null());
}

TEST(ProgressText, LeavesOutWhatIsUnknown) {
    EXPECT_EQ(progressText({.phase = "compiling"}), "compiling");
    Progress progress{.phase = "rendering", .passes = 12, .seconds = 6};
    EXPECT_EQ(progressText(progress), "rendering: pass 12");
    progress.secondsLeft = 83.2;
    progress.photonsPerSecond = 1.254e6;
    progress.pathsPerSecond = 310e3;
    progress.relativeError = 0.02314;
    EXPECT_EQ(progressText(progress), "rendering: pass 12, 1.25 M photons/s, 310 k paths/s, error 2.31 %, 1:24 left");
    progress.relativeError = INFINITY;
    EXPECT_THAT(progressText(progress), testing::Not(HasSubstr("error")));
}

} // namespace
} // namespace quasilux
