// A drawn joint set inside the domain: intensities, spacing, orientation, size, each with its standard error.
#pragma once

#include <vector>

#include "core/joint_sets/joint_set.hpp"

namespace voussoir {

struct Estimate {
  double value = 0;
  double error = 0;  // standard error; 0 if a single sample gives none
};

// Intensities are sums over joints, so of a Poisson process their variance is the sum of squares (Campbell 1909);
// joints at equal distances vary less.
template <int Dim>
struct SetStatistics {
  std::vector<double> measures;  // of each joint, area (2-D: length) inside the domain, m² (2-D: m); 0: misses it
  long long inside = 0;          // joints that meet the domain
  double stated_intensity = 0;   // P32 (2-D: P21), 1/m
  Estimate intensity;            // the same measured

  double stated_frequency = 0;   // P10 along the mean normal, 1/m
  Estimate frequency;            // on scanlines across the domain
  double scanned = 0;            // their length, m
  std::vector<double> spacings;  // between neighbours on them, m, ascending; short domains miss the wide ones

  // 3-D: traces on the planes through the ball's centre normal to x, y, z, P21 in 1/m; the stated ones follow from P32
  // and the orientations drawn
  std::vector<double> stated_traces;
  std::vector<Estimate> traces;

  Estimate fisher_constant;   // 3-D, of the poles of joints inside: (n - 1)/(n - |sum|) (Fisher 1953)
  long long centred = 0;      // finite joints whose centre lies inside: their sizes are the law's
  Estimate size;              // their mean, m
  double size_deviation = 0;  // m
};

// `domain` is seen from `origin`, joints and ball are in the file's coordinates.
template <int Dim>
SetStatistics<Dim> measure(const JointSet& set, const std::vector<DrawnJoint<Dim>>& joints, const Ball<Dim>& ball,
                           const Polytope<Dim>& domain, const Vector<Dim>& origin);

// mean and its error, and the deviation (of n - 1)
struct Moments {
  Estimate mean;
  double deviation = 0;
};
Moments moments_of(const std::vector<double>& sample);

// the size at `fraction` of the total: of volumes ascending, the smallest whose sum with all below it reaches the
// fraction
double size_at_fraction(const std::vector<double>& ascending, double fraction);

}  // namespace voussoir
