// The scale of a picture in false colours: which values it spans, and at which of them marks stand.
#pragma once

#include <string>
#include <vector>

namespace quasilux {

struct ValueScale {
    double from = 0, to = 1; ///< from < to; of a logarithmic one both above 0
    bool logarithmic = false;

    /// 0 at `from`, 1 at `to`, beyond them below 0 or above 1.
    double shareOf(double value) const;
    /// Round values within it; of a logarithmic one 1, 2 and 5 times powers of ten where they are few, else powers
    /// alone.
    std::vector<double> marks() const;
};

/// 1, 2 or 5 times a power of ten, so that four to ten of it reach `largest` (above 0).
double niceStep(double largest);

/// Spans `values` from 0 or, logarithmic, from where few lie below, to a round value below which all lie but a share
/// `above`. Values that are not finite do not count. Where nothing is lit, 0 to 1.
ValueScale automaticScale(std::vector<double> values, bool logarithmic, double above);
/// The same between the least and the greatest value.
ValueScale closeScale(const std::vector<double>& values, bool logarithmic);

/// "0.25", "500", "12500", with as many digits as tell neighbours apart.
std::string markText(double value);

} // namespace quasilux
