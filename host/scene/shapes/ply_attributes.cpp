#include "scene/shapes/ply_attributes.h"

#include "scene/color.h"
#include "scene/xml/names.h"

#include <algorithm>
#include <array>
#include <limits>
#include <optional>

namespace quasilux {

namespace {

bool isOneOf(const std::string& name, const Names& names) {
    return std::find(names.begin(), names.end(), name) != names.end();
}

/// Properties that mean something else.
bool isReserved(const PlyProperty& property) {
    return property.isList || isOneOf(property.name, {"x", "y", "z", "nx", "ny", "nz", "u", "v", "s", "t", "r", "g",
                                                      "b", "a", "red", "green", "blue", "alpha"});
}

std::optional<size_t> indexOf(const PlyElement& element, std::string_view name) {
    for (size_t k = 0; k < element.properties.size(); ++k)
        if (element.properties[k].name == name && !element.properties[k].isList) return k;
    return std::nullopt;
}

/// What comes before "_x", or empty.
std::string prefixOf(const std::string& name) {
    return name.size() > 2 && name[name.size() - 2] == '_' ? name.substr(0, name.size() - 2) : std::string();
}

/// Endings that go together.
constexpr std::string_view endings[] = {"xyz", "rgb", "012", "123"};
constexpr std::string_view colorEnding = endings[1];

/// The endings of these neighbouring properties, or empty where they are none of those.
std::string_view endingsOf(const PlyElement& element, size_t first, size_t count) {
    std::string given;
    for (size_t k = first; k < first + count; ++k) given += element.properties[k].name.back();
    for (const std::string_view ending : endings)
        if ((count == 1 || count == 3) && ending.substr(0, count) == given) return ending;
    return {};
}

/// As Mitsuba 3.9 has them: bytes are left as they are, other integers are sRGB encoded shares of the largest one.
float valueOf(double stored, PlyType type) {
    const auto decoded = [&](double largest) { return decodeSrgb(static_cast<float>(stored / largest)); };
    switch (type) {
    case PlyType::int8:
        return decoded(std::numeric_limits<int8_t>::max());
    case PlyType::int16:
        return decoded(std::numeric_limits<int16_t>::max());
    case PlyType::uint16:
        return decoded(std::numeric_limits<uint16_t>::max());
    case PlyType::int32:
        return decoded(std::numeric_limits<int32_t>::max());
    case PlyType::uint32:
        return decoded(std::numeric_limits<uint32_t>::max());
    case PlyType::uint8:
    case PlyType::float32:
    case PlyType::float64:
        break;
    }
    return static_cast<float>(stored);
}

} // namespace

PlyAttributes::PlyAttributes(const PlyElement& element, const std::string& kind) : element_(element) {
    for (const auto& [red, green, blue] : {std::array{"r", "g", "b"}, std::array{"red", "green", "blue"}}) {
        const auto r = indexOf(element, red), g = indexOf(element, green), b = indexOf(element, blue);
        if (!r || !g || !b) continue;
        add(kind + "color", {*r, *g, *b});
        break;
    }
    const std::vector<PlyProperty>& properties = element.properties;
    for (size_t first = 0, count = 0; first < properties.size(); first += count) {
        const std::string prefix = isReserved(properties[first]) ? "" : prefixOf(properties[first].name);
        for (count = 1; !prefix.empty() && first + count < properties.size(); ++count)
            if (properties[first + count].isList || prefixOf(properties[first + count].name) != prefix) break;
        if (prefix.empty()) continue;
        const std::string_view ending = endingsOf(element, first, count);
        std::vector<size_t> run;
        for (size_t k = first; k < first + count; ++k) run.push_back(k);
        if (!ending.empty()) add(kind + prefix + (ending == colorEnding ? "_color" : ""), run);
    }
}

void PlyAttributes::add(std::string name, const std::vector<size_t>& properties) {
    if (!names_.insert(name).second) return; // the first one counts
    MeshAttribute attribute;
    attribute.name = std::move(name);
    attribute.channels = static_cast<unsigned>(properties.size());
    attributes_.push_back(std::move(attribute));
    sources_.push_back(properties);
}

void PlyAttributes::addRow(const std::vector<std::vector<double>>& row) {
    for (size_t k = 0; k < attributes_.size(); ++k) {
        const auto value = [&](size_t property) {
            return valueOf(row[property][0], element_.properties[property].type);
        };
        const std::vector<size_t>& from = sources_[k];
        const float first = value(from[0]);
        attributes_[k].values.push_back(from.size() == 1 ? Rgb{first, first, first}
                                                         : Rgb{first, value(from[1]), value(from[2])});
    }
}

} // namespace quasilux
