// A run that starts from the end of another one with the same blocks and first stages.
#pragma once

#include <stdexcept>

#include "core/model/prepared.hpp"
#include "core/run/progress.hpp"
#include "core/scene/shared_stages.hpp"

namespace voussoir {

// the reason why the run cannot begin there; the caller adds the place
struct BeginError : std::runtime_error {
  using std::runtime_error::runtime_error;
};

// The progress of `scene` after the stages that `other` has run (Watcher::ended): bit for bit that of the complete run,
// except columns of monitors that the other did not have, whose rows of these stages are not a number, the times of
// rows, which follow the other's output plan, and frames, which stay with the other.
template <int Dim>
Progress<Dim> begin_at_end(const Prepared<Dim>& scene, Progress<Dim> other, const SharedStages& shared);

}  // namespace voussoir
