#pragma once
// The observed order of a sweep: how the error falls with the knob, if it falls at all.
#include <optional>
#include <vector>

namespace voussoir::reports {

// one setting of a knob and its error, both above 0
struct KnobError {
  double value = 0.0;
  double error = 0.0;
};

struct ObservedOrder {
  double order = 0.0;        // error ~ value^order; negative if a larger value is the finer one
  double uncertainty = 0.0;  // two standard errors of the regression
  int count = 0;             // number of settings in the regression
  double coarsest = 0.0, finest = 0.0;
};

// A straight line through log error over log value, from the coarsest setting to the first after which the error stays
// within a factor of two of the finest one's: beyond it something else than the knob limits the error. The finer side
// is the one that ends with the smaller error. Empty when fewer than three settings converge, or when the slope is less
// than its uncertainty.
std::optional<ObservedOrder> observed_order(std::vector<KnobError> settings);

}  // namespace voussoir::reports
