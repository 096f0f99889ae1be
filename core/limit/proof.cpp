#include "core/limit/proof.hpp"

#include <limits>

namespace voussoir {
namespace {

constexpr int digits_of_places = 47;  // binary, of the largest coordinate: products of two stay short
constexpr int digits_of_steps = 8;    // of the distance between the factor and its lower bound
constexpr std::array<double, 5> steps_back{1e-6, 1e-5, 1e-4, 1e-3, 1e-2};
constexpr std::array<double, 5> openings{1e-8, 1e-7, 1e-6, 1e-5, 1e-4};  // speeds at a live power of 1
constexpr int most_halves = 40;                                          // of the share of such velocities
constexpr double hardly_moves = 1e-6;                                    // of the fastest body
constexpr double below_unit = 1 - 4 * std::numeric_limits<double>::epsilon();

double as_double(const Dyadic& number) {
  constexpr unsigned digits = 62;
  if (number.sign() == 0) return 0;
  const Integer size = abs(number.integer);
  const unsigned length = msb(size), shift = length > digits ? length - digits : 0;
  const double value = std::ldexp(static_cast<double>(static_cast<std::int64_t>(size >> shift)),
                                  number.exponent + static_cast<int>(shift));
  return number.sign() < 0 ? -value : value;
}

double next_above(double number) {
  return std::nextafter(number, std::numeric_limits<double>::infinity());
}

template <int Dim>
CornerAssembly<Dim> on_grid(CornerAssembly<Dim> assembly, int& grid) {
  double farthest = std::numeric_limits<double>::min();
  for (const CornerBody<Dim>& body : assembly.bodies)
    farthest = std::max(farthest, body.centroid.cwiseAbs().maxCoeff());
  for (const CornerFace<Dim>& face : assembly.faces)
    for (const Vector<Dim>& corner : face.corners)
      farthest = std::max(farthest, corner.cwiseAbs().maxCoeff());
  grid = std::ilogb(farthest) + 1 - digits_of_places;
  const auto round_place = [&](Vector<Dim>& place) {
    for (double& number : place)
      number = std::ldexp(std::round(std::ldexp(number, -grid)), grid);
  };
  for (CornerBody<Dim>& body : assembly.bodies)
    round_place(body.centroid);
  for (CornerFace<Dim>& face : assembly.faces)
    for (Vector<Dim>& corner : face.corners)
      round_place(corner);
  return assembly;
}

// the squared size of a vector across another one, times the latter's square
template <int Dim>
Dyadic across(const Numbers<Dyadic, Dim>& vector, const Numbers<Dyadic, Dim>& normal, const Dyadic& along) {
  return product(vector, vector) * product(normal, normal) - along * along;
}

template <int Dim>
class Prover {
 public:
  Prover(const CornerAssembly<Dim>& assembly, const Loads<Dim>& dead, const Loads<Dim>& live) {
    proof_.assembly = on_grid(assembly, grid_);
    proof_.dead = dead;
    proof_.live = live;
    for (const CornerFace<Dim>& face : assembly.faces)
      proof_.tangents.push_back(std::tan(face.friction));
  }

  LimitProof<Dim> prove(const LoadFactor<Dim>& found) {
    const CornerProgram<Dim> program = corner_program(proof_.assembly, proof_.dead, proof_.live);
    live_ratio_ = program.live.cwiseAbs().maxCoeff();
    prove_lower(found, program.right_side.isZero(0));
    proof_.cohesion.clear();
    for (const CornerFace<Dim>& face : proof_.assembly.faces)
      proof_.cohesion.push_back(cohesion_at_corners(face));
    prove_upper(found);
    return std::move(proof_);
  }

 private:
  using Velocities = std::vector<BodyVelocity<Dim>>;

  // ---- forces ------------------------------------------------------------------------------------------------------

  void prove_lower(const LoadFactor<Dim>& found, bool no_dead_load) {
    if (no_dead_load && found.factor == 0) return carry_nothing();
    for (const double step : steps_back) {
      const double back = step * std::max(std::abs(found.factor), 1 / live_ratio_);
      const int unit = std::ilogb(back) - digits_of_steps;
      if (carry(std::ldexp(std::floor(std::ldexp(found.factor - back, -unit)), unit))) return;
    }
    proof_.no_lower =
        "forces that balance the loads exactly leave their cones: joints without slack, as those without friction, or "
        "blocks of very different size";
  }

  void carry_nothing() {
    proof_.lower = 0;
    for (const CornerFace<Dim>& face : proof_.assembly.faces)
      proof_.forces.at_corners.emplace_back(face.corners.size());
  }

  // no costs: the forces end near the analytic centre of all that balance, away from their cones' surfaces
  bool carry(double factor) {
    Loads<Dim> loads = proof_.dead;
    for (std::size_t b = 0; b < loads.size(); ++b) {
      loads[b].force += factor * proof_.live[b].force;
      loads[b].moment += factor * proof_.live[b].moment;
    }
    const ConeProgramAnswer answer = solve(corner_program(proof_.assembly, loads));
    ++proof_.programs;
    if (answer.status != ConeStatus::optimal) return false;
    std::optional<BalancedForces<Dim>> forces = balance_exactly(proof_.assembly, grid_, proof_.dead, proof_.live,
                                                                factor, corner_forces(proof_.assembly, answer.x));
    if (!forces || !within_cones(*forces) || !balances(*forces, factor)) return false;
    proof_.forces = std::move(*forces);
    proof_.lower = factor;
    return true;
  }

  Numbers<Dyadic, Dim> force_at(const BalancedForces<Dim>& forces, std::size_t f, std::size_t k) const {
    Numbers<Dyadic, Dim> force;
    for (int i = 0; i < Dim; ++i)
      force[i] = {forces.at_corners[f][k][i], forces.unit};
    return force;
  }

  bool within_cones(const BalancedForces<Dim>& forces) const {
    for (std::size_t f = 0; f < proof_.assembly.faces.size(); ++f) {
      const CornerFace<Dim>& face = proof_.assembly.faces[f];
      const auto normal = exact_of<Dim>(face.normal);
      const std::vector<double> cohesion = cohesion_at_corners(face);
      const Dyadic tangent(proof_.tangents[f]);
      for (std::size_t k = 0; k < face.corners.size(); ++k) {
        const auto force = force_at(forces, f, k);
        const Dyadic along = product(force, normal),
                     most = tangent * along + Dyadic(below_unit * face.normal.norm()) * Dyadic(cohesion[k]);
        if (along.sign() < 0 || !(across<Dim>(force, normal, along) <= most * most)) return false;
      }
    }
    return true;
  }

  bool balances(const BalancedForces<Dim>& forces, double factor) const {
    const CornerAssembly<Dim>& assembly = proof_.assembly;
    constexpr int spins = spin_freedoms<Dim>;
    std::vector<Numbers<Dyadic, Dim>> sums;
    std::vector<Numbers<Dyadic, spins>> moments;
    const Dyadic of_live(factor);
    for (std::size_t b = 0; b < assembly.bodies.size(); ++b) {
      sums.push_back(exact_of<Dim>(proof_.dead[b].force) + of_live * exact_of<Dim>(proof_.live[b].force));
      moments.push_back(exact_of<spins>(proof_.dead[b].moment) + of_live * exact_of<spins>(proof_.live[b].moment));
    }
    const auto add = [&](int b, const Vector<Dim>& place, const Numbers<Dyadic, Dim>& force) {
      const auto arm = exact_of<Dim>(place) - exact_of<Dim>(assembly.bodies[b].centroid);
      sums[b] = sums[b] + force;
      moments[b] = moments[b] + moment(arm, force);
    };
    for (std::size_t f = 0; f < assembly.faces.size(); ++f)
      for (std::size_t k = 0; k < assembly.faces[f].corners.size(); ++k) {
        const CornerFace<Dim>& face = assembly.faces[f];
        const auto force = force_at(forces, f, k);
        add(face.body_b, face.corners[k], force);
        add(face.body_a, face.corners[k], Numbers<Dyadic, Dim>{} - force);
      }
    for (std::size_t b = 0; b < sums.size(); ++b)
      for (int k = 0; k < freedoms<Dim>; ++k)
        if (assembly.bodies[b].free[k] && (k < Dim ? sums[b][k] : moments[b][k - Dim]).sign() != 0) return false;
    return true;
  }

  // ---- velocities --------------------------------------------------------------------------------------------------

  void prove_upper(const LoadFactor<Dim>& found) {
    proof_.no_upper = "no velocities open every joint that moves, as blocks can be held by self-stress";
    std::optional<Velocities> open = opening_velocities(proof_.assembly);
    if (!open) {
      CornerAssembly<Dim> held = proof_.assembly;
      for (std::size_t b = 0; b < held.bodies.size(); ++b) {
        const BodyVelocity<Dim>& of = found.state.velocities[b];
        if (of.velocity.norm() + held.bodies[b].radius * of.spin.norm() < hardly_moves) held.bodies[b].free = {};
      }
      std::erase_if(held.faces, [&](const CornerFace<Dim>& face) {
        return !held.bodies[face.body_a].moves() && !held.bodies[face.body_b].moves();
      });
      open = opening_velocities(held);
      proof_.still_held = open.has_value();
    }
    if (!open) return;
    proof_.no_upper.clear();
    // The mechanism itself closes joints by its rounding: the smallest share of the others that opens all of them.
    Velocities nearest = found.state.velocities;
    for (std::size_t b = 0; b < nearest.size(); ++b)
      if (proof_.still_held && open->at(b).velocity.isZero(0) && open->at(b).spin.isZero(0)) nearest[b] = {};
    const double power = live_power(nearest), other_power = live_power(*open);
    int most = 0, none = most_halves;
    while (power > 0 && none - most > 1) {
      const int halves = (most + none) / 2;
      const double share = std::ldexp(1.0, -halves);
      Velocities both = *open;
      for (std::size_t b = 0; b < both.size(); ++b) {
        both[b].velocity = (1 - share) / power * nearest[b].velocity + share / other_power * both[b].velocity;
        both[b].spin = (1 - share) / power * nearest[b].spin + share / other_power * both[b].spin;
      }
      (keep_bound(std::move(both), share) ? most : none) = halves;
    }
  }

  double live_power(const Velocities& velocities) const {
    double sum = 0;
    for (std::size_t b = 0; b < velocities.size(); ++b)
      sum += proof_.live[b].force.dot(velocities[b].velocity) + proof_.live[b].moment.dot(velocities[b].spin);
    return sum;
  }

  // if the velocities are admissible, and prove a lower bound than those before
  bool keep_bound(Velocities velocities, double share) {
    const std::optional<double> bound = bound_of(velocities);
    if (!bound) return false;
    if (proof_.upper && *proof_.upper <= *bound) return true;
    proof_.upper = bound;
    proof_.velocities = std::move(velocities);
    proof_.share = share;
    return true;
  }

  // which open every joint of an assembly by more than their errors
  std::optional<Velocities> opening_velocities(const CornerAssembly<Dim>& assembly) {
    CornerProgram<Dim> program = corner_program(assembly, proof_.dead, proof_.live);
    const double largest = program.live.size() > 0 ? program.live.cwiseAbs().maxCoeff() : 0;
    if (largest == 0) return std::nullopt;
    program.live /= largest;
    const std::vector<double> sines = sines_of_cones(assembly);
    for (const double opening : openings) {
      for (std::size_t i = 0; i < sines.size(); ++i)
        if (!(program.cones[i].head > 0)) program.cones[i].cost = -opening * std::sqrt(1 - sines[i] * sines[i]);
      const ConeProgramAnswer answer = solve(program);
      ++proof_.programs;
      if (answer.status != ConeStatus::optimal) return std::nullopt;
      Velocities velocities = mechanism_of(assembly, answer.y);
      if (keep_bound(velocities, 1)) return velocities;
    }
    return std::nullopt;
  }

  // [-D·v + Σ c |slip|]/L·v, rounded upwards; none if a joint closes
  std::optional<double> bound_of(const Velocities& velocities) const {
    const CornerAssembly<Dim>& assembly = proof_.assembly;
    const auto power = [&](const Loads<Dim>& loads) {
      Dyadic sum;
      for (std::size_t b = 0; b < loads.size(); ++b)
        sum = sum + product(exact_of<Dim>(loads[b].force), exact_of<Dim>(velocities[b].velocity)) +
              product(exact_of<spin_freedoms<Dim>>(loads[b].moment), exact_of<spin_freedoms<Dim>>(velocities[b].spin));
      return sum;
    };
    const Dyadic driving = power(proof_.live);
    if (driving.sign() <= 0) return std::nullopt;
    Dyadic resisted = Dyadic() - power(proof_.dead);
    const auto velocity_at = [&](int b, const Vector<Dim>& place) {
      return exact_of<Dim>(velocities[b].velocity) +
             turning(exact_of<spin_freedoms<Dim>>(velocities[b].spin),
                     exact_of<Dim>(place) - exact_of<Dim>(assembly.bodies[b].centroid));
    };
    for (std::size_t f = 0; f < assembly.faces.size(); ++f) {
      const CornerFace<Dim>& face = assembly.faces[f];
      const auto normal = exact_of<Dim>(face.normal);
      const Dyadic tangent(proof_.tangents[f]);
      for (std::size_t k = 0; k < face.corners.size(); ++k) {
        const auto opening = velocity_at(face.body_b, face.corners[k]) - velocity_at(face.body_a, face.corners[k]);
        const Dyadic along = product(opening, normal), slip = across<Dim>(opening, normal, along);
        if (along.sign() < 0 || !(tangent * tangent * slip <= along * along)) return std::nullopt;
        if (proof_.cohesion[f][k] > 0)
          resisted = resisted + Dyadic(proof_.cohesion[f][k]) * Dyadic(root_above(slip, product(normal, normal)));
      }
    }
    double bound = as_double(resisted) / as_double(driving);
    while (!(resisted <= Dyadic(bound) * driving))
      bound = next_above(bound);
    return bound;
  }

  // √(a/b), rounded upwards
  static double root_above(const Dyadic& a, const Dyadic& b) {
    if (a.sign() == 0) return 0;
    double root = std::sqrt(as_double(a) / as_double(b));
    while (!(a <= Dyadic(root) * Dyadic(root) * b))
      root = next_above(root);
    return next_above(root);
  }

  LimitProof<Dim> proof_;
  int grid_ = 0;
  double live_ratio_ = 0;  // the largest live load over its body's weight
};

const char* refusal(LimitStatus status) {
  switch (status) {
    case LimitStatus::found:
      return nullptr;
    case LimitStatus::carries_any:
      return "every factor is supported";
    case LimitStatus::carries_nothing:
      return "the dead loads alone are not supported";
    default:
      return "no factor was found";
  }
}

}  // namespace

template <int Dim>
LimitProof<Dim> prove_load_factor(const CornerAssembly<Dim>& assembly, const Loads<Dim>& dead, const Loads<Dim>& live,
                                  const LoadFactor<Dim>& found) {
  const char* reason = refusal(found.status);
  for (const CornerFace<Dim>& face : assembly.faces)
    if (!reason && assembly.properties.size() && assembly.properties[face.properties].follows_barton_bandis())
      reason = "the cones of joints after Barton and Bandis change with the forces";
  if (!reason) return Prover<Dim>(assembly, dead, live).prove(found);
  LimitProof<Dim> none;
  none.no_lower = none.no_upper = reason;
  return none;
}

template LimitProof<2> prove_load_factor(const CornerAssembly<2>&, const Loads<2>&, const Loads<2>&,
                                         const LoadFactor<2>&);
template LimitProof<3> prove_load_factor(const CornerAssembly<3>&, const Loads<3>&, const Loads<3>&,
                                         const LoadFactor<3>&);

}  // namespace voussoir
