// Which devices a command line names: `0`, `0,2`, `all`, `0/2` (device 0 in two halves). Knows no device.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

namespace quasilux {

/// A device by its number in listDevices(), or one of the equal parts that it is divided into.
struct DeviceChoice {
    int index = -1; ///< -1: the first GPU, else the first device
    unsigned part = 0, parts = 1;

    DeviceChoice() = default;
    DeviceChoice(int number) : index(number) {} // NOLINT(google-explicit-constructor): a number is a choice
    DeviceChoice(int number, unsigned which, unsigned of) : index(number), part(which), parts(of) {}
    bool operator==(const DeviceChoice&) const = default;
};

/// "device 0", "device 0 part 1 of 2".
std::string text(const DeviceChoice& choice);

/// Numbers with commas between, each with /PARTS or not, or "all". Nothing where `text` is none of it.
struct DeviceList {
    bool all = false;
    struct Item {
        unsigned index, parts;
    };
    std::vector<Item> items;
};
std::optional<DeviceList> parseDeviceList(const std::string& text);

/// In the order of `text`, of so many devices; "": the one that is taken without --device. Throws InputError where one
/// is not there.
std::vector<DeviceChoice> devicesOf(const std::string& text, size_t devices);

/// Of programs that share a machine's devices, what the one with this number takes: every so many-th device, and where
/// there are fewer than programs, one that several take.
std::vector<DeviceChoice> shareOf(const std::vector<DeviceChoice>& all, unsigned number, unsigned programs);

} // namespace quasilux
