// The complete progress of a simulation: exactly the content of a checkpoint.
#pragma once

#include <vector>

#include "core/output/monitor.hpp"
#include "core/output/results.hpp"
#include "core/run/bonded_contacts.hpp"
#include "core/run/reduction.hpp"
#include "core/run/settled.hpp"

namespace voussoir {

template <int Dim>
struct Progress {
  State<Dim> state;
  int stage = 0;                      // from 0; the number of stages when all is done
  bool stage_under_way = false;       // its changes are applied
  double stage_began = 0;             // s
  long long steps_before = 0;         // of the stages that ended
  RunProgress<Dim> run;               // of a stage that settles or runs
  SettleBegin<Dim> settle;            // of the same
  long long broken_before_stage = 0;  // bonds
  ReductionProgress<Dim> reduction;   // of a stage that reduces strength
  StageRecord record;                 // rows of the stage under way
  double next_frame = 0;              // s
  std::vector<double> frames;         // s: of the frames written
  std::vector<double> trial_frames;   // of those of undone trials: the trials, counted from 1
  std::vector<StageEnd<Dim>> ends;    // of stages that have ended and from which monitors measure
  BondedContacts bonded;              // up to here
  // m: by body, at the end of the stage under way by half of its steps' error; empty: not asked for
  std::vector<Vector<Dim>> by_half_error;
  Results results;  // of what has ended
};

}  // namespace voussoir
