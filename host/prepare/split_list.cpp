// Splits and checks the list form of the quasi-specular setting.
#include "prepare/split_list.h"

#include "scene/quasi_specular.h"

#include <algorithm>
#include <fmt/format.h>
#include <sstream>

namespace quasilux {

namespace {

std::vector<std::string> splitAtCommas(const std::string& text) {
    std::vector<std::string> items;
    std::istringstream stream(text);
    for (std::string item; std::getline(stream, item, ',');)
        if (!item.empty()) items.push_back(item);
    return items;
}

void checkIds(const Scene& scene, const std::vector<std::string>& ids) {
    std::vector<std::string> objects, names;
    for (const auto& bsdf : scene.bsdfs) {
        objects.push_back(bsdf.id);
        for (const auto* side : {&bsdf.front, &bsdf.back})
            for (const auto& lobe : *side) names.push_back(bsdf.id + '.' + lobe.name);
    }
    for (const auto& medium : scene.media) objects.push_back(medium.id);
    names.insert(names.end(), objects.begin(), objects.end());
    for (const auto& id : ids)
        if (std::find(names.begin(), names.end(), id) == names.end())
            throw InputError(
                fmt::format("quasi-specular: the scene has no bsdf, lobe or medium '{}', expected auto, none, all, "
                            "level:NUMBER, or ids among: {} (or ID.LOBE, such as {}.specular)",
                            id, fmt::join(objects, ", "), scene.bsdfs.empty() ? "ID" : scene.bsdfs.front().id));
}

} // namespace

std::vector<std::string> listedIds(const Scene& scene, const std::string& setting) {
    if (setting == "auto" || setting == "none" || setting == "all" || isPhaseLevel(setting)) return {};
    std::vector<std::string> ids = splitAtCommas(setting);
    checkIds(scene, ids);
    return ids;
}

} // namespace quasilux
