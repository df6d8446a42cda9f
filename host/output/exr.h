// Multi-layer OpenEXR: the image, its components, its standard error and bias, with all settings in the header.
#pragma once

#include "output/render_record.h"
#include "render/aovs.h"

namespace quasilux {

/// Channels R, G, B, then `<component>.R` … for each component present, then `stderr.R` … and, where it was
/// estimated, `bias.R` … and `bias_stderr.R` …; float32, zip. The header
/// keys are listed in docs/reference/command-line.md. The file appears whole or not at all. Throws std::runtime_error.
void writeExr(const std::string& path, const FilmImage& image, const RenderRecord& record,
              const std::vector<AovImage>& aovs = {});

} // namespace quasilux
