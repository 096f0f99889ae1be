// The words of a verdict, as `voussoir blocks` prints and shows them.
#pragma once

#include <string>

#include "core/key_blocks/block_survey.hpp"

namespace voussoir {

// "slides on two faces", "tapered"
template <int Dim>
std::string kind_label(const SurveyRow<Dim>& row);

// names of the joints of its loaded faces
template <int Dim>
std::string joints_shown(const Survey<Dim>& survey, const SurveyRow<Dim>& row);

// plunge/trend, deg; in the plane plunge and side
template <int Dim>
std::string direction_shown(const Vector<Dim>& v);

// the force for the required factor, in kN, and its direction
template <int Dim>
std::string force_shown(const SurveyRow<Dim>& row, const char* unit);

// whether it turns, is a cluster, has bolts, or differs from limit equilibrium
template <int Dim>
std::string verdict_remarks(const Survey<Dim>& survey, const SurveyRow<Dim>& row);

}  // namespace voussoir
