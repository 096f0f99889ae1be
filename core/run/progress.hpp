// Everything a simulation has done and where it stands: exactly what a checkpoint saves.
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
  int stage = 0;                     // from 0; the number of stages when all is done
  bool stage_under_way = false;      // its changes are applied
  double stage_began = 0;            // s
  long long steps_before = 0;        // of the stages that ended
  RunProgress<Dim> run;              // of a stage that settles or runs
  SettleBegin<Dim> settle;           // of one that settles
  ReductionProgress<Dim> reduction;  // of a stage that reduces strength
  StageRecord record;                // rows of the stage under way
  double next_frame = 0;             // s
  std::vector<double> frames;        // s: of the frames written
  std::vector<double> trial_frames;  // of those of trials that were taken back: the trials, counted from 1
  std::vector<StageEnd<Dim>> ends;   // of those that have ended and from which monitors count
  BondedContacts bonded;             // up to here
  Results results;                   // of what has ended
};

}  // namespace voussoir
