// The table of volume plugins, and what is common to reading any of them.
#include "scene/box.h"
#include "scene/plugin_lookup.h"
#include "scene/transform.h"
#include "scene/volumes/volume_plugin.h"

#include <cmath>

namespace quasilux {

namespace {

struct VolumePlugin {
    std::string_view name;
    void (*read)(Properties&, VolumeDescription&);
};

constexpr VolumePlugin volumePlugins[] = {{"gridvolume", readGridVolume}, {"constvolume", readConstVolume}};

} // namespace

Names volumePluginNames() { return namesOf(volumePlugins); }

VolumeDescription readVolume(const Element& element, LoadContext& context) {
    const VolumePlugin& plugin = findPlugin(volumePlugins, element);
    Properties properties(element, context);
    VolumeDescription volume;
    volume.where = element.where;
    plugin.read(properties, volume);
    properties.finish();
    return volume;
}

unsigned useVolume(const Element& element, LoadContext& context) {
    const auto known = context.volumeIndex.find(&element);
    if (known != context.volumeIndex.end()) return known->second;
    context.scene.volumes.push_back(readVolume(element, context));
    const auto index = static_cast<unsigned>(context.scene.volumes.size() - 1);
    context.volumeIndex.emplace(&element, index);
    return index;
}

void placeVolume(VolumeDescription& volume, const glm::dmat4& toWorld, const SourceLocation& where) {
    const glm::dmat4 toUnit = glm::inverse(toWorld);
    for (int axis = 0; axis < 3; ++axis)
        for (int column = 0; column < 4; ++column) {
            const double entry = toUnit[column][axis] * volume.device.size[axis];
            volume.device.toVoxels[4 * axis + column] = static_cast<float>(entry);
            if (!std::isfinite(volume.device.toVoxels[4 * axis + column]))
                throw InputError(where, "the volume's box has no extent in some direction; give it one.");
        }
    Box box;
    for (int corner = 0; corner < 8; ++corner)
        box.add(transformPoint(toWorld, glm::dvec3(corner & 1, corner >> 1 & 1, corner >> 2)));
    const glm::vec3 low = toSingle(box.lower, where), high = toSingle(box.upper, where);
    volume.device.lower = {low.x, low.y, low.z};
    volume.device.upper = {high.x, high.y, high.z};
}

} // namespace quasilux
