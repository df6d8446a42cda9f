// Reading of volumes, values that vary in space. A new plugin is one file here and one line in the table of
// volume_table.cpp (docs/reference/scene-language.md).
#pragma once

#include "scene/properties.h"

namespace quasilux {

/// Reads a <volume>. Throws InputError for unknown plugins and parameters, and for files that cannot be read.
VolumeDescription readVolume(const Element& element, LoadContext& context);

/// Index into Scene::volumes; read once however often it is used.
unsigned useVolume(const Element& element, LoadContext& context);

Names volumePluginNames();

void readGridVolume(Properties& properties, VolumeDescription& volume);
void readConstVolume(Properties& properties, VolumeDescription& volume);

/// The same value everywhere in the box of the unit cube under `toWorld`.
void setConstant(VolumeDescription& volume, Rgb value, const glm::dmat4& toWorld);
/// Where the volume lies: the unit cube under `toWorld` holds its voxels. Throws InputError at `where`.
void placeVolume(VolumeDescription& volume, const glm::dmat4& toWorld, const SourceLocation& where);

} // namespace quasilux
