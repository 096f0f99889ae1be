// lining.csv: what the nodes of all linings carried at the end of each stage, a row for each, per metre of tunnel.
// Columns:
//   stage                            from 1
//   lining, node                     its name, and the node, counter-clockwise from the first; from 1
//   x_m, y_m, ux_m, uy_m             where the node is, world coordinates, and how far it has moved since it was
//   installed thrust_N, shear_N, moment_Nm     compression positive; sagging positive: tension on the side of the
//   opening smoothed_moment_Nm               without the ripple of straight sides (core/support/lining.hpp); empty
//   where the outline
//                                    has too few sides, or too few nodes on one; it leaves out what shear along the
//                                    rock carries, so under uneven pressure it may exceed the moment
//   pressure_Pa, shear_stress_Pa     of the rock on the lining, towards the opening, and along it counter-clockwise
//   body                             the block opposite; empty where there is none
//   use                              of its strength; empty where none is stated
#pragma once

#include <filesystem>
#include <vector>

#include "core/output/results.hpp"

namespace voussoir {

std::string lining_csv(const std::vector<LiningRow>& rows);

// throws OutputError
void write_lining_csv(const std::filesystem::path& path, const std::vector<LiningRow>& rows);

}  // namespace voussoir
