// Blocks as the forecast and the warnings name and choose them.
#pragma once

#include <fmt/format.h>

#include <string>

#include "core/model/body_title.hpp"

namespace voussoir {

// its name, or its number with a title
template <int Dim>
std::string name_of(const Model<Dim>& model, int body) {
  const std::string title = title_of(model, body);
  return model.bodies[body].name.empty() ? fmt::format("{} ({})", body, title) : title;
}

// by itself, or as a stage prescribes
template <int Dim>
bool moves(const Body<Dim>& body) {
  return body.present && !body.fixed && !body.parts.empty();
}

// by itself
template <int Dim>
bool is_free(const Body<Dim>& body) {
  return moves(body) && !body.prescribed;
}

}  // namespace voussoir
