// One method for the pairs of a workload: ours or a peer's.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "benchmarks/method_names.hpp"
#include "benchmarks/workload.hpp"

namespace voussoir::benchmarks {

// A method with the pairs of one workload in data structures of its own. A range of pairs is [first, first + count);
// with several threads each has a range to itself.
struct Prepared {
  std::function<void(std::size_t first, std::size_t count)> restore;  // the state before the query; not timed
  std::function<void(std::size_t first, std::size_t count)> resolve;  // timed
  std::function<bool(std::size_t pair)> touching;                     // its decision
  std::shared_ptr<KernelCounters> counters = nullptr;                 // ours only
};

struct Method {
  std::string name;
  std::string stage;                       // decision, lp, centre, point, overlap, area
  std::string delivers;                    // words of `answers` in contact_tables.cpp
  std::function<bool(PairState)> applies;  // the pairs that it supports
  std::function<std::shared_ptr<Prepared>(const Workload&)> prepare;
  std::size_t pairs = pairs_per_workload;  // only this many of the first, if it is slow
  int threads = 1;
};

inline bool overlapping(PairState state) {
  return state == PairState::touch || state == PairState::face || state == PairState::deep;
}
inline bool any_pair(PairState state) {
  return state != PairState::solid && state != PairState::plane;
}
inline bool no_contact(PairState state) {
  return any_pair(state) && !overlapping(state);
}
inline bool solid(PairState state) {
  return state == PairState::solid;
}
inline bool prisms(PairState state) {
  return state == PairState::plane;
}

// most methods: a function of one pair, with stored results
template <class Query>
std::shared_ptr<Prepared> prepared_query(std::size_t pairs, Query query) {
  auto answers = std::make_shared<std::vector<char>>(pairs, 0);
  auto prepared = std::make_shared<Prepared>();
  prepared->restore = [](std::size_t, std::size_t) {};
  prepared->resolve = [answers, query](std::size_t first, std::size_t count) mutable {
    for (std::size_t i = first; i < first + count; ++i)
      (*answers)[i] = query(i);
  };
  prepared->touching = [answers](std::size_t i) { return (*answers)[i] != 0; };
  return prepared;
}

std::vector<Method> own_methods();

}  // namespace voussoir::benchmarks
