// All runs of a benchmark, as tables, as JSON and as one page.
#pragma once

#include "bench/bench_run.h"
#include "bench/bench_section.h"
#include "bench/micro/micro_report.h"

#include <map>

namespace quasilux {

/// A run or a part that could not be measured; the others go on.
struct BenchFailure {
    std::string what, message;
};

struct BenchReport {
    std::vector<DeviceInfo> devices;                  ///< in the order asked for; BenchRun::device counts along it
    std::map<std::string, BenchReference> references; ///< by scene, where given
    std::vector<BenchRun> runs;                       ///< by scene, then method, then device
    std::vector<BenchSection> sections;               ///< of the parts that were asked for besides
    std::array<double, 3> loadBefore{}, loadAfter{};  ///< of the machine, runnable processes: 1, 5, 15 minutes
    double seconds = 0;                               ///< of each run
    std::optional<MicroReport> micro;                 ///< where asked for
    std::vector<BenchFailure> failures;
    bool interrupted = false;
};

/// How far the image of `run` is from that of the same scene and method on the first device.
struct DeviceDifference {
    double mean = 0;              ///< of the mean luminance, relative
    double meanStandardError = 0; ///< of it, from the standard errors of pixels as if these were independent
    double beyondThree = 0;       ///< share of values further than 3 standard errors apart
};
/// Nothing where there is no such run, or it is `run` itself.
std::optional<DeviceDifference> deviceDifference(const BenchReport& report, const BenchRun& run);

std::vector<const BenchRun*> runsOf(const BenchReport& report, const std::string& scene);
/// The method, and the device where there are several.
std::string runTitle(const BenchReport& report, const BenchRun& run);

/// One row for each run of the scene, headings first.
std::vector<TableRow> runRows(const BenchReport& report, const std::string& scene);
/// Milliseconds of a pass by kernel, a column for each run.
std::vector<TableRow> stageRows(const BenchReport& report, const std::string& scene);
/// Rates and times of preparation, headings first.
std::vector<TableRow> deviceRows(const BenchReport& report, const std::string& scene);

/// The scenes in order, each once.
std::vector<std::string> scenesOf(const BenchReport& report);

/// Keys: docs/reference/benchmarks.md.
nlohmann::json benchJson(const BenchReport& report);

/// HTML with plots and pictures inside: error over time, equal-time images and, with references, their errors.
std::string benchPage(const BenchReport& report);

} // namespace quasilux
