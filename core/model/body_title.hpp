// What a body is called in messages: by the names that the scene has, its number beside them.
#pragma once

#include <string>

#include "core/model/model.hpp"

namespace voussoir {

// its name; "node 2 of lining 'shell'"; "of joints bed, cross-3", whose faces bound it; or its place, "at (0, 1.5) m"
template <int Dim>
std::string title_of(const Model<Dim>& model, int body);

}  // namespace voussoir
