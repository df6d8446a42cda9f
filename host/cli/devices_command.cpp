// Prints the devices as a table or as JSON.
#include "cli/commands.h"

#include "cli/text_table.h"
#include "device/device.h"
#include "output/statistics.h"
#include "util/messages.h"

#include <fmt/format.h>

namespace quasilux {

void listDevicesCommand(bool json) {
    const auto devices = listDevices();
    nlohmann::json rows = nlohmann::json::array();
    TextTable table({"number", "name", "platform", "version", "units", "memory", "maximum allocation"});
    for (size_t i = 0; i < devices.size(); ++i) {
        const DeviceInfo& device = devices[i];
        rows.push_back(deviceJson(device));
        rows.back()["number"] = i;
        table.add({std::to_string(i), device.name, device.platform, device.version, std::to_string(device.computeUnits),
                   bytesText(device.globalMemory), bytesText(device.maximumAllocation)});
    }
    if (json)
        fmt::print("{}\n", rows.dump(2, ' ', false, nlohmann::json::error_handler_t::replace));
    else if (devices.empty())
        printNote("no OpenCL device found, install a runtime, such as the Debian package pocl-opencl-icd for the CPU");
    else
        fmt::print("{}", table.text());
}

} // namespace quasilux
