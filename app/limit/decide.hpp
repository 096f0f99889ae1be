// Between the ends of a factor without dilation normal forces decide that the loads do not ask for: those that the
// blocks come to have on elastic joints, found by runs.
#pragma once

#include <string>

#include "app/limit/limit_answer.hpp"
#include "core/model/prepared.hpp"

namespace voussoir {

// What runs have found: the blocks come to rest at one level and fall at the other, with the scene's stiffness.
struct Decision {
  std::optional<double> rests, falls;  // factor of the load, friction angle (rad) or factor of safety
  int runs = 0;
  std::string because{};  // why one is missing
};

// Of a load: the blocks settle under gravity, then with a multiple of the forces; a block that moves by a fiftieth of
// its inscribed radius then has fallen (by a tenth if gravity itself is multiplied). Runs begin below `least`; nothing
// carries `most`. With the request's cohesion closed joints are bonded.
template <int Dim>
Decision decide_factor(const Prepared<Dim>& scene, const LimitRequest& request, const std::vector<ForcePlan>& forces,
                       double least, double most);

// Of the strength of joints: a search by bisection as that of a stage of kind reduce, from strong joints to weak ones.
// The ends are angles (rad) or factors.
template <int Dim>
Decision decide_strength(const Prepared<Dim>& scene, const LimitRequest& request, double strong, double weak);

}  // namespace voussoir
