// EULUMDAT files (.ldt).
#pragma once

#include "scene/goniograms/goniogram.h"

namespace quasilux {

/// `content` is that of the file `path`. Throws InputError also where it has no such set of lamps; `where`: of the
/// mention.
Goniogram readEulumdat(const std::string& path, const std::string& content, const SourceLocation& where,
                       size_t lampSet);

} // namespace quasilux
