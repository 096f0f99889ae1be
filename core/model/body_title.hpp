// The title of a body in messages, made of names in the scene; its number is printed beside it.
#pragma once

#include <string>

#include "core/model/model.hpp"

namespace voussoir {

// its name; "node 2 of lining 'shell'"; "of joints bed, cross-3", whose faces bound it; or its place, "at (0, 1.5) m"
template <int Dim>
std::string title_of(const Model<Dim>& model, int body);

}  // namespace voussoir
