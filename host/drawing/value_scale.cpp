#include "drawing/value_scale.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <fmt/format.h>

namespace quasilux {

namespace {

/// 1, 2, 5, 10, 20 …, those from `from` to `to`.
std::vector<double> decadeMarks(double from, double to) {
    const bool isLong = std::log10(to / from) > 3;
    std::vector<double> marks;
    for (int decade = static_cast<int>(std::floor(std::log10(from))); std::pow(10.0, decade) <= to; ++decade)
        for (const double factor : {1.0, 2.0, 5.0}) {
            const double mark = factor * std::pow(10.0, decade);
            if ((factor > 1 && isLong) || mark < from * (1 - 1e-9) || mark > to * (1 + 1e-9)) continue;
            marks.push_back(mark);
        }
    return marks;
}

/// 1, 2 or 5 times a power of ten: the least that is no less than `value`, and the greatest that is no more.
double decadeMarkAbove(double value) {
    const double power = std::pow(10.0, std::floor(std::log10(value)));
    for (const double factor : {1.0, 2.0, 5.0})
        if (factor * power >= value * (1 - 1e-9)) return factor * power;
    return 10 * power;
}
double decadeMarkBelow(double value) {
    const double power = std::pow(10.0, std::floor(std::log10(value)));
    for (const double factor : {5.0, 2.0})
        if (factor * power <= value * (1 + 1e-9)) return factor * power;
    return power;
}

/// In order; only finite ones, and of a logarithmic scale only those above 0.
void keepUsable(std::vector<double>& values, bool logarithmic) {
    values.erase(std::remove_if(values.begin(), values.end(),
                                [&](double v) { return !std::isfinite(v) || (logarithmic && v <= 0); }),
                 values.end());
    std::sort(values.begin(), values.end());
}

/// Five decades at most.
ValueScale logarithmicScale(double least, double largest) {
    const double to = decadeMarkAbove(largest);
    return {std::min(decadeMarkBelow(std::max(least, to * 1e-5)), to / 2), to, true};
}

} // namespace

double ValueScale::shareOf(double value) const {
    if (!logarithmic) return (value - from) / (to - from);
    return value > 0 ? std::log(value / from) / std::log(to / from) : -1;
}

std::vector<double> ValueScale::marks() const {
    if (logarithmic) return decadeMarks(from, to);
    const double step = niceStep(to - from);
    std::vector<double> marks;
    for (auto k = static_cast<int64_t>(std::ceil(from / step - 1e-9));
         static_cast<double>(k) * step <= to + 1e-9 * step; ++k)
        marks.push_back(static_cast<double>(k) * step);
    return marks;
}

double niceStep(double largest) {
    const double power = std::pow(10.0, std::floor(std::log10(largest / 4)));
    for (const double factor : {5.0, 2.0})
        if (factor * power <= largest / 4 * (1 + 1e-9)) return factor * power;
    return power;
}

ValueScale automaticScale(std::vector<double> values, bool logarithmic, double above) {
    keepUsable(values, logarithmic);
    if (values.empty() || !(values.back() > 0)) return {logarithmic ? 0.1 : 0, 1, logarithmic};
    const auto rankOf = [&](double share) {
        return values[static_cast<size_t>(share * static_cast<double>(values.size() - 1))];
    };
    const double largest = rankOf(1 - above) > 0 ? rankOf(1 - above) : values.back();
    if (logarithmic) return logarithmicScale(rankOf(0.01), largest);
    const double step = niceStep(largest);
    return {0, step * std::ceil(largest / step - 1e-9), false};
}

ValueScale closeScale(const std::vector<double>& values, bool logarithmic) {
    std::vector<double> usable = values;
    keepUsable(usable, logarithmic);
    if (usable.empty() || !(usable.back() > 0)) return automaticScale(usable, logarithmic, 0);
    if (logarithmic) return logarithmicScale(usable.front(), usable.back());
    const double span = std::max(usable.back() - usable.front(), 0.1 * usable.back()), step = niceStep(span);
    const double from = step * std::floor(usable.front() / step + 1e-9),
                 to = step * std::ceil(usable.back() / step - 1e-9);
    return {from, to > from ? to : from + step, false};
}

std::string markText(double value) { return fmt::format("{:.6g}", std::abs(value) < 1e-12 ? 0.0 : value); }

} // namespace quasilux
