// Whole numbers from JSON: nlohmann::json converts whatever number it finds, also one that does not fit.
#pragma once

#include "util/error.h"

#include <concepts>
#include <cstdint>
#include <limits>
#include <nlohmann/json.hpp>

namespace quasilux {

/// Throws InputError unless it is a whole number of this type.
template <std::unsigned_integral T>
T wholeNumber(const nlohmann::json& json) {
    if (!json.is_number_unsigned() || json.get<uint64_t>() > std::numeric_limits<T>::max())
        throw InputError(json.dump() + " where a whole number from 0 to " +
                         std::to_string(std::numeric_limits<T>::max()) + " is expected");
    return json.get<T>();
}

} // namespace quasilux
