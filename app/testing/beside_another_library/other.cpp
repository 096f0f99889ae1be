#include "app/testing/beside_another_library/other.hpp"

Sample make_sample() {
  Sample sample;
  sample.values << 1, 2, 3, 4;
  return sample;
}

Eigen::Matrix4d make_matrix() {
  Eigen::Matrix4d matrix;
  matrix << 4, 1, 0, 0.5, 1, 3, 0.25, 0, 0, 0.25, 2, 1, 0.5, 0, 1, 5;
  return matrix;
}

std::size_t size_of_sample() {
  return sizeof(Sample);
}
