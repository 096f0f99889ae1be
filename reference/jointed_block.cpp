#include "reference/jointed_block.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace voussoir::reference {
namespace {

// Out-of-balance force over weight at which a step has converged: the angle's error is of the same order, far below the
// step error, and rounding leaves 1e-15.
constexpr double balance_tolerance = 1e-12;
// Newton needs 2-6 iterations if an equilibrium exists; the rest is room for kinks between stick and slip.
constexpr int most_rounds = 60;
constexpr int most_halvings = 20;
// A step may not move the block further than this many times its settlement: such a solution is sliding, not
// equilibrium.
constexpr double largest_move = 1e3;

// Plain arrays rather than Eigen: 3 x 3 work in a loop of a million, which must also run unoptimised with sanitizers.
double dot(const Vector3& a, const Vector3& b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}
double length(const Vector3& a) {
  return std::sqrt(dot(a, a));
}

struct Balance {
  BlockState state;
  Vector3 residual{};
  double tangent[3][3] = {};  // of the residual by the displacement
};

// Return mapping on the joints from the last equilibrium `old` to a trial displacement.
Balance evaluate(const std::vector<BlockJoint>& joints, const std::array<double, most_block_joints>& tan_friction,
                 const BlockState& old, const Vector3& displacement, const Vector3& load) {
  Balance balance;
  balance.residual = load;
  balance.state.displacement = displacement;
  for (std::size_t i = 0; i < joints.size(); ++i) {
    const auto& [n, kn, ks, initial] = joints[i];
    const double pressed = initial - kn * dot(n, displacement), normal = std::max(0.0, pressed);
    const double kn_now = pressed > 0 ? kn : 0;

    // trial shear: the old one and the elastic slip, both in the plane
    Vector3 move{}, shear{};
    for (int k = 0; k < 3; ++k)
      move[k] = old.shear[i][k] - ks * (displacement[k] - old.displacement[k]);
    const double across = dot(move, n);
    for (int k = 0; k < 3; ++k)
      shear[k] = move[k] - across * n[k];
    const double size = length(shear), limit = normal * tan_friction[i];
    const bool slips = size > limit;
    const double part = slips ? limit / size : 1;
    Vector3 t{};
    if (slips)
      for (int k = 0; k < 3; ++k)
        t[k] = shear[k] / size;

    // Tangent: -kn n n, then -ks times the part of the plane that still sticks, then the change of the strength with N.
    for (int k = 0; k < 3; ++k) {
      for (int l = 0; l < 3; ++l)
        balance.tangent[k][l] += -kn_now * n[k] * n[l] - ks * part * ((k == l) - n[k] * n[l] - t[k] * t[l]) -
                                 tan_friction[i] * kn_now * t[k] * n[l];
      balance.state.shear[i][k] = part * shear[k];
      balance.residual[k] += normal * n[k] + part * shear[k];
    }
    balance.state.normal[i] = normal;
  }
  return balance;
}

// -tangent^-1 residual by Cramer's rule; not finite at a limit point, which the caller takes as no equilibrium.
Vector3 newton_step(const Balance& balance) {
  const auto& m = balance.tangent;
  Vector3 step{}, cofactor[3] = {};
  for (int k = 0; k < 3; ++k)
    for (int l = 0; l < 3; ++l) {
      const int k1 = (k + 1) % 3, k2 = (k + 2) % 3, l1 = (l + 1) % 3, l2 = (l + 2) % 3;
      cofactor[k][l] = m[k1][l1] * m[k2][l2] - m[k1][l2] * m[k2][l1];
    }
  const double determinant = m[0][0] * cofactor[0][0] + m[0][1] * cofactor[0][1] + m[0][2] * cofactor[0][2];
  for (int l = 0; l < 3; ++l) {
    double sum = 0;
    for (int k = 0; k < 3; ++k)
      sum += cofactor[k][l] * balance.residual[k];
    step[l] = determinant != 0 ? -sum / determinant : std::numeric_limits<double>::infinity();
  }
  return step;
}

}  // namespace

bool equilibrate(const std::vector<BlockJoint>& joints, const std::array<double, most_block_joints>& tan_friction,
                 const Vector3& load, double size, double settlement, BlockState& state) {
  const BlockState old = state;
  Balance now = evaluate(joints, tan_friction, old, old.displacement, load);
  for (int round = 0; round < most_rounds; ++round) {
    if (length(now.residual) <= balance_tolerance * size) {
      state = now.state;
      return true;
    }
    const Vector3 step = newton_step(now);
    if (!(length(step) <= largest_move * settlement)) return false;
    // Halve the step until the out-of-balance force falls.
    double part = 1;
    bool better = false;
    for (int halving = 0; halving < most_halvings && !better; ++halving, part /= 2) {
      Vector3 trial = now.state.displacement;
      for (int k = 0; k < 3; ++k)
        trial[k] += part * step[k];
      const Balance next = evaluate(joints, tan_friction, old, trial, load);
      better = length(next.residual) < length(now.residual);
      if (better) now = next;
    }
    if (!better) return false;
  }
  return false;
}

}  // namespace voussoir::reference
