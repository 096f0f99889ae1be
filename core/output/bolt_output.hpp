// What is told of bolts: the entries of their row in support_table.hpp.
#pragma once

#include <string>
#include <vector>

#include "core/model/prepared.hpp"
#include "core/output/add_column.hpp"
#include "core/output/results.hpp"
#include "core/output/vtp.hpp"

namespace voussoir {

// bolts.csv: what the springs of all bolts carried at the end of each stage, a row for each, and before those of a
// grouted bolt one for its plate. A grouted bar carries most at a joint or at its plate, so that the rows hold its
// greatest force. Columns:
//   stage                    from 1
//   bolts, bolt, joint       the name, which of its bolts, and which joint along it, from the collar; all from 1;
//                            joint 0 is a plate
//   x_m, y_m, z_m            between the spring's anchors, world coordinates
//   body_a, body_b           its blocks
//   force_N, shear_N         along the bolt, tension positive, and across it; of one bolt, also in the plane
//   extension_m, plastic_m   since it was installed, and how much of it is plastic; of a grouted bar how far the joint
//                            has opened along it, and how far the bar has yielded there
//   use                      force over yield; empty where it has none
//   broken                   1 where it is
//   slip_m                   of a grouted bar in the two blocks at the joint, the most; empty of others
std::string bolts_csv(const Results& results);

template <int Dim>
void add_bolt_rows(const Model<Dim>& model, const State<Dim>& state, int stage, Results& results);

// Bolts of other names may stand before those that are in place: the springs are told by name and number.
template <int Dim>
std::string find_bolts_again(const Model<Dim>& model, int stages, const Results& results, State<Dim>& state);

// The springs of bolts, a line each, between the middles of the bolt's length from joint to joint, from its
// collar to its toe; of grouted bolts the rods between the nodes of their bars, the first and last as long, with the
// joint that they cross or that comes next. Cell data: bolts, bolt, joint, force_N and shear_N (of one bolt, tension
// positive), plastic_m, use (of yield; 0 where it has none), broken. Field data: bolt_names.
template <int Dim>
PolyData bolt_lines(const Model<Dim>& model, const State<Dim>& state, double time);

LinePull bolt_pull(const PolyData& lines, std::size_t line);

// of all bolts of a name; forces of one bolt, N
void add_bolt_columns(const Monitor& monitor, const AddColumn& add);
template <int Dim>
void add_bolt_values(const Monitor& monitor, const Model<Dim>& model, const State<Dim>& state,
                     std::vector<double>& values);

}  // namespace voussoir
