// A comparison as JSON, with every measure unrounded.
#pragma once

#include "compare/measures.h"

#include <nlohmann/json.hpp>

namespace quasilux {

/// null where a measure is unknown or not finite. docs/reference/command-line.md lists the keys.
nlohmann::json comparisonJson(const Comparison& comparison);

} // namespace quasilux
