#include "scene/xml/upgrade.h"

#include <algorithm>
#include <cctype>
#include <charconv>

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

// Takes the <float> of that name out of the element; `missing` where there is none.
std::string take(Element& element, const std::string& name, const std::string& missing) {
    const auto found = std::find_if(element.children.begin(), element.children.end(), [&](const Element& child) {
        return child.tag == "float" && child.get("name") == name;
    });
    if (found == element.children.end()) return missing;
    std::string value = found->get("value");
    element.children.erase(found);
    return value;
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
    if (element.tag == "default") return;
    for (Attribute& attribute : element.attributes)
        if (attribute.name == "name" && isCamelCase(attribute.value)) attribute.value = underscored(attribute.value);
}

void upgradeTextureCoordinates(Element& element) {
    if (element.tag != "texture") return;
    const size_t before = element.children.size();
    const std::string scaleU = take(element, "uscale", "1"), scaleV = take(element, "vscale", "1");
    const std::string offsetU = take(element, "uoffset", "0"), offsetV = take(element, "voffset", "0");
    if (element.children.size() == before) return;
    Element transform{"transform", {{"name", "to_uv"}}, {}, {}, element.where};
    transform.children.push_back({"scale", {{"x", scaleU}, {"y", scaleV}}, {}, {}, element.where});
    transform.children.push_back({"translate", {{"x", offsetU}, {"y", offsetV}}, {}, {}, element.where});
    element.children.push_back(std::move(transform));
}

} // namespace quasilux
