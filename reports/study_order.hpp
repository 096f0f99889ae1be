#pragma once
// The observed order of a sweep: how the error falls with the knob, where it falls at all.
#include <optional>
#include <string>
#include <vector>

namespace voussoir::reports {

// one setting of a knob and the error it leaves, both above 0
struct KnobError {
  double value = 0.0;
  double error = 0.0;
};

struct ObservedOrder {
  double order = 0.0;        // error ~ value^order; negative where a larger value is the finer one
  double uncertainty = 0.0;  // two standard errors of the regression
  int count = 0;             // settings that it rests on
  double coarsest = 0.0, finest = 0.0;
};

// A straight line through log error over log value, fitted to the longest run of neighbouring settings in which every
// step to the finer side lowers the error at a local order of 1/4 at least: before it the method does not converge yet,
// behind it something else than the knob limits the error. The finer side is the one that ends with the smaller error.
// Empty when no three settings in a row converge.
std::optional<ObservedOrder> observed_order(std::vector<KnobError> settings);

}  // namespace voussoir::reports
