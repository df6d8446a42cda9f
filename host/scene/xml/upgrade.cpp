#include "scene/xml/upgrade.h"

#include "scene/color.h"
#include "scene/xml/numbers.h"

#include <algorithm>
#include <cctype>
#include <charconv>
#include <fmt/format.h>

namespace quasilux {

namespace {

bool isLower(char c) { return std::islower(static_cast<unsigned char>(c)) != 0; }
bool isUpper(char c) { return std::isupper(static_cast<unsigned char>(c)) != 0; }

// camelCase to snake_case.
std::string underscored(const std::string& name) {
    std::string result;
    for (size_t k = 0; k < name.size(); ++k) {
        if (k > 0 && isLower(name[k - 1]) && isUpper(name[k])) result += '_';
        result += static_cast<char>(std::tolower(static_cast<unsigned char>(name[k])));
    }
    return result;
}

bool isCamelCase(const std::string& name) {
    for (size_t k = 1; k < name.size(); ++k)
        if (isLower(name[k - 1]) && isUpper(name[k])) return true;
    return false;
}

// The parameter or object of that name, or nullptr.
Element* findNamed(Element& element, std::string_view name) {
    const auto found = std::find_if(element.children.begin(), element.children.end(), [&](const Element& child) {
        return child.find("name") && child.get("name") == name;
    });
    return found == element.children.end() ? nullptr : &*found;
}

// The same, if it states a value.
Element* find(Element& element, std::string_view name) {
    Element* const found = findNamed(element, name);
    return found && found->find("value") ? found : nullptr;
}

// Takes the <float> of that name out of the element; `missing` where there is none.
std::string take(Element& element, const std::string& name, const std::string& missing) {
    Element* const found = find(element, name);
    if (!found || found->tag != "float") return missing;
    std::string value = found->get("value");
    element.children.erase(element.children.begin() + (found - element.children.data()));
    return value;
}

bool isOneOf(const std::string& value, std::initializer_list<std::string_view> others) {
    return std::find(others.begin(), others.end(), value) != others.end();
}

// Takes it out if it has one of these values.
void drop(Element& element, std::string_view name, std::initializer_list<std::string_view> values) {
    Element* const found = find(element, name);
    if (found && isOneOf(found->get("value"), values))
        element.children.erase(element.children.begin() + (found - element.children.data()));
}

void setAttribute(Element& element, std::string_view name, const std::string& value) {
    for (Attribute& attribute : element.attributes)
        if (attribute.name == name) attribute.value = value;
}

// <srgb>: numbers that are sRGB encoded. #rrggbb is so in <rgb> too.
void upgradeColor(Element& element) {
    element.tag = "rgb";
    const std::string* const value = element.find("value");
    if (!value || value->find('#') != std::string::npos) return;
    std::string linear;
    for (const double number : parseNumbers(*value, element.where, "<srgb>"))
        linear += fmt::format("{} ", decodeSrgb(static_cast<float>(number)));
    setAttribute(element, "value", linear);
}

// Filters that look at a smaller picture far away are bilinear nearby; gamma 1 says that numbers are linear, -1 what
// is so without it.
void upgradeBitmap(Element& element) {
    Element* const filter = find(element, "filter_type");
    if (filter && isOneOf(filter->get("value"), {"trilinear", "ewa"})) setAttribute(*filter, "value", "bilinear");
    drop(element, "gamma", {"-1", "-1.0"});
    Element* const gamma = find(element, "gamma");
    if (gamma && isOneOf(gamma->get("value"), {"1", "1.0"})) {
        gamma->tag = "boolean";
        gamma->attributes = {{"name", "raw"}, {"value", "true"}};
    }
}

// The density that a cloud's albedo goes with is the extinction coefficient, and its grids lie where their files say.
void upgradeCloud(Element& medium) {
    const auto isDensity = [](const Element& child) {
        return child.tag == "volume" && child.find("name") && child.get("name") == "density";
    };
    const auto density = std::find_if(medium.children.begin(), medium.children.end(), isDensity);
    if (density == medium.children.end()) return;
    setAttribute(*density, "name", "sigma_t");
    drop(medium, "method", {"simpson", "woodcock"});
    for (Element& child : medium.children)
        if (child.tag == "volume" && child.find("type") && child.get("type") == "gridvolume" &&
            !find(child, "use_grid_bbox"))
            child.children.push_back({"boolean", {{"name", "use_grid_bbox"}, {"value", "true"}}, {}, {}, child.where});
}

} // namespace

int majorVersion(const std::string& version) {
    int major = -1;
    const auto [end, error] = std::from_chars(version.data(), version.data() + version.size(), major);
    if (error != std::errc{} || major < 0 || (end != version.data() + version.size() && *end != '.')) return -1;
    return major;
}

void upgradeNames(Element& element) {
    if (element.tag == "lookAt") element.tag = "lookat";
    if (element.tag == "srgb") upgradeColor(element);
    if (element.tag == "default") return;
    for (Attribute& attribute : element.attributes)
        if (attribute.name == "name" && isCamelCase(attribute.value)) attribute.value = underscored(attribute.value);
}

namespace {

void upgradeTextureCoordinates(Element& element) {
    const size_t before = element.children.size();
    const std::string scaleU = take(element, "uscale", "1"), scaleV = take(element, "vscale", "1");
    const std::string offsetU = take(element, "uoffset", "0"), offsetV = take(element, "voffset", "0");
    if (element.children.size() == before) return;
    Element transform{"transform", {{"name", "to_uv"}}, {}, {}, element.where};
    // In this order, as Mitsuba 3 upgrades them: offsets are scaled, too.
    transform.children.push_back({"translate", {{"x", offsetU}, {"y", offsetV}}, {}, {}, element.where});
    transform.children.push_back({"scale", {{"x", scaleU}, {"y", scaleV}}, {}, {}, element.where});
    element.children.push_back(std::move(transform));
}

} // namespace

void upgradeParameters(Element& element) {
    const std::string* const type = element.find("type");
    if (element.tag == "texture") upgradeTextureCoordinates(element);
    if (element.tag == "texture" && type && *type == "bitmap") upgradeBitmap(element);
    // That of `diffuse` had two names; it may be a texture, a reference or a spectrum's file.
    Element* const color =
        element.tag == "bsdf" && type && *type == "diffuse" ? findNamed(element, "diffuse_reflectance") : nullptr;
    if (color) setAttribute(*color, "name", "reflectance");
    if (element.tag == "medium" && type && *type == "heterogeneous") upgradeCloud(element);
    // What lies outside of a metal: air, or nothing.
    if (element.tag == "bsdf" && type && isOneOf(*type, {"conductor", "roughconductor"}))
        drop(element, "ext_eta", {"1", "1.0", "air", "vacuum"});
}

bool isFormerTag(std::string_view name) { return name == "srgb"; }

} // namespace quasilux
