// All pairs of boxes that overlap: a binary tree, split at medians, walked against itself.
#include "prepare/border_pairs.h"

#include <algorithm>
#include <numeric>
#include <utility>

namespace quasilux {
namespace {

constexpr unsigned leafSize = 4;

struct Node {
    Box box;
    unsigned first = 0, count = 0; ///< leaf: a range of `order`
    unsigned left = 0, right = 0;  ///< inner (count 0): nodes
};

class BoxTree {
public:
    BoxTree(const std::vector<Box>& boxes, const std::function<void(unsigned, unsigned)>& visit)
        : boxes_(boxes), visit_(visit), order_(boxes.size()) {
        std::iota(order_.begin(), order_.end(), 0u);
        if (!order_.empty()) build(0, unsigned(order_.size()));
    }

    void visitPairs() const {
        if (!nodes_.empty()) visitWithin(nodes_[0]);
    }

private:
    unsigned build(unsigned first, unsigned last) {
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

    glm::dvec3 doubleCenter(unsigned box) const { return boxes_[box].lower + boxes_[box].upper; }

    void visitWithin(const Node& node) const {
        if (node.count > 0) {
            for (unsigned i = node.first; i < node.first + node.count; ++i)
                for (unsigned j = i + 1; j < node.first + node.count; ++j) visitIfOverlapping(order_[i], order_[j]);
            return;
        }
        visitWithin(nodes_[node.left]);
        visitWithin(nodes_[node.right]);
        visitBetween(nodes_[node.left], nodes_[node.right]);
    }

    void visitBetween(const Node& a, const Node& b) const {
        if (!a.box.overlaps(b.box)) return;
        if (a.count > 0 && b.count > 0) {
            for (unsigned i = a.first; i < a.first + a.count; ++i)
                for (unsigned j = b.first; j < b.first + b.count; ++j) visitIfOverlapping(order_[i], order_[j]);
        } else if (b.count > 0 || (a.count == 0 && a.box.diagonal() >= b.box.diagonal())) {
            visitBetween(nodes_[a.left], b);
            visitBetween(nodes_[a.right], b);
        } else {
            visitBetween(a, nodes_[b.left]);
            visitBetween(a, nodes_[b.right]);
        }
    }

    void visitIfOverlapping(unsigned i, unsigned j) const {
        if (boxes_[i].overlaps(boxes_[j])) visit_(std::min(i, j), std::max(i, j));
    }

    const std::vector<Box>& boxes_;
    const std::function<void(unsigned, unsigned)>& visit_;
    std::vector<unsigned> order_;
    std::vector<Node> nodes_;
};

} // namespace

void forEachOverlappingPair(const std::vector<Box>& boxes, const std::function<void(unsigned, unsigned)>& visit) {
    BoxTree(boxes, visit).visitPairs();
}

} // namespace quasilux
