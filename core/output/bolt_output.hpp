// Output of bolts: the entries of their row in support_table.hpp.
#pragma once

#include <string>
#include <vector>

#include "core/model/prepared.hpp"
#include "core/output/add_column.hpp"
#include "core/output/results.hpp"
#include "core/output/view_line.hpp"
#include "core/output/vtp.hpp"

namespace voussoir {

// bolts.csv: the forces of the springs of all bolts at the end of each stage, a row for each, and before those of a
// grouted bolt one for its plate. A grouted bar has its largest force at a joint or at its plate, so that the rows
// contain it. Columns:
//   stage                    from 1
//   bolts, bolt, joint       the name, the number of the bolt, and of the joint along it, from the collar; all from 1;
//                            joint 0 is a plate
//   x_m, y_m, z_m            between the spring's anchors, world coordinates
//   body_a, body_b           its blocks
//   force_N, shear_N         along the bolt, tension positive, and across it; of one bolt, also in the plane
//   extension_m, plastic_m   since installation, and its plastic part; of a grouted bar the opening of the joint along
//   it, and the yield of
// the bar there
//   use                      utilisation: force over yield; empty without yield
//   broken                   1 if broken
//   slip_m                   largest slip of a grouted bar in the two blocks at the joint; empty for others
std::string bolts_csv(const Results& results);

template <int Dim>
void add_bolt_rows(const Model<Dim>& model, const State<Dim>& state, int stage, Results& results);

// of its yield: the largest force of a bolt on a free body; nothing if no such bolt has a yield
template <int Dim>
std::optional<double> largest_bolt_use(const Model<Dim>& model, const State<Dim>& state);

// Bolts of other names may precede those that are installed: the springs are identified by name and number.
template <int Dim>
std::string find_bolts_again(const Model<Dim>& model, int stages, const Results& results, State<Dim>& state);

// The springs of bolts, a line each, between the middles of the bolt's length from joint to joint, from its
// collar to its toe; of grouted bolts the segments between the nodes of their bars, the first and last extended, with
// the joint that they cross or that comes next. Cell data: bolts, bolt, joint, force_N and shear_N (of one bolt,
// tension positive), plastic_m, use (utilisation of yield; 0 without yield), broken. Field data: bolt_names.
template <int Dim>
PolyData bolt_lines(const Model<Dim>& model, const State<Dim>& state, double time);

template <int Dim>
ViewLine bolt_view(const Model<Dim>& model, const PolyData& lines, std::size_t line);

// of all bolts of a name; forces of one bolt, N
void add_bolt_columns(const Monitor& monitor, const AddColumn& add);
template <int Dim>
void add_bolt_values(const Monitor& monitor, const Model<Dim>& model, const State<Dim>& state,
                     std::vector<double>& values);

}  // namespace voussoir
