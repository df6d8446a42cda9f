// All pairs of boxes that overlap: a binary tree, split at medians, walked against itself.
#include "prepare/border_pairs.h"

#include <algorithm>
#include <numeric>
#include <utility>

namespace quasilux {
namespace {

constexpr unsigned leafSize = 4;

} // namespace

BoxTree::BoxTree(const std::vector<Box>& boxes) : boxes_(boxes), order_(boxes.size()) {
    std::iota(order_.begin(), order_.end(), 0u);
    if (!order_.empty()) build(0, unsigned(order_.size()));
}

void BoxTree::visitPairs(const Visit& visit) const {
    if (!nodes_.empty()) visitWithin(nodes_[0], visit);
}

void BoxTree::visitOverlapping(const Box& box, const std::function<void(unsigned)>& visit) const {
    if (!nodes_.empty()) visitBelow(nodes_[0], box, visit);
}

unsigned BoxTree::build(unsigned first, unsigned last) {
    const auto index = unsigned(nodes_.size());
    nodes_.emplace_back();
    Box box, centers;
    for (unsigned i = first; i < last; ++i) {
        box.add(boxes_[order_[i]]);
        centers.add(doubleCenter(order_[i]));
    }
    nodes_[index].box = box;
    if (last - first <= leafSize) {
        nodes_[index].first = first;
        nodes_[index].count = last - first;
        return index;
    }
    const int axis = longestAxis(centers.extent());
    const unsigned middle = first + (last - first) / 2;
    std::nth_element(order_.begin() + first, order_.begin() + middle, order_.begin() + last,
                     [&](unsigned a, unsigned b) {
                         return std::pair(doubleCenter(a)[axis], a) < std::pair(doubleCenter(b)[axis], b);
                     });
    const unsigned left = build(first, middle), right = build(middle, last);
    nodes_[index].left = left;
    nodes_[index].right = right;
    return index;
}

void BoxTree::visitWithin(const Node& node, const Visit& visit) const {
    if (node.count > 0) {
        for (unsigned i = node.first; i < node.first + node.count; ++i)
            for (unsigned j = i + 1; j < node.first + node.count; ++j) visitIfOverlapping(order_[i], order_[j], visit);
        return;
    }
    visitWithin(nodes_[node.left], visit);
    visitWithin(nodes_[node.right], visit);
    visitBetween(nodes_[node.left], nodes_[node.right], visit);
}

void BoxTree::visitBetween(const Node& a, const Node& b, const Visit& visit) const {
    if (!a.box.overlaps(b.box)) return;
    if (a.count > 0 && b.count > 0) {
        for (unsigned i = a.first; i < a.first + a.count; ++i)
            for (unsigned j = b.first; j < b.first + b.count; ++j) visitIfOverlapping(order_[i], order_[j], visit);
    } else if (b.count > 0 || (a.count == 0 && a.box.diagonal() >= b.box.diagonal())) {
        visitBetween(nodes_[a.left], b, visit);
        visitBetween(nodes_[a.right], b, visit);
    } else {
        visitBetween(a, nodes_[b.left], visit);
        visitBetween(a, nodes_[b.right], visit);
    }
}

void BoxTree::visitIfOverlapping(unsigned i, unsigned j, const Visit& visit) const {
    if (boxes_[i].overlaps(boxes_[j])) visit(std::min(i, j), std::max(i, j));
}

void BoxTree::visitBelow(const Node& node, const Box& box, const std::function<void(unsigned)>& visit) const {
    if (!node.box.overlaps(box)) return;
    for (unsigned i = node.first; i < node.first + node.count; ++i)
        if (boxes_[order_[i]].overlaps(box)) visit(order_[i]);
    if (node.count > 0) return;
    visitBelow(nodes_[node.left], box, visit);
    visitBelow(nodes_[node.right], box, visit);
}

void forEachOverlappingPair(const std::vector<Box>& boxes, const std::function<void(unsigned, unsigned)>& visit) {
    BoxTree(boxes).visitPairs(visit);
}

} // namespace quasilux
