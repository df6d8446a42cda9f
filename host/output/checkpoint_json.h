// What a checkpoint says of a render besides its arrays, to and from JSON. Numbers come back as they were, to the bit.
#pragma once

#include "auto/search_report.h"
#include "device/device.h"
#include "render/renderer.h"

#include <nlohmann/json.hpp>

namespace quasilux {

/// All settings that decide the image.
nlohmann::json toJson(const RenderSettings& settings);
nlohmann::json toJson(const StopRule& stop);
nlohmann::json toJson(const RenderCounters& counters);
nlohmann::json toJson(const SearchReport& search);
nlohmann::json toJson(const DeviceInfo& device);
nlohmann::json toJson(const std::map<std::string, KernelTiming>& timings);

/// Throw nlohmann::json::exception or InputError where something is missing.
void fromJson(const nlohmann::json& json, RenderSettings& settings);
void fromJson(const nlohmann::json& json, StopRule& stop);
void fromJson(const nlohmann::json& json, RenderCounters& counters);
void fromJson(const nlohmann::json& json, SearchReport& search);
void fromJson(const nlohmann::json& json, DeviceInfo& device);
void fromJson(const nlohmann::json& json, std::map<std::string, KernelTiming>& timings);

template <typename T>
T parsed(const nlohmann::json& json) {
    T value{};
    fromJson(json, value);
    return value;
}

} // namespace quasilux
