// A problem as input of programs: a data file for UDEC, a scene of ours, and what a data file of 3DEC adds to the text
// that `voussoir export` makes of that scene.
#pragma once

#include <string>

#include "verification/problems/problem.hpp"

namespace voussoir::problems {

// A problem in the plane as a data file in the grammar of UDEC 4 to 6, one trial of its search. It states at its head
// that it was not run.
std::string udec_text(const Problem& problem);

// A scene of voussoir: blocks by their corners, the stiff joints, gravity grown at once or within 1 s, one trial.
std::string scene_text(const Problem& problem);

// initial velocities, stages and the trial of a search, after the blocks and joints of a 3DEC data file
std::string three_dec_stages(const Problem& problem);

}  // namespace voussoir::problems
