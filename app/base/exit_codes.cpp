#include "app/base/exit_codes.hpp"

namespace voussoir {

ExitCode exit_code(Outcome outcome) {
  switch (outcome) {
    case Outcome::done:
      return ExitCode::done;
    case Outcome::incomplete:
      return ExitCode::incomplete;
    case Outcome::failed:
      return ExitCode::numerical;
  }
  return ExitCode::numerical;
}

ExitCode ended_by(int signal) {
  return static_cast<ExitCode>(static_cast<int>(ExitCode::signal) + signal);
}

}  // namespace voussoir
