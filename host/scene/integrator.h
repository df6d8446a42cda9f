// <integrator>: only its limit on the path length has a meaning here.
#pragma once

#include "scene/load_context.h"

namespace quasilux {

/// `max_depth`, -1 for none. Any integrator of Mitsuba is accepted; those that leave light out are warned of.
int readMaxDepth(const Element& element, LoadContext& context);
/// `hide_emitters` of it, or else of the one nested in it.
bool readHideEmitters(const Element& element, LoadContext& context);

} // namespace quasilux
