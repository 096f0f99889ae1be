// Signals that ask a run to stop: it ends at the next step, with a checkpoint.
#pragma once

namespace voussoir {

// From now on SIGINT, SIGTERM and SIGHUP are noted instead of ending the program; the same signal a second time ends
// it. A file that exceeds the limit of its size is an error of writing, not a signal.
void note_interruptions();

// the signal noted last; 0: none
int interruption();

}  // namespace voussoir
