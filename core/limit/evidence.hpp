// How an answer of limit analysis ended, and its proof.
#pragma once

namespace voussoir {

enum class LimitStatus {
  found,
  nothing_free,     // no body can move
  no_load,          // the load has no component along any degree of freedom, or gravity is zero
  carries_any,      // stable at every factor up to 1e6 times the blocks' weight; or without any friction
  carries_nothing,  // the dead load only is not supported; or no friction up to 89 degrees is enough
  not_attained,     // supported at any strength above zero by unbounded normal forces, but not at zero
  solver_failed     // the solver of the programs gave up
};

// Proof of the result, from independent sums over the program's numbers; the solver's status is not needed.
struct Evidence {
  double gap = 0;  // difference of the bounds from both sides
  double out_of_balance =
      0;                    // largest unbalanced force on a body, over its weight (a moment: of that times its radius)
  double inadmissible = 0;  // largest velocity that closes a joint or works against its cone, of the fastest body's
  int programs = 0;         // solved
  // of joints after Barton and Bandis (follow_envelope.hpp)
  int rounds_of_tangents = 0;  // 0: there are none
  bool tangents_agree = true;  // a factor's bounds, or the answers of the last two rounds
};

}  // namespace voussoir
