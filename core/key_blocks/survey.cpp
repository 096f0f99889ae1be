#include "core/key_blocks/survey.hpp"

#include <algorithm>
#include <limits>

namespace voussoir {
namespace {

constexpr double no_limit = std::numeric_limits<double>::infinity();
constexpr double clearly_lower = 1 - 1e-9;  // of a factor: a smaller difference is rounding

template <int Dim>
bool is_enclosed(const BoltedVerdict<Dim>& verdict) {
  return verdict.verdict.kind == BlockKind::enclosed;
}

// the other body of each contact of a body, free ones, ascending
template <int Dim>
std::vector<int> free_neighbours(const Assembly<Dim>& assembly, int body) {
  std::vector<int> neighbours;
  for (const int place : assembly.contacts.of(body)) {
    const RockContact<Dim>& contact = assembly.contacts.list[place];
    const int other = contact.body_a == body ? contact.body_b : contact.body_a;
    if (assembly.free[other]) neighbours.push_back(other);
  }
  std::sort(neighbours.begin(), neighbours.end());
  neighbours.erase(std::unique(neighbours.begin(), neighbours.end()), neighbours.end());
  return neighbours;
}

template <int Dim>
class Judge {
 public:
  Judge(const Assembly<Dim>& assembly, const FurtherLoad<Dim>& more) : assembly_(assembly), more_(more) {}

  BoltedVerdict<Dim> operator()(std::span<const int> bodies, const std::vector<char>& gone = {}) {
    gather(assembly_, bodies, gone, block_);
    return judge_bolted(block_, further(), assembly_.model.gravity);
  }
  // the factor alone; infinite if the block does not move without friction
  double factor(std::span<const int> bodies, const std::vector<char>& gone = {}) {
    gather(assembly_, bodies, gone, block_);
    if (!block_.bolts.empty())
      return judge_bolted(block_, further(), assembly_.model.gravity).factor.value_or(no_limit);
    const Vector<Dim> load = load_without_bolts(block_) + further();
    return judge(block_, load, assembly_.model.gravity, false).factor().value_or(no_limit);
  }

 private:
  Vector<Dim> further() const { return more_ ? more_(block_) : Vector<Dim>::Zero(); }

  const Assembly<Dim>& assembly_;
  const FurtherLoad<Dim>& more_;
  Block<Dim> block_;
};

// grows a cluster by the neighbour that lowers its factor most, while one does
template <int Dim>
std::vector<int> grow(const Assembly<Dim>& assembly, Judge<Dim>& judged, std::vector<int> bodies, double factor,
                      std::size_t most, std::size_t& largest) {
  while (bodies.size() < most) {
    std::vector<int> around, best;
    for (const int body : bodies)
      for (const int other : free_neighbours(assembly, body))
        if (!std::binary_search(bodies.begin(), bodies.end(), other)) around.push_back(other);
    std::sort(around.begin(), around.end());
    around.erase(std::unique(around.begin(), around.end()), around.end());
    if (!around.empty()) largest = std::max(largest, bodies.size() + 1);
    for (const int other : around) {
      std::vector<int> larger = bodies;
      larger.insert(std::lower_bound(larger.begin(), larger.end(), other), other);
      const double found = judged.factor(larger);
      if (found >= factor * clearly_lower) continue;
      factor = found;
      best = std::move(larger);
    }
    if (best.empty()) break;
    bodies = std::move(best);
  }
  return bodies;
}

}  // namespace

template <int Dim>
std::vector<BoltedVerdict<Dim>> judge_all(const Assembly<Dim>& assembly, const FurtherLoad<Dim>& more) {
  Judge<Dim> judged(assembly, more);
  std::vector<BoltedVerdict<Dim>> verdicts(assembly.model.bodies.size());
  for (int b = 0; b < static_cast<int>(verdicts.size()); ++b)
    if (assembly.free[b]) verdicts[b] = judged(std::array{b});
  return verdicts;
}

template <int Dim>
ClusterSearch<Dim> find_clusters(const Assembly<Dim>& assembly, const std::vector<BoltedVerdict<Dim>>& single,
                                 const FurtherLoad<Dim>& more, std::size_t most) {
  ClusterSearch<Dim> search;
  Judge<Dim> judged(assembly, more);
  std::vector<std::vector<int>> lower;
  for (int a = 0; a < static_cast<int>(single.size()); ++a) {
    if (!assembly.free[a]) continue;
    for (const int b : free_neighbours(assembly, a)) {
      if (b < a) continue;
      ++search.pairs;
      if (is_enclosed(single[a]) && is_enclosed(single[b])) continue;  // so are both as one
      const double pair = judged.factor(std::array{a, b});
      if (pair == no_limit) continue;
      ++search.moving_pairs;
      const double least = std::min(single[a].factor.value_or(no_limit), single[b].factor.value_or(no_limit));
      if (pair < least * clearly_lower) lower.push_back(grow(assembly, judged, {a, b}, pair, most, search.largest));
    }
  }
  std::sort(lower.begin(), lower.end());
  lower.erase(std::unique(lower.begin(), lower.end()), lower.end());
  for (std::vector<int>& bodies : lower) {
    const BoltedVerdict<Dim> verdict = judged(bodies);
    search.lower.push_back({std::move(bodies), verdict});
  }
  std::stable_sort(search.lower.begin(), search.lower.end(),
                   [](const Cluster<Dim>& a, const Cluster<Dim>& b) { return *a.verdict.factor < *b.verdict.factor; });
  return search;
}

template <int Dim>
SuccessiveFailure fail_in_rounds(const Assembly<Dim>& assembly, FailureRule rule, double factor,
                                 const FurtherLoad<Dim>& more) {
  const std::size_t bodies = assembly.free.size();
  const double bound = rule == FailureRule::moves ? no_limit : factor;
  SuccessiveFailure failure;
  failure.round_of.assign(bodies, 0);
  std::vector<char> gone(bodies, 0);
  std::vector<int> waiting;
  for (int b = 0; b < static_cast<int>(bodies); ++b)
    if (assembly.free[b]) waiting.push_back(b);
  Judge<Dim> judged(assembly, more);
  while (true) {
    std::vector<int> failed;
    for (const int body : waiting)
      if (judged.factor(std::array{body}, gone) < bound) failed.push_back(body);
    if (failed.empty()) return failure;
    double removed = 0;
    waiting.clear();
    for (const int body : failed) {
      gone[body] = 1;
      failure.round_of[body] = static_cast<int>(failure.rounds.size()) + 1;
      removed += assembly.volumes[body];
    }
    for (const int body : failed)
      for (const int other : free_neighbours(assembly, body))
        if (!gone[other]) waiting.push_back(other);
    std::sort(waiting.begin(), waiting.end());
    waiting.erase(std::unique(waiting.begin(), waiting.end()), waiting.end());
    failure.rounds.push_back(std::move(failed));
    failure.volumes.push_back(removed);
  }
}

#define VOUSSOIR_INSTANTIATE(Dim)                                                                              \
  template std::vector<BoltedVerdict<Dim>> judge_all<Dim>(const Assembly<Dim>&, const FurtherLoad<Dim>&);      \
  template ClusterSearch<Dim> find_clusters<Dim>(const Assembly<Dim>&, const std::vector<BoltedVerdict<Dim>>&, \
                                                 const FurtherLoad<Dim>&, std::size_t);                        \
  template SuccessiveFailure fail_in_rounds<Dim>(const Assembly<Dim>&, FailureRule, double, const FurtherLoad<Dim>&);
VOUSSOIR_INSTANTIATE(2)
VOUSSOIR_INSTANTIATE(3)
#undef VOUSSOIR_INSTANTIATE

}  // namespace voussoir
