# The unit tests of the core. Few programs, because linking and Eigen's headers are expensive. A test belongs to its room's program; first
# come the programs with certain tests from several rooms.
find_package(Boost 1.74 REQUIRED)

# optimised as the tests that use it: at the program's level it took as long to compile as three of them
add_library(voussoir_oracle_algebra STATIC testing/dense.cpp)
target_compile_options(voussoir_oracle_algebra PRIVATE ${VOUSSOIR_OPTIMISED_TESTS})
target_precompile_headers(voussoir_oracle_algebra REUSE_FROM voussoir_optimised_unit_headers)
target_link_libraries(voussoir_oracle_algebra PUBLIC Eigen3::Eigen PRIVATE voussoir_flags)
target_include_directories(voussoir_oracle_algebra PUBLIC ${PROJECT_SOURCE_DIR})
target_compile_definitions(voussoir_oracle_algebra PUBLIC EIGEN_DONT_VECTORIZE)

add_library(voussoir_end_bytes STATIC testing/end_bytes.cpp)
target_compile_options(voussoir_end_bytes PRIVATE ${VOUSSOIR_TEST_OPTIMISATION})
target_precompile_headers(voussoir_end_bytes REUSE_FROM voussoir_unit_headers)
target_link_libraries(voussoir_end_bytes PUBLIC voussoir_core PRIVATE voussoir_flags cereal::cereal)

set(outside_cone_solver)
if(TARGET voussoir_ipopt)
  set(outside_cone_solver voussoir_ipopt)
endif()
set(outside_solvers ${outside_cone_solver})
if(TARGET voussoir_glpk)
  list(APPEND outside_solvers voussoir_glpk)
endif()

# the exact reference solver: GPL, therefore a library of its own that only tests link; and the contact kernel's checker, which uses it
add_library(voussoir_exact_referee STATIC testing/exact_referee.cpp testing/exact_centre.cpp testing/exact_programs.cpp testing/exact_contacts.cpp
  testing/pair_families.cpp testing/pair_judge.cpp)
target_compile_options(voussoir_exact_referee PRIVATE ${VOUSSOIR_OPTIMISED_TESTS})
target_precompile_headers(voussoir_exact_referee REUSE_FROM voussoir_optimised_unit_headers)
target_link_libraries(voussoir_exact_referee PUBLIC voussoir_core voussoir_oracle_algebra gmpxx gmp
  PRIVATE voussoir_flags cddgmp fmt::fmt Boost::headers)

voussoir_test(unit.extremes LONG OPTIMISED LABEL unit SOURCES */*_extremes_test.cpp
  LIBS voussoir_core voussoir_oracle_algebra Boost::headers fmt::fmt)
voussoir_test(unit.exact_referee LABEL unit SOURCES */exact_*_test.cpp LIBS voussoir_exact_referee Boost::headers)
voussoir_test(unit.certainty LONG OPTIMISED LABEL unit
  SOURCES */catalogue_test.cpp contact/certainty_test.cpp contact/centre_test.cpp contact/sensitivity_test.cpp
    contact/symmetry_test.cpp contact/face_integral_test.cpp
  LIBS voussoir_exact_referee Boost::headers fmt::fmt hwy::hwy)
voussoir_test(unit.faces OPTIMISED LABEL unit SOURCES contact/region_integral_test.cpp step/face_forces_test.cpp
  LIBS voussoir_exact_referee cereal::cereal Boost::headers fmt::fmt)
voussoir_test(unit.outside_solvers LABEL unit SOURCES solvers/outside_solvers_test.cpp limit/referee_test.cpp
  LIBS voussoir_core ${outside_solvers} Boost::headers)
voussoir_test(unit.newton LONG LABEL unit SOURCES step/static_solver*_test.cpp solvers/block_solver_test.cpp
  LIBS voussoir_core voussoir_oracle_algebra Boost::headers)
voussoir_test(unit.neighbours OPTIMISED LABEL unit SOURCES step/neighbours_test.cpp LIBS voussoir_core Boost::headers)
voussoir_test(unit.rest LABEL unit
  SOURCES step/rest_test.cpp step/free_fall_test.cpp run/settled_test.cpp scene/stage_excavations_test.cpp
  LIBS voussoir_core Boost::headers fmt::fmt)
voussoir_test(unit.mechanism LONG LABEL unit SOURCES run/block_theory_test.cpp run/find_mechanism_test.cpp
  LIBS voussoir_core voussoir_end_bytes Boost::headers fmt::fmt)
voussoir_test(unit.particles LABEL unit SOURCES scene/*particles*_test.cpp
  LIBS voussoir_core voussoir_end_bytes fmt::fmt Boost::headers)
voussoir_test(unit.monitors LABEL unit SOURCES */*monitor*_test.cpp run/begin_test.cpp LIBS voussoir_core voussoir_end_bytes)
voussoir_test(unit.law_and_motion OPTIMISED LABEL unit
  SOURCES joint_laws/*_test.cpp step/motion_test.cpp support/bolt_test.cpp
  LIBS voussoir_core voussoir_oracle_algebra Boost::headers)

voussoir_test(unit.blocks LABEL unit SOURCES base/*_test.cpp geometry/*_test.cpp solvers/*_test.cpp slicing/*_test.cpp modes/*_test.cpp
  LIBS voussoir_core voussoir_oracle_algebra Boost::headers)
voussoir_test(unit.joint_sets LABEL unit SOURCES joint_sets/*_test.cpp exchange/*_test.cpp
  LIBS voussoir_core Boost::headers fmt::fmt)
voussoir_test(unit.probability LONG LABEL unit SOURCES probability/*_test.cpp testing/limit_states.cpp
  LIBS voussoir_core Boost::headers fmt::fmt)
voussoir_test(unit.key_blocks LABEL unit SOURCES key_blocks/*_test.cpp LIBS voussoir_core fmt::fmt)
voussoir_test(unit.implicit LABEL unit SOURCES implicit/*_test.cpp LIBS voussoir_core fmt::fmt)
voussoir_test(unit.support LABEL unit SOURCES support/*_test.cpp LIBS voussoir_core voussoir_oracle_algebra Boost::headers)
voussoir_test(unit.contact LONG OPTIMISED LABEL unit SOURCES contact/*_test.cpp
  LIBS voussoir_core voussoir_oracle_algebra Boost::headers)
voussoir_test(unit.potential LONG LABEL unit SOURCES potential/*_test.cpp
  LIBS voussoir_core ${outside_cone_solver} Boost::headers)
voussoir_test(unit.scene LABEL unit SOURCES scene/*_test.cpp LIBS voussoir_core voussoir_end_bytes Boost::headers fmt::fmt)
voussoir_test(unit.output LABEL unit SOURCES output/*_test.cpp LIBS voussoir_core fmt::fmt nlohmann_json::nlohmann_json ZLIB::ZLIB)
voussoir_test(unit.limit LABEL unit SOURCES limit/*_test.cpp LIBS voussoir_core Boost::headers)
voussoir_test(unit.step LONG LABEL unit
  SOURCES *_test.cpp load/*_test.cpp model/*_test.cpp run/*_test.cpp stage/*_test.cpp step/*_test.cpp testing/*_test.cpp
  LIBS voussoir_core voussoir_end_bytes voussoir_oracle_algebra Boost::headers fmt::fmt)
