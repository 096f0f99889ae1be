// A run that begins at the end of another one with the same blocks and first stages.
#pragma once

#include <stdexcept>

#include "core/model/prepared.hpp"
#include "core/run/progress.hpp"
#include "core/scene/shared_stages.hpp"

namespace voussoir {

// says why the run cannot begin there; the caller adds the place
struct BeginError : std::runtime_error {
  using std::runtime_error::runtime_error;
};

// The progress of `scene` when the stages have ended that `other` has behind it (Watcher::ended): what the whole run
// would have, bit for bit, but for columns of monitors that the other did not follow, whose rows of these stages are
// not a number, rows that stand where the other's output plan put them, and frames, which stay with the other.
template <int Dim>
Progress<Dim> begin_at_end(const Prepared<Dim>& scene, Progress<Dim> other, const SharedStages& shared);

}  // namespace voussoir
