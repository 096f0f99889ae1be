// The contact kernel on one pair.
#pragma once

#include <span>

#include "core/contact/narrow_phase.hpp"

namespace voussoir::contacts {

template <int Dim>
struct Outcome {
  Contact<Dim> contact;
  KernelCounters counters;
};

template <int Dim>
Outcome<Dim> resolve(const Pair<Dim>& pair, const ContactSettings& settings = {}, const Contact<Dim>& before = {},
                     const Solvers<Dim>& solvers = {}) {
  Outcome<Dim> r{before, {}};
  Contact<Dim>* slot = &r.contact;
  narrow_phase<Dim>(std::span(&pair, 1), settings, solvers, std::span(&slot, 1), r.counters);
  return r;
}

template <int Dim>
Outcome<Dim> touch(const Polytope<Dim>& a, const Polytope<Dim>& b, const Matrix<Dim>& turn, const Vector<Dim>& offset,
                   const ContactSettings& settings = {}, const Contact<Dim>& before = {}) {
  return resolve<Dim>({&a, &b, Matrix<Dim>::Identity(), turn, offset}, settings, before);
}

}  // namespace voussoir::contacts
