// Monitored quantities of a simulation.
#pragma once

#include <string>
#include <vector>

#include "core/model/prepared.hpp"
#include "core/output/results.hpp"
#include "core/stage/excavation.hpp"

namespace voussoir {

// one column of the history: a name without and with its unit
struct Column {
  std::string name, unit;
  std::string header() const;
};

// poses of all bodies at the end of a stage from which monitors measure, in terms of the present bodies
template <int Dim>
struct StageEnd {
  int stage = 0;  // from 0
  std::vector<Placement<Dim>> bodies;
};

template <int Dim>
StageEnd<Dim> stage_end(int stage, const State<Dim>& state);

// After an excavation, remaining bodies are measured from their own earlier position: bodies have new centroids and
// pieces new ids.
template <int Dim>
void carry(const Excavated<Dim>& moved, StageEnd<Dim>& end);

// Columns and present values of all monitors, in order. Displacement, velocity and angular velocity (rad/s) by
// component of the world axes, rotation as the rotation vector in degrees; of one body, or the sum or mean over several
// (<name>_sum_…, <name>_mean_…). Contact load of a body: the vector sum of
// the forces that its contacts exert on it. Contact force of a joint: over its touching contacts the sums of normal and
// of shear force and of area, their number, the largest mobilised friction angle, and the tilt of the contact with the
// largest force against the joint's own normal. Convergence: displacement of points of a wall towards the opening's
// centre, including the rotation of their blocks, m. Bolt force: the largest and the mean axial force of the springs of
// all bolts of a name, tension positive, of one bolt, and how many springs have yielded and broken. Lining force:
// thrust, shear force and moment of one node, or the largest of all, with their sign, and the largest utilisation. All
// at the state's time except velocities, which are half a step earlier, if the forces are those of its positions
// (step.hpp). Values measured from the end of a stage (`ends`) are 0 until then.
template <int Dim>
std::vector<Column> monitor_columns(const std::vector<Monitor>& monitors);
template <int Dim>
std::vector<double> monitor_values(const std::vector<Monitor>& monitors, const Model<Dim>& model,
                                   const State<Dim>& state, const std::vector<StageEnd<Dim>>& ends = {});

// Rows of a stage. With an interval a row at each; without one rows are thinned so that a stage keeps about 200 rows
// for any duration: when full, every second row is dropped and the spacing doubles.
struct StageRecord {
  double interval = 0;  // s; 0: thin
  double next = 0;      // s: time of the next row
  long long step = 0, spacing = 1;
  std::vector<std::vector<double>> rows;

  // whether a row is due now; call once a step
  bool due(double time);
  void add(std::vector<double> row);
};

}  // namespace voussoir
