// The files of the page, by name ("view.js"). Made at build time from host/view/page.
#pragma once

#include <map>
#include <string>

namespace quasilux {

const std::map<std::string, std::string>& pageFiles();

} // namespace quasilux
