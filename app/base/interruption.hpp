// Signals that ask a run to stop: it ends at the next step, with a checkpoint.
#pragma once

namespace voussoir {

// From now on SIGINT, SIGTERM, SIGHUP, SIGQUIT, SIGUSR1 and SIGXCPU are noted instead of ending the program. After the
// first one SIGINT and SIGQUIT, those of a keyboard, end it and the others do nothing. Those that were ignored stay
// ignored.
void note_interruptions();

// the signal noted last; 0: none
int interruption();

// At the program's start: a file that exceeds the size limit becomes a write error instead of a signal,
// and a standard stream that is closed cannot be mistaken for the next file that is opened.
void prepare_process();

}  // namespace voussoir
