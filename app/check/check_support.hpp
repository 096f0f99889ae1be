// What `voussoir check` tells of bolts and linings, and of potential particles.
#pragma once

#include <string>

#include "core/model/prepared.hpp"

namespace voussoir {

// one labelled line; the label only where the block of lines begins
void print_line(const char* label, const std::string& text);

template <int Dim>
void print_particles(const Model<Dim>& model);

template <int Dim>
void print_support(const Prepared<Dim>& prepared);

}  // namespace voussoir
