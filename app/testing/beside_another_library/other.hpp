// A third-party library, built with its own flags, whose interface has a fixed-size vector of Eigen.
#pragma once

#include <Eigen/Core>

struct Sample {
  char kind = 0;
  Eigen::Vector4d values;
};

Sample make_sample();
Eigen::Matrix4d make_matrix();
std::size_t size_of_sample();
