// All pairs of boxes that overlap.
#pragma once

#include "scene/box.h"

#include <functional>
#include <vector>

namespace quasilux {

/// A binary tree over boxes, split at medians; refers to them.
class BoxTree {
public:
    explicit BoxTree(const std::vector<Box>& boxes);

    /// Calls visit(i, j) with i < j once for every two overlapping boxes, in an order that depends on the boxes alone.
    void visitPairs(const std::function<void(unsigned, unsigned)>& visit) const;
    /// Calls visit(i) for every one that overlaps `box`.
    void visitOverlapping(const Box& box, const std::function<void(unsigned)>& visit) const;

private:
    using Visit = std::function<void(unsigned, unsigned)>;
    struct Node {
        Box box;
        unsigned first = 0, count = 0; ///< leaf: a range of order_
        unsigned left = 0, right = 0;  ///< inner (count 0): nodes
    };
    unsigned build(unsigned first, unsigned last);
    glm::dvec3 doubleCenter(unsigned box) const { return boxes_[box].lower + boxes_[box].upper; }
    void visitWithin(const Node& node, const Visit& visit) const;
    void visitBetween(const Node& a, const Node& b, const Visit& visit) const;
    void visitIfOverlapping(unsigned i, unsigned j, const Visit& visit) const;
    void visitBelow(const Node& node, const Box& box, const std::function<void(unsigned)>& visit) const;

    const std::vector<Box>& boxes_;
    std::vector<unsigned> order_;
    std::vector<Node> nodes_;
};

/// Calls visit(i, j) with i < j once for every two overlapping boxes, in an order that depends on the boxes alone.
/// O(n log n + pairs) also where sizes differ widely: a tree of boxes is walked against itself.
void forEachOverlappingPair(const std::vector<Box>& boxes, const std::function<void(unsigned, unsigned)>& visit);

} // namespace quasilux
