// Disjoint sets of the numbers 0 to n - 1.
#pragma once

#include <numeric>
#include <utility>
#include <vector>

namespace quasilux {

class UnionFind {
public:
    explicit UnionFind(size_t count) : parent_(count) { std::iota(parent_.begin(), parent_.end(), 0u); }

    /// The least member of the set of `i`.
    unsigned find(unsigned i) {
        while (parent_[i] != i) i = parent_[i] = parent_[parent_[i]];
        return i;
    }

    void unite(unsigned i, unsigned j) {
        i = find(i);
        j = find(j);
        if (j < i) std::swap(i, j);
        parent_[j] = i;
    }

private:
    std::vector<unsigned> parent_;
};

} // namespace quasilux
