#include "core/support/grout.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>
#include <stdexcept>

namespace voussoir {

namespace {

// Forces balance if their sum is no more than the rounding of its terms: a node has up to four springs, whose
// trial forces have four roundings each, and the solution adds as many.
constexpr double balanced = 32 * std::numeric_limits<double>::epsilon();

struct Answer {
  double force = 0, tangent = 0;
};

// an elastic, perfectly plastic spring; it yields at `strength`
Answer answer(double trial, double stiffness, double strength) {
  if (trial > strength) return {strength + residual_stiffness * (trial - strength), residual_stiffness * stiffness};
  if (trial < -strength) return {-strength + residual_stiffness * (trial + strength), residual_stiffness * stiffness};
  return {trial, stiffness};
}

double bond_of(const GroutedBar& bar, int i) {
  return bar.bond_stiffness * bar.bond_length[i];
}
double rod_of(const GroutedBar& bar, int i) {
  return bar.axial_stiffness / (bar.position[i + 1] - bar.position[i]);
}

// the support of the collar in this step
struct Collar {
  Plate plate = Plate::none;
  double jack = 0;  // N, instead of a plate
};

// The incremental problem: the unknowns are the nodes' displacements from `state`. Its potential is strictly convex,
// piecewise quadratic and once differentiable; the residual is its gradient.
struct Problem {
  const GroutedBar& bar;
  const GroutedBarState& state;
  const std::vector<double>& rock_move;
  Collar collar;

  int nodes() const { return static_cast<int>(bar.position.size()); }
  int begin() const { return collar.plate == Plate::tied ? 1 : 0; }  // first node that is free

  double bond_trial(int i, double move) const { return state.bond_force[i] + bond_of(bar, i) * (move - rock_move[i]); }
  double rod_trial(int i, double move, double next) const {
    return state.bar_force[i] + rod_of(bar, i) * (next - move);
  }
  Answer bond(int i, double move) const { return answer(bond_trial(i, move), bond_of(bar, i), state.bond_strength[i]); }
  Answer rod(int i, double move, double next) const {
    return answer(rod_trial(i, move, next), rod_of(bar, i), state.bar_strength[i]);
  }
  double closure(double move) const { return state.plate_closure + (move - rock_move[0]); }
  Answer plate(double move) const {
    if (collar.plate == Plate::none) return {collar.jack, 0};
    const double closed = closure(move);
    if (collar.plate == Plate::tied || !(closed > 0)) return {};
    return {bar.plate_stiffness * closed, bar.plate_stiffness};
  }

  // gradient and Hessian; whether the gradient is rounding
  bool linearise(const std::vector<double>& move, GroutWorkspace& w) const {
    const int n = nodes();
    bool is_balanced = true;
    double below = 0, below_scale = 0;  // of the element before
    for (int i = 0; i < n; ++i) {
      const Answer b = bond(i, move[i]), p = i == 0 ? plate(move[0]) : Answer();
      const Answer r = i + 1 < n ? rod(i, move[i], move[i + 1]) : Answer();
      const double k = i + 1 < n ? rod_of(bar, i) : 0;
      const double scale =
          i + 1 < n ? std::abs(state.bar_force[i]) + k * (std::abs(move[i]) + std::abs(move[i + 1])) : 0;
      const double bond_scale =
          std::abs(state.bond_force[i]) + bond_of(bar, i) * (std::abs(move[i]) + std::abs(rock_move[i]));
      w.residual[i] = b.force + p.force + (below - r.force);
      w.held[i] = b.tangent + p.tangent;
      w.rod[i] = r.tangent;
      const bool held = i < begin();
      if (!held && std::abs(w.residual[i]) > balanced * (bond_scale + std::abs(p.force) + scale + below_scale))
        is_balanced = false;
      below = r.force;
      below_scale = scale;
    }
    return is_balanced;
  }

  // derivative of the potential along a step
  double slope(const std::vector<double>& move, const std::vector<double>& step) const {
    const int n = nodes();
    double sum = plate(move[0]).force * step[0];
    for (int i = 0; i < n; ++i) {
      sum += bond(i, move[i]).force * step[i];
      if (i + 1 < n) sum += rod(i, move[i], move[i + 1]).force * (step[i + 1] - step[i]);
    }
    return sum;
  }
};

// Thomas' algorithm for nodes in a row that springs w.held connect to the ground and elements w.rod to the next node;
// w.residual loads them. Eliminating a node leaves its springs in series, so that only positive numbers are added:
// every pivot is accurate to rounding, however soft the bar's support. The first `begin` nodes do not move.
void solve(int begin, GroutWorkspace& w) {
  const int n = static_cast<int>(w.held.size());
  std::fill(w.step.begin(), w.step.begin() + begin, 0.0);
  for (int i = begin; i < n; ++i) {
    w.step[i] = -w.residual[i];
    if (i == 0) continue;
    if (i == begin) {
      w.held[i] += w.rod[i - 1];
      continue;
    }
    const double fraction = w.rod[i - 1] / (w.held[i - 1] + w.rod[i - 1]);
    w.held[i] += fraction * w.held[i - 1];
    w.step[i] += fraction * w.step[i - 1];
  }
  w.step[n - 1] /= w.held[n - 1];
  for (int i = n - 2; i >= begin; --i)
    w.step[i] = (w.step[i] + w.rod[i] * w.step[i + 1]) / (w.held[i] + w.rod[i]);
}

// the point of the step at which a spring's trial force meets a bound
void add_kink(double trial, double change, double bound, std::vector<double>& kinks) {
  const double left = bound - trial;
  // within (0, 1), and no overflow
  if (left != 0 && (left > 0) == (change > 0) && std::abs(left) < std::abs(change)) kinks.push_back(left / change);
}

// Moves along w.step to the least potential, or to its end if the potential still falls there. The slope is piecewise
// linear and increasing: its root lies between two neighbouring kinks and is exact.
void search(const Problem& problem, GroutWorkspace& w) {
  const int n = problem.nodes();
  const auto slope_at = [&](double t) {
    for (int i = 0; i < n; ++i)
      w.trial[i] = w.move[i] + t * w.step[i];
    return problem.slope(w.trial, w.step);
  };
  double t = 1;
  if (slope_at(1) > 0) {
    w.kinks.clear();
    for (int i = 0; i < n; ++i) {
      const double trial = problem.bond_trial(i, w.move[i]), change = bond_of(problem.bar, i) * w.step[i];
      for (const double sign : {-1, 1})
        add_kink(trial, change, sign * problem.state.bond_strength[i], w.kinks);
      if (i + 1 == n) continue;
      const double rod = problem.rod_trial(i, w.move[i], w.move[i + 1]);
      const double stretch = rod_of(problem.bar, i) * (w.step[i + 1] - w.step[i]);
      for (const double sign : {-1, 1})
        add_kink(rod, stretch, sign * problem.state.bar_strength[i], w.kinks);
    }
    if (problem.collar.plate == Plate::spring) add_kink(problem.closure(w.move[0]), w.step[0], 0, w.kinks);
    std::sort(w.kinks.begin(), w.kinks.end());
    const auto above =
        std::partition_point(w.kinks.begin(), w.kinks.end(), [&](double kink) { return slope_at(kink) <= 0; });
    const double low = above == w.kinks.begin() ? 0 : *(above - 1), high = above == w.kinks.end() ? 1 : *above;
    const double falls = -slope_at(low), rises = slope_at(high);
    // at rounding the slope at the start may not fall
    t = falls > 0 ? low + (high - low) * (falls / (falls + rises)) : low;
    if (!(t > 0)) t = high;
  }
  for (int i = 0; i < n; ++i)
    w.move[i] += t * w.step[i];
}

void size(std::size_t n, GroutWorkspace& w) {
  for (std::vector<double>* v : {&w.move, &w.step, &w.trial, &w.residual, &w.held, &w.rod, &w.rock_move})
    v->resize(n);
  w.kinks.reserve(4 * n);
}

// the plastic displacement of a spring, and the energy lost; the new force is the state's
double yielded(double trial, double stiffness, double& force, double& strength, double& plastic) {
  const double old = force;
  force = answer(trial, stiffness, strength).force;
  strength = std::max(strength, std::abs(force));
  if (force == trial) return 0;
  const double slip = (trial - force) / stiffness;
  plastic += slip;
  return 0.5 * (old + force) * slip;
}

double stored(const GroutedBar& bar, const GroutedBarState& state) {
  double twice = 0;
  const int n = static_cast<int>(bar.position.size());
  for (int i = 0; i < n; ++i) {
    if (bond_of(bar, i) > 0) twice += state.bond_force[i] * state.bond_force[i] / bond_of(bar, i);
    if (i + 1 < n) twice += state.bar_force[i] * state.bar_force[i] / rod_of(bar, i);
  }
  if (bar.plate == Plate::spring) twice += state.plate_force * state.plate_force / bar.plate_stiffness;
  return 0.5 * twice;
}

// Equilibrium after the rock has moved by w.rock_move with this support of the collar; w.move is the nodes'
// displacement, and the history is updated, except for the plate.
GroutStep equilibrate(const GroutedBar& bar, Collar collar, GroutedBarState& state, GroutWorkspace& w) {
  const Problem problem{bar, state, w.rock_move, collar};
  const int n = problem.nodes();
  std::fill(w.move.begin(), w.move.end(), 0.0);
  if (collar.plate == Plate::tied) w.move[0] = w.rock_move[0];

  GroutStep result;
  while (!(result.converged = problem.linearise(w.move, w)) && result.iterations < most_grout_iterations) {
    solve(problem.begin(), w);
    search(problem, w);
    ++result.iterations;
  }
  if (!result.converged) return result;

  for (int i = 0; i < n; ++i) {
    const double old = state.bond_force[i];
    if (bond_of(bar, i) > 0)
      result.dissipated += yielded(problem.bond_trial(i, w.move[i]), bond_of(bar, i), state.bond_force[i],
                                   state.bond_strength[i], state.slip[i]);
    result.work += 0.5 * (old + state.bond_force[i]) * -w.rock_move[i];
    if (i + 1 < n)
      result.dissipated += yielded(problem.rod_trial(i, w.move[i], w.move[i + 1]), rod_of(bar, i), state.bar_force[i],
                                   state.bar_strength[i], state.plastic_stretch[i]);
    state.displacement[i] += w.move[i];
    state.rock[i] += w.rock_move[i];
  }
  return result;
}

// the same with the bar's own plate, which takes part
GroutStep follow(const GroutedBar& bar, GroutedBarState& state, GroutWorkspace& w) {
  const std::size_t n = bar.position.size();
  GroutStep result = equilibrate(bar, {bar.plate, 0}, state, w);
  if (!result.converged) return result;

  const double old = state.plate_force;
  if (bar.plate == Plate::tied) {
    state.plate_force = (n > 1 ? state.bar_force[0] : 0) - state.bond_force[0];
  } else if (bar.plate == Plate::spring) {
    state.plate_closure += w.move[0] - w.rock_move[0];
    state.plate_force = bar.plate_stiffness * std::max(state.plate_closure, 0.0);
  }
  result.work -= 0.5 * (old + state.plate_force) * w.rock_move[0];
  result.stored = stored(bar, state);
  return result;
}

// the stiffness of a bar's springs for small motion: without slip, or, with a state, in that state
struct Tangent {
  const GroutedBar& bar;
  const GroutedBarState* state = nullptr;

  static double left_of(double stiffness, double force, double strength) {
    return std::abs(force) < strength ? stiffness : residual_stiffness * stiffness;
  }
  double bond(int i) const {
    return state ? left_of(bond_of(bar, i), state->bond_force[i], state->bond_strength[i]) : bond_of(bar, i);
  }
  double rod(int i) const {
    return state ? left_of(rod_of(bar, i), state->bar_force[i], state->bar_strength[i]) : rod_of(bar, i);
  }
  double plate() const {
    return bar.plate == Plate::spring && !(state && !(state->plate_closure > 0)) ? bar.plate_stiffness : 0;
  }
};

// w.step: the nodes' displacement when the rock at the nodes chosen by `moves` moves by 1
template <class Moves>
void respond(const Tangent& tangent, Moves moves, GroutWorkspace& w) {
  const int n = static_cast<int>(tangent.bar.position.size()), begin = tangent.bar.plate == Plate::tied ? 1 : 0;
  const auto rock = [&](int i) { return moves(i) ? 1.0 : 0.0; };
  for (int i = 0; i < n; ++i) {
    w.held[i] = tangent.bond(i) + (i == 0 ? tangent.plate() : 0);
    w.rod[i] = i + 1 < n ? tangent.rod(i) : 0;
    w.residual[i] = -w.held[i] * rock(i);
  }
  if (begin == 1) w.residual[1] -= w.rod[0] * rock(0);
  solve(begin, w);
  if (begin == 1) w.step[0] = rock(0);
}

}  // namespace

void lay_nodes(double length, std::span<const double> joints, double spacing, GroutedBar& bar) {
  assert(length > 0 && spacing > 0);
  bar.position = {0};
  bar.bond_length = {0};
  double from = 0;
  for (std::size_t j = 0; j <= joints.size(); ++j) {
    const double to = j < joints.size() ? joints[j] : length;
    assert(to > from && to <= length);
    const int cells = static_cast<int>(std::ceil((to - from) / spacing));
    const double cell = (to - from) / cells;
    for (int i = 0; i < cells; ++i) {
      bar.position.push_back(from + (i + 0.5) * cell);
      bar.bond_length.push_back(cell);
    }
    from = to;
  }
}

bool is_held(const GroutedBar& bar) {
  const bool bonded = bar.bond_stiffness > 0 && *std::max_element(bar.bond_length.begin(), bar.bond_length.end()) > 0;
  return bonded || bar.plate == Plate::tied;
}

GroutedBarState installed(const GroutedBar& bar, std::span<const double> rock) {
  const std::size_t n = bar.position.size();
  assert(n > 0 && rock.size() == n && bar.bond_length.size() == n);
  if (!is_held(bar))
    throw std::invalid_argument("a bar without bond has no support: its grout has neither stiffness nor length");
  GroutedBarState state;
  state.displacement.assign(rock.begin(), rock.end());
  state.rock = state.displacement;
  state.bond_force.assign(n, 0);
  state.slip.assign(n, 0);
  for (const double length : bar.bond_length)
    state.bond_strength.push_back(length > 0 ? bar.bond_strength * length : 0);
  state.bar_force.assign(n - 1, 0);
  state.bar_strength.assign(n - 1, bar.yield_force);
  state.plastic_stretch.assign(n - 1, 0);
  return state;
}

GroutStep move_rock(const GroutedBar& bar, std::span<const double> rock, GroutedBarState& state, GroutWorkspace& w) {
  const std::size_t n = bar.position.size();
  assert(rock.size() == n);
  size(n, w);
  for (std::size_t i = 0; i < n; ++i)
    w.rock_move[i] = rock[i] - state.rock[i];
  GroutStep result;
  // the unbalanced force is rounding of an earlier step
  if (std::all_of(w.rock_move.begin(), w.rock_move.end(), [](double move) { return move == 0; })) {
    result.converged = true;
    result.stored = stored(bar, state);
    return result;
  }
  result = follow(bar, state, w);
  if (result.converged) std::copy(rock.begin(), rock.end(), state.rock.begin());
  return result;
}

GroutStep settle(const GroutedBar& bar, GroutedBarState& state, GroutWorkspace& w) {
  size(bar.position.size(), w);
  std::fill(w.rock_move.begin(), w.rock_move.end(), 0.0);
  return follow(bar, state, w);
}

GroutStep tighten(const GroutedBar& bar, double force, GroutedBarState& state, GroutWorkspace& w) {
  assert(bar.plate != Plate::none && force >= 0);
  size(bar.position.size(), w);
  std::fill(w.rock_move.begin(), w.rock_move.end(), 0.0);
  GroutStep result = equilibrate(bar, {Plate::none, force}, state, w);
  if (!result.converged) return result;

  // the nut moves along the bar by the head's displacement out and the plate's compression
  double path = -w.move[0];
  if (bar.plate == Plate::spring) {
    path += force / bar.plate_stiffness - state.plate_closure;
    state.plate_closure = force / bar.plate_stiffness;
  }
  result.work = 0.5 * (state.plate_force + force) * path;
  state.plate_force = force;
  result.stored = stored(bar, state);
  return result;
}

double elastic_stiffness(const GroutedBar& bar, int first, int last, GroutWorkspace& w) {
  const int n = static_cast<int>(bar.position.size());
  size(n, w);
  const auto moves = [&](int i) { return i >= first && i < last; };
  const auto rock = [&](int i) { return moves(i) ? 1.0 : 0.0; };
  const Tangent elastic{bar};
  respond(elastic, moves, w);
  // twice the energy of a unit displacement
  double sum = elastic.plate() * (w.step[0] - rock(0)) * (w.step[0] - rock(0));
  for (int i = 0; i < n; ++i) {
    sum += bond_of(bar, i) * (w.step[i] - rock(i)) * (w.step[i] - rock(i));
    if (i + 1 < n) sum += rod_of(bar, i) * (w.step[i + 1] - w.step[i]) * (w.step[i + 1] - w.step[i]);
  }
  return sum;
}

void condensed_stiffness(const GroutedBar& bar, const GroutedBarState& state, std::span<const int> stretch,
                         int stretches, GroutWorkspace& w, std::vector<double>& stiffness) {
  const int n = static_cast<int>(bar.position.size());
  assert(std::ssize(stretch) == n);
  size(n, w);
  stiffness.assign(static_cast<std::size_t>(stretches) * stretches, 0);
  const Tangent tangent{bar, &state};
  for (int c = 0; c < stretches; ++c) {
    const auto moves = [&](int i) { return stretch[i] == c; };
    respond(tangent, moves, w);
    double* row = &stiffness[static_cast<std::size_t>(c) * stretches];
    for (int i = 0; i < n; ++i)
      row[stretch[i]] -= tangent.bond(i) * (w.step[i] - (moves(i) ? 1 : 0));
    row[stretch[0]] -= tangent.plate() * (w.step[0] - (moves(0) ? 1 : 0));
    if (bar.plate == Plate::tied) row[stretch[0]] -= tangent.rod(0) * (w.step[1] - w.step[0]);
  }
}

void keep_nodes(int first, int last, GroutedBar& bar, GroutedBarState& state) {
  assert(first < last);
  const auto keep = [&](std::vector<double>& list, int count) {
    list.erase(list.begin() + first + count, list.end());
    list.erase(list.begin(), list.begin() + first);
  };
  const int count = last - first;
  for (std::vector<double>* list : {&bar.position, &bar.bond_length, &state.displacement, &state.rock,
                                    &state.bond_force, &state.bond_strength, &state.slip})
    keep(*list, count);
  for (std::vector<double>* list : {&state.bar_force, &state.bar_strength, &state.plastic_stretch})
    keep(*list, count - 1);
  const double origin = state.rock.front();
  for (int i = 0; i < count; ++i) {
    state.rock[i] -= origin;
    state.displacement[i] -= origin;
  }
  if (first == 0) return;
  bar.plate = Plate::none;
  state.plate_force = state.plate_closure = 0;
}

}  // namespace voussoir
