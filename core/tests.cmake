# The unit tests of the core. Few programs: linking and Eigen's headers are what costs.
find_package(Boost 1.74 REQUIRED)

voussoir_test(unit.blocks LABEL unit
  SOURCES geometry/geometry_test.cpp optimise/optimise_test.cpp slicing/slicing_test.cpp
  LIBS voussoir_core Boost::headers)

voussoir_test(unit.law_and_motion LABEL unit
  SOURCES law/law_test.cpp motion/motion_test.cpp
  LIBS voussoir_core Boost::headers)
