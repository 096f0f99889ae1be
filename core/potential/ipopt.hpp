// The contact of two potential particles by Ipopt: the external reference for our own solver. Part of the library that
// is built with VOUSSOIR_WITH_IPOPT. One call at a time.
#pragma once

#include "core/potential/contact.hpp"

namespace voussoir {

// Readings of the cone program of Boon (2013), Eq. A.10, in the squared form, whose functions are smooth (the norms
// themselves have no derivative where they vanish). p: a slack above each plane in units of r / sqrt(1 - k), Eq. A.7;
// a·x - (r / sqrt(1 - k)) p <= d, p >= 0; Q = Σ p² + k |x - c|² / R².
enum class ConeReading {
  linked,           // minimise t, Q_A <= t, Q_B <= t: with s_A = s_B, which the text after A.10 has
  unlinked,         // minimise s_A + s_B, Q_A <= s_A², Q_B <= s_B²: A.10 as it is printed
  unlinked_squares  // minimise t_A + t_B, Q_A <= t_A, Q_B <= t_B: f_A + f_B, A.3 without f_A = f_B
};

template <int Dim>
struct ConeAnswer {
  bool solved = false;
  Vector<Dim> point = Vector<Dim>::Zero();  // frame of the first body, m
  double value_a = 0, value_b = 0;          // f_A and f_B at the point
  double error = 0;                         // of the optimality conditions, as Ipopt reports it
  int iterations = 0;
};

// without a start, like resolve
template <int Dim>
ConeAnswer<Dim> solve_cone_program(const PotentialPair<Dim>& pair, ConeReading reading);

}  // namespace voussoir
