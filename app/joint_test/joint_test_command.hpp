// `voussoir joint-test`.
#pragma once

#include "app/base/command.hpp"

namespace voussoir {

// drives the joint laws of a scene through laboratory tests: joint_test.csv and a figure of stress against displacement
void add_joint_test(CLI::App& program, Action& action);

}  // namespace voussoir
