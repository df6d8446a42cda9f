// Reading of media. A new plugin is one file here and one line in the table of medium_table.cpp
// (docs/reference/scene-language.md).
#pragma once

#include "scene/properties.h"

namespace quasilux {

/// Reads a <medium> and its phase function. Throws InputError for unknown plugins and parameters.
MediumDescription readMedium(const Element& element, LoadContext& context);

/// Index into Scene::media of the medium that `element` describes; read once however often it is used.
unsigned useMedium(const Element& element, LoadContext& context);

Names mediumPluginNames();

void readHomogeneous(Properties& properties, MediumDescription& medium);
void readHeterogeneous(Properties& properties, MediumDescription& medium);

} // namespace quasilux
