// Warnings about contacts before a run: blocks inside one another, contact points that resist no moment, overlaps out
// of proportion to stiffness and weight.
#pragma once

#include <string>
#include <vector>

#include "app/check/forecast.hpp"
#include "core/model/prepared.hpp"

namespace voussoir {

// `model` and `state` as the first stage begins, near pairs and contacts found
template <int Dim>
void judge_first_contacts(const ContactSettings& settings, const Model<Dim>& model, const State<Dim>& state,
                          std::vector<std::string>& warnings);

// Weight over stiffness: a wrong unit in density, gravity, stiffness or geometry shows here.
void judge_overlaps(const ContactSettings& contact, const Forecast& forecast, std::vector<std::string>& warnings);

// further settings that contacts by multipliers need for a force with a potential
template <int Dim>
void judge_multipliers(const ContactSettings& contact, const Model<Dim>& model, std::vector<std::string>& warnings);

}  // namespace voussoir
