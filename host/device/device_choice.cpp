#include "device/device_choice.h"

#include "util/error.h"

#include <charconv>
#include <fmt/format.h>
#include <sstream>

namespace quasilux {

namespace {

constexpr unsigned mostParts = 1000;

std::optional<unsigned> wholeNumberOf(const std::string& text) {
    unsigned value = 0;
    const char* end = text.data() + text.size();
    const auto [stopped, status] = std::from_chars(text.data(), end, value);
    return status == std::errc() && stopped == end && value <= mostParts ? std::optional(value) : std::nullopt;
}

std::optional<DeviceList::Item> parseItem(const std::string& text) {
    const auto slash = text.find('/');
    const auto index = wholeNumberOf(text.substr(0, slash));
    const auto parts = slash == std::string::npos ? 1 : wholeNumberOf(text.substr(slash + 1));
    if (!index || !parts || *parts == 0) return std::nullopt;
    return DeviceList::Item{*index, *parts};
}

} // namespace

std::string text(const DeviceChoice& choice) {
    const std::string number = choice.index < 0 ? "device" : fmt::format("device {}", choice.index);
    return choice.parts == 1 ? number : fmt::format("{} part {} of {}", number, choice.part + 1, choice.parts);
}

std::optional<DeviceList> parseDeviceList(const std::string& text) {
    DeviceList list;
    list.all = text == "all";
    if (list.all) return list;
    std::istringstream items(text + ',');
    for (std::string item; std::getline(items, item, ',');) {
        const auto parsed = parseItem(item);
        if (!parsed) return std::nullopt;
        list.items.push_back(*parsed);
    }
    return list;
}

std::vector<DeviceChoice> devicesOf(const std::string& text, size_t devices) {
    if (text.empty()) return {DeviceChoice()};
    auto list = parseDeviceList(text).value_or(DeviceList{});
    for (unsigned index = 0; list.all && index < devices; ++index) list.items.push_back({index, 1});
    std::vector<DeviceChoice> choices;
    for (const auto& item : list.items) {
        if (item.index >= devices)
            throw InputError(fmt::format(
                "--device {}: no such device, expected {}; `quasilux devices` lists them", item.index,
                devices == 0 ? "one that is there, and there is none" : fmt::format("0 to {}", devices - 1)));
        for (unsigned part = 0; part < item.parts; ++part)
            choices.emplace_back(static_cast<int>(item.index), part, item.parts);
    }
    if (choices.empty())
        throw InputError(fmt::format("--device {}: no OpenCL device found, expected at least one: install a runtime, "
                                     "such as the Debian package pocl-opencl-icd for the CPU",
                                     text));
    return choices;
}

std::vector<DeviceChoice> shareOf(const std::vector<DeviceChoice>& all, unsigned number, unsigned programs) {
    std::vector<DeviceChoice> mine;
    for (size_t k = number % all.size(); k < all.size(); k += std::max(1u, programs)) mine.push_back(all[k]);
    return mine;
}

} // namespace quasilux
