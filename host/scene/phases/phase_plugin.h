// Reading of phase functions. A new plugin is one file here and one line in the table of phase_table.cpp
// (docs/method/media.md).
#pragma once

#include "scene/properties.h"

namespace quasilux {

/// Reads a <phase> into MediumDescription::phase and what it needs. Throws InputError for unknown plugins and
/// parameters.
void readPhase(const Element& element, LoadContext& context, MediumDescription& medium);

Names phasePluginNames();

void readIsotropic(Properties& properties, MediumDescription& medium);
void readHenyeyGreenstein(Properties& properties, MediumDescription& medium);
void readRayleigh(Properties& properties, MediumDescription& medium);
void readTabulated(Properties& properties, MediumDescription& medium);
void readBlend(Properties& properties, MediumDescription& medium);

} // namespace quasilux
