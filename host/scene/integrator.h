// <integrator>: what light it leaves out.
#pragma once

#include "scene/load_context.h"

namespace quasilux {

/// Most segments of a path from light to camera, -1 for no limit.
int readMaxDepth(const Element& element, LoadContext& context);
/// `hide_emitters` of it, or else of the one nested in it.
bool readHideEmitters(const Element& element, LoadContext& context);

} // namespace quasilux
