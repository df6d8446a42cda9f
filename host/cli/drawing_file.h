// Drawings in files.
#pragma once

#include "drawing/drawing.h"

namespace quasilux {

/// Throws InputError unless a file of this name, .svg or .png, can be written. `option` is named in the message.
void checkDrawingPath(const std::string& path, const std::string& option);

/// By the ending; whole or not at all. Throws std::runtime_error.
void writeDrawing(const std::string& path, const Drawing& drawing);

} // namespace quasilux
