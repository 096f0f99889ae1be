#include "core/limit/bolt_ties.hpp"

#include <fmt/format.h>

#include "core/base/bad_input.hpp"
#include "core/stage/install_bolts.hpp"

namespace voussoir {

template <int Dim>
std::vector<CornerTie<Dim>> ties_of(const Model<Dim>& model) {
  std::vector<CornerTie<Dim>> ties;
  if (model.bolts.empty()) return ties;
  const State<Dim> state = initial_state(model);
  const auto held = [&](int body) { return model.bodies[body].fixed; };
  for (std::size_t b = 0; b < model.bolts.size(); ++b) {
    const BoltProperties& p = model.bolt_properties[model.bolts[b].properties];
    if (p.kind == BoltKind::grouted)
      throw BadInput(
          fmt::format("bolts '{}' are grouted: limit analysis bounds a bolt's force at each joint, and grout also has "
                      "a bond; state "
                      "kind = \"springs\" with a yield, or use 'voussoir run' with a stage of kind = \"reduce\"",
                      p.name));
    if (!p.yield)
      throw BadInput(fmt::format(
          "bolts '{}' state no yield: their force has no bound in limit analysis; state yield (N)", p.name));
    for (const BoltSpring<Dim>& spring : springs_of(model, state, static_cast<int>(b))) {
      if (held(spring.body_a) && held(spring.body_b)) continue;
      ties.push_back({spring.body_a, spring.body_b, Vector<Dim>(model.bodies[spring.body_a].reference + spring.place_a),
                      spring.axis, p.tension_only ? 0 : -*p.yield, *p.yield, p.dowel_strength.value_or(0),
                      static_cast<int>(b)});
    }
  }
  return ties;
}

template std::vector<CornerTie<2>> ties_of(const Model<2>&);
template std::vector<CornerTie<3>> ties_of(const Model<3>&);

}  // namespace voussoir
