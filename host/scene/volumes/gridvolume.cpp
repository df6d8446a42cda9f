// <volume type="gridvolume">: values at the centres of voxels, from a .vol file.
#include "scene/volumes/vol_file.h"
#include "scene/volumes/volume_plugin.h"

#include <algorithm>
#include <fmt/format.h>
#include <glm/ext/matrix_transform.hpp>

namespace quasilux {

void readGridVolume(Properties& properties, VolumeDescription& volume) {
    const std::string name = properties.string("filename", "");
    const SourceLocation where = properties.where("filename");
    if (name.empty())
        throw InputError(where,
                         fmt::format("{} needs <string name=\"filename\" value=\"….vol\"/>.", properties.describe()));
    const Names filters = {"nearest", "trilinear"}, wraps = {"repeat", "mirror", "clamp"};
    const auto indexOf = [](const Names& names, const std::string& value) {
        return static_cast<unsigned>(std::find(names.begin(), names.end(), value) - names.begin());
    };
    // In the order of VOLUME_NEAREST, … and WRAP_REPEAT, ….
    volume.device.filter = indexOf(filters, properties.choice("filter_type", "trilinear", filters));
    volume.device.wrap = indexOf(wraps, properties.choice("wrap_mode", "clamp", wraps));
    const bool useFileBox = properties.boolean("use_grid_bbox", false);
    // Values are taken as they are, as in Mitsuba's RGB mode, and the largest one is known.
    properties.accept({"raw", "accel", "max_value"});
    glm::dmat4 toWorld = properties.transform("to_world");

    VolFile file = readVolFile(properties.context().files.resolve(name, where), where);
    std::copy(file.size.begin(), file.size.end(), volume.device.size);
    volume.device.channels = file.channels;
    volume.values = std::move(file.values);
    if (useFileBox) toWorld = glm::scale(glm::translate(toWorld, file.lower), file.upper - file.lower);
    placeVolume(volume, toWorld, where);
}

} // namespace quasilux
