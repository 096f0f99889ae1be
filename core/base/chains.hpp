// Disjoint sets: members joined by ties form chains, each of which has a number.
#pragma once

#include <numeric>
#include <vector>

namespace voussoir {

class Chains {
 public:
  explicit Chains(std::size_t count) : parent_(count) { std::iota(parent_.begin(), parent_.end(), 0); }
  // the number of the chain to which it belongs; tying changes it
  int find(int member) {
    while (parent_[member] != member)
      member = parent_[member] = parent_[parent_[member]];
    return member;
  }
  void tie(int a, int b) { parent_[find(a)] = find(b); }

 private:
  std::vector<int> parent_;
};

}  // namespace voussoir
