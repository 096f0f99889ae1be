// `voussoir joint-test`.
#pragma once

#include "app/base/command.hpp"

namespace voussoir {

// takes the joints of a scene through laboratory tests: joint_test.csv and a figure of stress against displacement
void add_joint_test(CLI::App& program, Action& action);

}  // namespace voussoir
