#include "drawing/contours.h"

#include <algorithm>
#include <cmath>
#include <map>

namespace quasilux {

namespace {

/// An edge of the grid of values: from crossing (i, j) to the right, or upwards.
struct Edge {
    size_t i, j;
    bool upwards;

    friend auto operator<=>(const Edge&, const Edge&) = default;
};

/// A piece of a line, from edge to edge of a cell.
using Segment = std::pair<Edge, Edge>;

class Marcher {
public:
    Marcher(const Field& field, double level) : field_(field), level_(level) {
        for (size_t j = 0; j + 1 < field.y.size(); ++j)
            for (size_t i = 0; i + 1 < field.x.size(); ++i) addCell(i, j);
    }

    std::vector<std::vector<Place>> lines() {
        std::multimap<Edge, size_t> at;
        for (size_t k = 0; k < segments_.size(); ++k) {
            at.emplace(segments_[k].first, k);
            at.emplace(segments_[k].second, k);
        }
        std::vector<bool> taken(segments_.size(), false);
        std::vector<std::vector<Place>> lines;
        // Those that end at the border first, from their ends; what is left is closed.
        for (const bool fromEnds : {true, false})
            for (size_t k = 0; k < segments_.size(); ++k) {
                if (taken[k]) continue;
                for (const Edge& start : {segments_[k].first, segments_[k].second})
                    if (!taken[k] && (!fromEnds || at.count(start) == 1)) lines.push_back(follow(start, k, at, taken));
            }
        return lines;
    }

private:
    bool isAbove(size_t i, size_t j) const { return field_.at(i, j) >= level_; }

    void addCell(size_t i, size_t j) {
        const Edge bottom{i, j, false}, top{i, j + 1, false}, left{i, j, true}, right{i + 1, j, true};
        const unsigned corners = (isAbove(i, j) ? 1u : 0u) | (isAbove(i + 1, j) ? 2u : 0u) |
                                 (isAbove(i + 1, j + 1) ? 4u : 0u) | (isAbove(i, j + 1) ? 8u : 0u);
        const auto add = [&](const Edge& a, const Edge& b) { segments_.emplace_back(a, b); };
        switch (std::min(corners, 15u - corners)) { // the same line whichever side is above
        case 1:
            return add(left, bottom);
        case 2:
            return add(bottom, right);
        case 3:
            return add(left, right);
        case 4:
            return add(right, top);
        case 6:
            return add(bottom, top);
        case 7:
            return add(left, top);
        case 5: {
            const double mean =
                (field_.at(i, j) + field_.at(i + 1, j) + field_.at(i + 1, j + 1) + field_.at(i, j + 1)) / 4;
            // Corners (i, j) and (i + 1, j + 1) are on one side: cut off one by one, or the other two.
            if ((mean >= level_) == (corners == 5)) {
                add(left, top);
                add(bottom, right);
            } else {
                add(left, bottom);
                add(right, top);
            }
            return;
        }
        default:
            return;
        }
    }

    Place placeOn(const Edge& edge) const {
        const double here = field_.at(edge.i, edge.j),
                     next = edge.upwards ? field_.at(edge.i, edge.j + 1) : field_.at(edge.i + 1, edge.j);
        const double t = (level_ - here) / (next - here);
        if (edge.upwards) return {field_.x[edge.i], std::lerp(field_.y[edge.j], field_.y[edge.j + 1], t)};
        return {std::lerp(field_.x[edge.i], field_.x[edge.i + 1], t), field_.y[edge.j]};
    }

    std::vector<Place> follow(Edge from, size_t segment, const std::multimap<Edge, size_t>& at,
                              std::vector<bool>& taken) const {
        std::vector<Place> line{placeOn(from)};
        for (bool goesOn = true; goesOn;) {
            taken[segment] = true;
            from = segments_[segment].first == from ? segments_[segment].second : segments_[segment].first;
            line.push_back(placeOn(from));
            goesOn = false;
            const auto [first, last] = at.equal_range(from);
            for (auto next = first; next != last && !goesOn; ++next)
                if (!taken[next->second]) {
                    segment = next->second;
                    goesOn = true;
                }
        }
        return line;
    }

    const Field& field_;
    double level_;
    std::vector<Segment> segments_;
};

/// Index of the interval of `places` that holds `at`, and how far in it.
std::pair<size_t, double> intervalOf(const std::vector<double>& places, double at) {
    if (places.size() < 2) return {0, 0};
    const auto above = std::upper_bound(places.begin() + 1, places.end() - 1, at);
    const auto k = static_cast<size_t>(above - places.begin()) - 1;
    return {k, std::clamp((at - places[k]) / (places[k + 1] - places[k]), 0.0, 1.0)};
}

} // namespace

double Field::value(double atX, double atY) const {
    const auto [i, s] = intervalOf(x, atX);
    const auto [j, t] = intervalOf(y, atY);
    const size_t iNext = std::min(i + 1, x.size() - 1), jNext = std::min(j + 1, y.size() - 1);
    return std::lerp(std::lerp(at(i, j), at(iNext, j), s), std::lerp(at(i, jNext), at(iNext, jNext), s), t);
}

std::vector<std::vector<Place>> contoursOf(const Field& field, double level) { return Marcher(field, level).lines(); }

double lengthOf(const std::vector<Place>& line) {
    double sum = 0;
    for (size_t k = 1; k < line.size(); ++k) sum += std::hypot(line[k].x - line[k - 1].x, line[k].y - line[k - 1].y);
    return sum;
}

Place middleOf(const std::vector<Place>& line) {
    double left = lengthOf(line) / 2;
    for (size_t k = 1; k < line.size(); ++k) {
        const double here = std::hypot(line[k].x - line[k - 1].x, line[k].y - line[k - 1].y);
        if (here >= left && here > 0)
            return {std::lerp(line[k - 1].x, line[k].x, left / here), std::lerp(line[k - 1].y, line[k].y, left / here)};
        left -= here;
    }
    return line.empty() ? Place{} : line.back();
}

} // namespace quasilux
