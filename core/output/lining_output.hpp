// Output of linings: the entries of their row in support_table.hpp.
#pragma once

#include <string>
#include <vector>

#include "core/model/prepared.hpp"
#include "core/output/add_column.hpp"
#include "core/output/results.hpp"
#include "core/output/view_line.hpp"
#include "core/output/vtp.hpp"

namespace voussoir {

// lining.csv: the forces at the nodes of all linings at the end of each stage, a row for each, per metre of tunnel.
// Columns:
//   stage                            from 1
//   lining, node                     its name, and the node, counter-clockwise from the first; from 1
//   x_m, y_m, ux_m, uy_m             position of the node, world coordinates, and its displacement since installation
//   thrust_N, shear_N, moment_Nm     compression positive; sagging positive: tension on the side of the opening
//   smoothed_moment_Nm               without the ripple of straight sides (core/support/lining.hpp); empty if the
//   outline has too few
// sides, or too few nodes on one; it neglects the shear along the rock, so that under uneven pressure it may exceed the
// moment
//   pressure_Pa, shear_stress_Pa     of the rock on the lining, towards the opening, and along it counter-clockwise
//   body                             the block opposite; empty if there is none
//   use                              utilisation of its strength; empty if none is stated
std::string lining_csv(const Results& results);

template <int Dim>
void add_lining_rows(const Model<Dim>& model, const State<Dim>& state, int stage, Results& results);

// by name
template <int Dim>
std::string find_linings_again(const Model<Dim>& model, int stages, const Results& results, State<Dim>& state);

// The beams of linings, a line each. Point data: lining, node, displacement (m, since it was installed), thrust_N
// (compression positive), shear_N, moment_Nm (sagging positive), pressure_Pa of the rock, use (utilisation; 0 if no
// strength is stated). Field data: lining_names.
template <int Dim>
PolyData lining_lines(const Model<Dim>& model, const State<Dim>& state, double time);

template <int Dim>
ViewLine lining_view(const Model<Dim>& model, const PolyData& lines, std::size_t line);

// at a node, or the largest of all nodes and the largest utilisation; nothing before installation
void add_lining_columns(const Monitor& monitor, const AddColumn& add);
template <int Dim>
void add_lining_values(const Monitor& monitor, const Model<Dim>& model, const State<Dim>& state,
                       std::vector<double>& values);

}  // namespace voussoir
