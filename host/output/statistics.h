// The statistics file and the other JSON that the program prints.
#pragma once

#include "output/render_record.h"

#include <nlohmann/json.hpp>

namespace quasilux {

/// Bytes and seconds; numbers that are unknown (an error after one pass) are null. Keys:
/// docs/reference/command-line.md.
nlohmann::json statisticsJson(const RenderRecord& record, const FilmImage& image);
nlohmann::json deviceJson(const DeviceInfo& device);
nlohmann::json settingsJson(const RenderSettings& settings);
nlohmann::json sceneReportJson(const SceneReport& report);
nlohmann::json errorJson(const ErrorEstimate& error);
nlohmann::json workersJson(const std::vector<WorkerRecord>& workers);
nlohmann::json countersJson(const RenderCounters& counters);
nlohmann::json searchJson(const SearchReport& search, const std::vector<double>& weights);

/// Indented; whole or not at all. Throws std::runtime_error.
void writeJson(const std::string& path, const nlohmann::json& json);

} // namespace quasilux
