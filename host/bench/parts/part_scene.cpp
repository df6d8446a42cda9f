#include "bench/parts/part_scene.h"

#include "bench/parts/child_process.h"

#include <fmt/format.h>

namespace quasilux {

PassMeasurement measureInChild(const PartScene& scene, int device, double seconds,
                               const std::vector<std::pair<std::string, std::string>>& environment) {
    std::vector<std::string> arguments{"bench", scene.path, "--pass-times", "--json", "--quiet"};
    arguments.insert(arguments.end(), {"--time", fmt::format("{}", seconds)});
    if (device >= 0) arguments.insert(arguments.end(), {"--device", std::to_string(device)});
    for (const std::string& definition : scene.definitions) arguments.insert(arguments.end(), {"-D", definition});
    const auto report = nlohmann::json::parse(outputOfChild(arguments, environment));
    return passMeasurementFromJson(report.at("passTimes").at(0));
}

} // namespace quasilux
