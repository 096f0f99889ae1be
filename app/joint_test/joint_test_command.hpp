// `voussoir joint-test`.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "app/base/exit_codes.hpp"
#include "app/base/scene_arguments.hpp"

namespace voussoir {

struct JointTestArguments {
  SceneArguments scene;
  std::filesystem::path out;            // empty: results/<name of the scene's file>_joint_test
  std::vector<std::string> properties;  // of these joint_properties; none: of all
  std::string path = "shear";           // normal, shear, stiffness, cyclic
  std::vector<double> stresses;         // Pa; none: 0.1, 0.5, 1, 2, 5 MPa
  double slip = 1e-3;                   // m
  double surroundings = 1e9;            // Pa/m, of the path `stiffness`
  double dilation = 0.05;               // of the path `stiffness`
  int cycles = 2;                       // of the path `cyclic`
  int steps = 200;
  bool bonded = false;
  bool overwrite = false;
};

// takes the joints of a scene through laboratory tests: joint_test.csv and a figure of stress against displacement
ExitCode joint_test_command(const JointTestArguments& arguments);

}  // namespace voussoir
