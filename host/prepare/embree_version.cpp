#include "prepare/embree_version.h"

#include <embree3/rtcore.h>
#include <fmt/format.h>

namespace quasilux {

std::string embreeVersion() {
    RTCDevice device = rtcNewDevice(nullptr);
    if (!device) return {};
    const auto part = [&](RTCDeviceProperty property) { return rtcGetDeviceProperty(device, property); };
    std::string version = fmt::format("{}.{}.{}", part(RTC_DEVICE_PROPERTY_VERSION_MAJOR),
                                      part(RTC_DEVICE_PROPERTY_VERSION_MINOR), part(RTC_DEVICE_PROPERTY_VERSION_PATCH));
    rtcReleaseDevice(device);
    return version;
}

} // namespace quasilux
