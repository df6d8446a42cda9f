// IES LM-63 files (.ies), of 1986, 1991, 1995, 2002 and 2019.
#pragma once

#include "scene/goniograms/goniogram.h"

namespace quasilux {

/// `content` is that of the file `path`; a table that TILT names is looked for beside it, where `mayRead` allows it.
Goniogram readIes(const std::string& path, const std::string& content, const FileCheck& mayRead = {});

} // namespace quasilux
