// The bodies that a step of the implicit static solver moves: all free ones, or the few in which nearly all of the
// residual is while the others stand still. Contacts that open and close in turn between a few loose blocks would
// otherwise cost the whole model a step each (nonlinear elimination: Lanzkron, Rose and Wilkes 1996).
#pragma once

#include <vector>

#include "core/step/static_solver_base.hpp"

namespace voussoir {

template <int Dim>
struct BodiesOfStep {
  std::vector<int> list;        // indices among the unknowns' bodies
  std::vector<int> place;       // by body of the model: index in `list`, or -1
  std::vector<int> upwards;     // indices in `list`, the lowest first
  Eigen::VectorXd scale, free;  // as Unknowns

  // `few`: ascending; none: all free bodies move
  BodiesOfStep(const Unknowns<Dim>& unknowns, const std::vector<int>& few);

  // of numbers by degree of freedom of all free bodies those of the moving ones; and back, zero for the others
  Eigen::VectorXd of(const Eigen::VectorXd& all) const;
  Eigen::VectorXd among_all(const Eigen::VectorXd& moving, std::size_t count) const;
};

// The few bodies that make up at least half of the square of a residual, with those beside them that are far above the
// mean of the rest; none if they are not few.
template <int Dim>
std::vector<int> few_of_residual(const Unknowns<Dim>& unknowns, const Eigen::VectorXd& residual);

// Contacts of which none of these bodies has a part stay as they are in the next step; those of joints that remember
// their place are found with all others.
template <int Dim>
void keep_others(const Model<Dim>& model, const BodiesOfStep<Dim>& moving, ContactsState<Dim>& contacts);

}  // namespace voussoir
