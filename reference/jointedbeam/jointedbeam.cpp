#include "reference/jointedbeam/jointedbeam.hpp"

#include <gsl/gsl_errno.h>
#include <gsl/gsl_multiroots.h>
#include <gsl/gsl_roots.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <new>
#include <stdexcept>

#include "reference/parabola.hpp"

namespace voussoir::reference {
namespace {

// scales of the unknowns, so that GSL sees numbers near 1: m, rad, g
constexpr double way = 1e-5, turn = 1e-4, load = 1;
// of the differences that make the Jacobian: far above rounding (1e-17 m of overlap), far below an overlap (1e-6 m)
constexpr double nudge = 1e-10, nudge_turn = 1e-9;
// forces balance to this fraction of thrust or weight: 1e-7 N
constexpr double balanced = 1e-9;
constexpr int most_iterations = 60;
// a step that finds no equilibrium is halved at most so often
constexpr int most_halvings = 6;

enum class Control { gravity, deflection };

struct Chain {
  const JointedBeam& beam;
  double closure = 0;                   // m
  std::vector<BeamBlock> blocks;        // with the abutments at both ends
  double gravity = 0;                   // g
  std::vector<JointHistory> histories;  // by joint

  int joints() const { return beam.blocks + 1; }
  std::size_t unknowns() const { return 3 * static_cast<std::size_t>(beam.blocks) + 1; }
  double weight() const { return beam.density * beam.length * beam.height * beam.width * beam.g; }  // N, of one at 1 g
};

// the middle of a block's right or left face, relative to the middle of the undisplaced joint
BeamFace face_of(const Chain& chain, int block, int side) {
  const JointedBeam& b = chain.beam;
  const bool abutment = block == 0 || block == b.blocks + 1;
  const BeamBlock& at = chain.blocks[block];
  const double half = 0.5 * b.length * side, s = std::sin(0.5 * at.rotation);
  return {at.displacement + half * Point{-2 * s * s, std::sin(at.rotation)}, at.rotation,
          abutment ? b.abutment_height : b.height};
}

JointForce force_at(const Chain& chain, int joint, JointHistory& next) {
  return joint_force(chain.beam.joint, chain.beam.width, face_of(chain, joint, 1), face_of(chain, joint + 1, -1),
                     chain.histories[joint], next);
}

double deflection_of(const Chain& chain) {
  const int n = chain.beam.blocks;
  if (n % 2 == 1) return -chain.blocks[(n + 1) / 2].displacement.y;
  return -0.5 * (face_of(chain, n / 2, 1).middle.y + face_of(chain, n / 2 + 1, -1).middle.y);
}

// force on and moment about the centroid of the bodies left and right of a joint
using Six = std::array<double, 6>;
Six loads_of(const Chain& chain, int joint) {
  static thread_local JointHistory unused;
  const JointForce f = force_at(chain, joint, unused);
  const Point from = face_of(chain, joint, 1).middle, middle{0.5 * chain.beam.length, 0};
  const Point left = from + middle - chain.blocks[joint].displacement;
  const Point right = from - middle - chain.blocks[joint + 1].displacement;
  const auto about = [&](Point arm) { return f.moment + arm.x * f.force.y - arm.y * f.force.x; };
  return {-f.force.x, -f.force.y, -about(left), f.force.x, f.force.y, about(right)};
}

// ---- the equations ------------------------------------------------------------------------------------------------

struct Problem {
  Chain chain;
  Control control;
  double wanted;  // g or m
  double scale;   // N
};

double& freedom(Chain& chain, int block, int k) {
  BeamBlock& b = chain.blocks[block];
  return k == 0 ? b.displacement.x : k == 1 ? b.displacement.y : b.rotation;
}

void place(Problem& p, const gsl_vector* x) {
  for (int i = 0; i < 3 * p.chain.beam.blocks; ++i)
    freedom(p.chain, i / 3 + 1, i % 3) = gsl_vector_get(x, i) * (i % 3 == 2 ? turn : way);
  p.chain.gravity = gsl_vector_get(x, 3 * p.chain.beam.blocks) * load;
}

// moments are divided by the height
double fraction(const Problem& p, int k) {
  return 1 / (k == 2 ? p.scale * p.chain.beam.height : p.scale);
}

double missing(const Problem& p) {
  return p.control == Control::gravity ? (p.chain.gravity - p.wanted) / load
                                       : (deflection_of(p.chain) - p.wanted) / way;
}

int evaluate(const gsl_vector* x, void* data, gsl_vector* f) {
  Problem& p = *static_cast<Problem*>(data);
  place(p, x);
  const int n = p.chain.beam.blocks;
  gsl_vector_set_zero(f);
  for (int b = 0; b < n; ++b)
    gsl_vector_set(f, 3 * b + 1, -fraction(p, 1) * p.chain.weight() * p.chain.gravity);
  for (int joint = 0; joint <= n; ++joint) {
    const Six loads = loads_of(p.chain, joint);
    for (int k = 0; k < 6; ++k) {
      const int block = joint + k / 3 - 1;
      if (block < 0 || block >= n) continue;
      double& sum = *gsl_vector_ptr(f, 3 * block + k % 3);
      sum += fraction(p, k % 3) * loads[k];
    }
  }
  gsl_vector_set(f, 3 * n, missing(p));
  return GSL_SUCCESS;
}

// by central differences: a block's freedoms affect its two joints only
int differentiate(const gsl_vector* x, void* data, gsl_matrix* jacobian) {
  Problem& p = *static_cast<Problem*>(data);
  place(p, x);
  const int n = p.chain.beam.blocks;
  gsl_matrix_set_zero(jacobian);
  for (int i = 0; i < 3 * n; ++i) {
    const int block = i / 3 + 1;
    double& q = freedom(p.chain, block, i % 3);
    const double at = q, step = i % 3 == 2 ? nudge_turn : nudge, unit = i % 3 == 2 ? turn : way;
    const auto slope = [&](double high, double low) { return (high - low) / (2 * step) * unit; };
    for (int joint = block - 1; joint <= block; ++joint) {
      q = at + step;
      const Six high = loads_of(p.chain, joint);
      q = at - step;
      const Six low = loads_of(p.chain, joint);
      q = at;
      for (int k = 0; k < 6; ++k) {
        const int felt = joint + k / 3 - 1;
        if (felt < 0 || felt >= n) continue;
        double& entry = *gsl_matrix_ptr(jacobian, 3 * felt + k % 3, i);
        entry += fraction(p, k % 3) * slope(high[k], low[k]);
      }
    }
    q = at + step;
    const double high = missing(p);
    q = at - step;
    const double low = missing(p);
    q = at;
    gsl_matrix_set(jacobian, 3 * n, i, slope(high, low));
  }
  for (int b = 0; b < n; ++b)
    gsl_matrix_set(jacobian, 3 * b + 1, 3 * n, -fraction(p, 1) * p.chain.weight() * load);
  if (p.control == Control::gravity) gsl_matrix_set(jacobian, 3 * n, 3 * n, 1);
  return GSL_SUCCESS;
}

int both(const gsl_vector* x, void* data, gsl_vector* f, gsl_matrix* jacobian) {
  evaluate(x, data, f);
  return differentiate(x, data, jacobian);
}

// Equilibrium from the present position of the chain; false: none was found, and the chain is unchanged.
bool settle(Chain& chain, Control control, double wanted) {
  gsl_set_error_handler_off();
  const double scale = std::max(chain.beam.thrust, chain.weight() * chain.beam.blocks * std::max(1.0, chain.gravity));
  Problem problem{chain, control, wanted, scale};
  const std::size_t n = chain.unknowns();
  gsl_multiroot_function_fdf system{evaluate, differentiate, both, n, &problem};
  const std::unique_ptr<gsl_vector, decltype(&gsl_vector_free)> x(gsl_vector_calloc(n), gsl_vector_free);
  const std::unique_ptr<gsl_multiroot_fdfsolver, decltype(&gsl_multiroot_fdfsolver_free)> solver(
      gsl_multiroot_fdfsolver_alloc(gsl_multiroot_fdfsolver_hybridsj, n), gsl_multiroot_fdfsolver_free);
  if (!x || !solver) throw std::bad_alloc();
  for (int i = 0; i < 3 * chain.beam.blocks; ++i)
    gsl_vector_set(x.get(), i, freedom(chain, i / 3 + 1, i % 3) / (i % 3 == 2 ? turn : way));
  gsl_vector_set(x.get(), n - 1, (control == Control::gravity ? wanted : chain.gravity) / load);
  if (gsl_multiroot_fdfsolver_set(solver.get(), &system, x.get()) != GSL_SUCCESS) return false;
  for (int i = 0; i < most_iterations; ++i) {
    if (gsl_multiroot_fdfsolver_iterate(solver.get()) != GSL_SUCCESS) return false;
    if (gsl_multiroot_test_residual(solver->f, balanced) != GSL_SUCCESS) continue;
    place(problem, solver->x);
    for (int joint = 0; joint < chain.joints(); ++joint) {
      JointHistory next;
      force_at(problem.chain, joint, next);
      problem.chain.histories[joint] = std::move(next);
    }
    chain.blocks = problem.chain.blocks;
    chain.gravity = problem.chain.gravity;
    chain.histories = std::move(problem.chain.histories);
    return true;
  }
  return false;
}

// ---- paths --------------------------------------------------------------------------------------------------------

// the abutments moved in, no weight: every joint closes alike
Chain closed(const JointedBeam& beam, double closure) {
  Chain chain{beam, closure, {}, 0, {}};
  chain.blocks.resize(beam.blocks + 2);
  chain.histories.resize(chain.joints());
  for (int b = 0; b <= beam.blocks + 1; ++b)
    chain.blocks[b].displacement.x = closure * (0.5 - static_cast<double>(b) / chain.joints());
  if (!settle(chain, Control::gravity, 0)) throw std::domain_error("jointed beam: no equilibrium without weight");
  return chain;
}

double now(const Chain& chain, Control control) {
  return control == Control::gravity ? chain.gravity : deflection_of(chain);
}

// in equal steps, halved if need be, each from the last one's position extrapolated; false: lost along the path
bool go_to(Chain& chain, Control control, double target, double most) {
  const double from = now(chain, control);
  const int steps = std::max(1, static_cast<int>(std::ceil((target - from) / most - 1e-9)));
  const double whole = (target - from) / steps, least = std::ldexp(whole, -most_halvings);
  double step = whole;
  while (target - now(chain, control) > 1e-12 * std::abs(target)) {
    const double at = now(chain, control), next = at + step > target - 1e-9 * whole ? target : at + step;
    if (settle(chain, control, next)) {
      step = std::min(whole, 2 * step);
    } else if ((step *= 0.5) < least) {
      return false;
    }
  }
  return true;
}

BeamState describe(const Chain& chain) {
  BeamState s;
  s.gravity = chain.gravity;
  s.deflection = deflection_of(chain);
  s.blocks.assign(chain.blocks.begin() + 1, chain.blocks.end() - 1);
  for (int joint = 0; joint < chain.joints(); ++joint) {
    // evaluated again from its own history, a joint gives the same force: its slip is complete
    JointHistory unused;
    const JointForce f = force_at(chain, joint, unused);
    const Point from = face_of(chain, joint, 1).middle;
    s.joints.push_back({Point{chain.beam.length * joint, 0} + from + f.point, f.force, f.normal, f.shear,
                        f.normal > 0 ? f.sliding / f.normal : 0, f.open, chain.histories[joint].slip});
  }
  s.thrust = s.joints.front().force.x;
  return s;
}

double thrust_at_one(const JointedBeam& beam, double closure, const BeamSteps& steps) {
  Chain chain = closed(beam, closure);
  if (!go_to(chain, Control::gravity, 1, steps.gravity)) throw std::domain_error("jointed beam: lost below 1 g");
  return describe(chain).thrust;
}

}  // namespace

double abutment_closure(const JointedBeam& beam, const BeamSteps& steps) {
  // without weight every joint has the same stress; weight never reduces the thrust, so closure is at most this
  const double stress = beam.thrust / (beam.height * beam.width);
  double high = 1e-9;
  while (normal_stress(beam.joint.normal, high) < stress)
    high *= 2;
  high *= beam.blocks + 1;
  struct Search {
    const JointedBeam& beam;
    const BeamSteps& steps;
  } search{beam, steps};
  gsl_function function{[](double closure, void* data) {
                          const Search& s = *static_cast<const Search*>(data);
                          return thrust_at_one(s.beam, closure, s.steps) - s.beam.thrust;
                        },
                        &search};
  gsl_set_error_handler_off();
  const std::unique_ptr<gsl_root_fsolver, decltype(&gsl_root_fsolver_free)> solver(
      gsl_root_fsolver_alloc(gsl_root_fsolver_brent), gsl_root_fsolver_free);
  // 0.4 of it gives less than the thrust: the stress grows at least in proportion to the closure, by one law with its
  // fourth power
  if (!solver || gsl_root_fsolver_set(solver.get(), &function, 0.4 * high, high) != GSL_SUCCESS)
    throw std::domain_error("jointed beam: the closure for this thrust is not bracketed");
  constexpr int most = 60;
  for (int i = 0; i < most; ++i) {
    if (gsl_root_fsolver_iterate(solver.get()) != GSL_SUCCESS) throw std::runtime_error("jointed beam: closure");
    if (gsl_root_test_interval(gsl_root_fsolver_x_lower(solver.get()), gsl_root_fsolver_x_upper(solver.get()), 0,
                               1e-9) == GSL_SUCCESS)
      break;
  }
  return gsl_root_fsolver_root(solver.get());
}

std::vector<BeamState> raise_gravity(const JointedBeam& beam, const std::vector<double>& gravities,
                                     std::optional<double> closure, const BeamSteps& steps) {
  Chain chain = closed(beam, closure ? *closure : abutment_closure(beam, steps));
  std::vector<BeamState> path;
  for (const double gravity : gravities) {
    if (!go_to(chain, Control::gravity, gravity, steps.gravity)) break;
    path.push_back(describe(chain));
  }
  return path;
}

std::vector<BeamState> raise_deflection(const JointedBeam& beam, double deflection, const BeamSteps& steps) {
  Chain chain = closed(beam, abutment_closure(beam, steps));
  if (!go_to(chain, Control::gravity, 1, steps.gravity)) throw std::domain_error("jointed beam: lost below 1 g");
  std::vector<BeamState> path{describe(chain)};
  const double from = path.back().deflection;
  const int count = static_cast<int>(std::ceil((deflection - from) / steps.deflection));
  for (int i = 1; i <= count; ++i) {
    if (!go_to(chain, Control::deflection, from + (deflection - from) * i / count, steps.deflection)) break;
    path.push_back(describe(chain));
  }
  return path;
}

BeamLimit limit_of(const std::vector<BeamState>& path) {
  const auto top = std::max_element(path.begin(), path.end(),
                                    [](const BeamState& a, const BeamState& b) { return a.gravity < b.gravity; });
  if (path.size() < 3 || top == path.begin() || top + 1 == path.end())
    throw std::domain_error("jointed beam: the path has no peak inside");
  const BeamState &a = top[-1], &b = top[0], &c = top[1];
  const ParabolaTop peak =
      parabola_top({a.deflection, a.gravity}, {b.deflection, b.gravity}, {c.deflection, c.gravity});
  return {peak.y, b.deflection + peak.aside};
}

}  // namespace voussoir::reference
