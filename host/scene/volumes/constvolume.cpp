// <volume type="constvolume">: one value. As the extinction of a medium it fills the box of the unit cube under
// to_world.
#include "scene/volumes/volume_plugin.h"

namespace quasilux {

void setConstant(VolumeDescription& volume, Rgb value, const glm::dmat4& toWorld) {
    volume.device.size[0] = volume.device.size[1] = volume.device.size[2] = 1;
    volume.device.filter = VOLUME_NEAREST;
    volume.device.wrap = WRAP_CLAMP;
    volume.values = {value.r};
    if (value.g != value.r || value.b != value.r) volume.values = {value.r, value.g, value.b};
    volume.device.channels = static_cast<unsigned>(volume.values.size());
    placeVolume(volume, toWorld, volume.where);
}

void readConstVolume(Properties& properties, VolumeDescription& volume) {
    setConstant(volume, properties.positiveColor("value", {1, 1, 1}, ColorUse::reflectance),
                properties.transform("to_world"));
}

} // namespace quasilux
