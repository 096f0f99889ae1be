#include "core/limit/bolt_ties.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "core/base/bad_input.hpp"
#include "core/stage/install_bolts.hpp"

namespace voussoir {
namespace {

// of a bolt's force at a joint that it crosses, N; tension is positive
struct Bounds {
  double least, most;
};

// A grouted bar: no more than it carries itself, nor than the bond holds on either side of the joint; a plate holds the
// side of the collar against tension, one tied to the rock against both.
template <int Dim>
Bounds bounds_of(const BoltProperties& p, const GroutedBolt<Dim>& bar) {
  std::array<double, 2> bonded{};  // m, before the joint and behind it
  for (std::size_t i = 0; i < bar.stretch.size(); ++i)
    bonded[bar.stretch[i]] += bar.bar.bond_length[i];
  const auto held = [&](int side) { return bonded[side] > 0 ? bonded[side] * bar.bar.bond_strength : 0; };
  constexpr double infinity = std::numeric_limits<double>::infinity();
  const double toe = std::min(bar.bar.yield_force, held(1));
  return {-std::min(toe, p.plate == Plate::tied ? infinity : held(0)),
          std::min(toe, p.plate == Plate::none ? held(0) : infinity)};
}

template <int Dim>
Bounds bounds_of(const Model<Dim>& model, const State<Dim>& state, int bolt,
                 const std::vector<BoltSpring<Dim>>& springs) {
  const BoltProperties& p = model.bolt_properties[model.bolts[bolt].properties];
  if (p.kind != BoltKind::grouted) {
    const double yield = p.yield.value_or(std::numeric_limits<double>::infinity());
    return {p.tension_only ? 0 : -yield, yield};
  }
  if (springs.size() > 1)
    throw BadInput(
        fmt::format("bolts '{}' are grouted, and one crosses {} joints: its forces there depend on each other by the "
                    "bond between them, which limit analysis leaves out; state kind = \"springs\" with a yield, or use "
                    "'voussoir run' with a stage of kind = \"reduce\"",
                    p.name, springs.size()));
  const std::optional<GroutedBolt<Dim>> bar = bar_of(model, state, bolt, springs);
  return bar ? bounds_of(p, *bar) : Bounds{0, 0};
}

}  // namespace

template <int Dim>
std::vector<CornerTie<Dim>> ties_of(const Model<Dim>& model) {
  std::vector<CornerTie<Dim>> ties;
  if (model.bolts.empty()) return ties;
  const State<Dim> state = initial_state(model);
  const auto held = [&](int body) { return model.bodies[body].fixed; };
  for (std::size_t b = 0; b < model.bolts.size(); ++b) {
    const BoltProperties& p = model.bolt_properties[model.bolts[b].properties];
    const std::vector<BoltSpring<Dim>> springs = springs_of(model, state, static_cast<int>(b));
    const Bounds bounds = bounds_of(model, state, static_cast<int>(b), springs);
    if (std::isinf(bounds.most))
      throw BadInput(
          fmt::format("bolts '{}' state no yield: their force has no bound in limit analysis; state yield (N){}",
                      p.name, p.kind == BoltKind::grouted ? ", or bond_strength (N/m)" : ""));
    for (const BoltSpring<Dim>& spring : springs) {
      if (held(spring.body_a) && held(spring.body_b)) continue;
      ties.push_back({spring.body_a, spring.body_b, Vector<Dim>(model.bodies[spring.body_a].reference + spring.place_a),
                      spring.axis, bounds.least, bounds.most, p.dowel_strength.value_or(0), static_cast<int>(b)});
    }
  }
  return ties;
}

template std::vector<CornerTie<2>> ties_of(const Model<2>&);
template std::vector<CornerTie<3>> ties_of(const Model<3>&);

}  // namespace voussoir
