// The proof of a load factor as a file, so that others can check it with a few lines of their own
// (app/testing/check_limit_proof.py).
//
// JSON. A number is a double, exactly; forces at corners are hexadecimal integers as text, in units of
// 2^force_exponent N.
//
//   dimension, gravity_m_s2, lower, upper    bounds; null if there is none
//   loads                                    dead and live: acceleration_m_s2, and others: of a body, either force_N at
//                                            point_m or force_N and moment_Nm about its centroid
//   properties                               name, friction_rad, cohesion_Pa as stated
//   bodies                                   name, mass_kg, density_kg_m3, centroid_m, free (translations, rotations),
//                                            dead and live (force_N, moment_Nm), velocity and spin_1_m,
//                                            parts (vertices_m, and faces as places in that list)
//   faces                                    on which bodies a and b touch: normal from a to b, corners_m, properties,
//                                            friction_rad, tangent, cohesion_Pa, cohesion_N of each corner, forces on b
//
// The statement: forces f of `lower` balance dead + lower · live exactly, f·n >= 0 and |T| <= tangent f·n + cohesion;
// the velocities of `upper` open every joint by tangent times its slip, and their power against dead + upper · live is
// not positive. Lengths are relative to `origin_m`. Edges and corners that touch carry nothing.
#pragma once

#include <string>

#include "app/limit/limit_answer.hpp"

namespace voussoir {

// What a load consists of, from which it can be found again.
template <int Dim>
struct LoadParts {
  Vector<Dim> acceleration = Vector<Dim>::Zero();  // m/s²
  std::vector<AppliedForce<Dim>> forces;           // at a factor of 1
  Loads<Dim> waters;                               // by body; may be empty
};

template <int Dim>
Loads<Dim> loads_of(const Model<Dim>& model, const LoadParts<Dim>& parts);

// Proves the bounds of a found factor of the live load, and writes the proof as text.
template <int Dim>
ProvedBounds prove_bounds(const Model<Dim>& model, const CornerAssembly<Dim>& assembly, const LoadParts<Dim>& dead,
                          const LoadParts<Dim>& live, const LoadFactor<Dim>& found);

}  // namespace voussoir
