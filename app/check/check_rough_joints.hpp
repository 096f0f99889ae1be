// What `voussoir check` prints of joints of Barton and Bandis' law.
#pragma once

#include <string>
#include <vector>

#include "core/model/prepared.hpp"

namespace voussoir {

// roughness and strength of the blocks, mobilisation, dilation, the stress below which the angle is the largest
std::vector<std::string> rough_joint_text(const JointProperties& properties);

// their peak angles at the least, median and largest normal stress of faces under their own block's weight; empty: no
// such face
template <int Dim>
std::string rough_joint_angles(const Model<Dim>& model, int properties);

// the stages whose friction angle replaces the law, and those that restore it
template <int Dim>
void print_set_aside(const Prepared<Dim>& prepared);

}  // namespace voussoir
