# The unit tests of the core. Few programs: linking and Eigen's headers are what costs.
find_package(Boost 1.74 REQUIRED)

add_library(voussoir_oracle_algebra STATIC testing/dense.cpp)
target_link_libraries(voussoir_oracle_algebra PUBLIC Eigen3::Eigen PRIVATE voussoir_flags)
target_include_directories(voussoir_oracle_algebra PUBLIC ${PROJECT_SOURCE_DIR})
target_compile_definitions(voussoir_oracle_algebra PUBLIC EIGEN_DONT_VECTORIZE)

voussoir_test(unit.blocks LABEL unit
  SOURCES base/floating_point_traps_test.cpp base/on_threads_test.cpp geometry/geometry_test.cpp solvers/centre_test.cpp solvers/feasibility_test.cpp slicing/slicing_test.cpp
    slicing/sliver_test.cpp slicing/joints_test.cpp slicing/tiling_test.cpp
  LIBS voussoir_core voussoir_oracle_algebra Boost::headers)

voussoir_test(unit.joint_sets LABEL unit
  SOURCES joint_sets/joint_sets_test.cpp exchange/mesh_test.cpp exchange/tables_test.cpp scene/scene_files_test.cpp
  LIBS voussoir_core Boost::headers fmt::fmt)

voussoir_test(unit.law_and_motion LABEL unit
  SOURCES joint_laws/law_test.cpp joint_laws/joint_law_test.cpp joint_laws/face_friction_test.cpp step/motion_test.cpp support/bolt_test.cpp
  LIBS voussoir_core voussoir_oracle_algebra Boost::headers)

voussoir_test(unit.support LABEL unit SOURCES support/beam_test.cpp support/grout_test.cpp support/lining_test.cpp
  LIBS voussoir_core voussoir_oracle_algebra Boost::headers)

voussoir_test(unit.extremes LONG LABEL unit
  SOURCES joint_laws/law_extremes_test.cpp step/motion_extremes_test.cpp step/step_extremes_test.cpp
  LIBS voussoir_core voussoir_oracle_algebra Boost::headers fmt::fmt)

voussoir_test(unit.contact LABEL unit
  SOURCES contact/contact_test.cpp contact/thin_contact_test.cpp contact/overlap_region_test.cpp
    contact/multipliers_test.cpp contact/broad_phase_test.cpp contact/coplanar_facets_test.cpp
  LIBS voussoir_core voussoir_oracle_algebra Boost::headers)

voussoir_test(unit.neighbours LABEL unit SOURCES step/neighbours_test.cpp LIBS voussoir_core Boost::headers)

voussoir_test(unit.scene LABEL unit
  SOURCES scene/scene_test.cpp scene/bad_input_test.cpp scene/bad_stage_loads_test.cpp scene/bad_bolts_test.cpp scene/bad_linings_test.cpp scene/bad_water_test.cpp scene/bad_search_test.cpp scene/bad_faces_test.cpp scene/keys_test.cpp scene/number_text_test.cpp
    scene/permuted_input_test.cpp scene/accuracy_level_test.cpp scene/slicing_scene_test.cpp scene/repeat_test.cpp
    scene/stated_bodies_test.cpp scene/divided_strength_test.cpp run/stable_state_test.cpp
  LIBS voussoir_core Boost::headers fmt::fmt)

voussoir_test(unit.monitors LABEL unit SOURCES output/monitor_test.cpp scene/bad_monitors_test.cpp run/begin_test.cpp
  LIBS voussoir_core cereal::cereal)

voussoir_test(unit.output LABEL unit SOURCES output/output_test.cpp output/paraview_test.cpp output/view_test.cpp
  LIBS voussoir_core fmt::fmt nlohmann_json::nlohmann_json)

set(outside_solvers)
foreach(solver voussoir_glpk voussoir_ipopt)
  if(TARGET ${solver})
    list(APPEND outside_solvers ${solver})
  endif()
endforeach()
voussoir_test(unit.outside_solvers LABEL unit SOURCES solvers/outside_solvers_test.cpp
  LIBS voussoir_core ${outside_solvers} Boost::headers)


set(outside_cone_solver)
if(TARGET voussoir_ipopt)
  set(outside_cone_solver voussoir_ipopt)
endif()
voussoir_test(unit.potential LONG LABEL unit
  SOURCES potential/shape_test.cpp potential/mass_test.cpp potential/contact_test.cpp potential/conservative_test.cpp
  potential/certainty_test.cpp
  LIBS voussoir_core ${outside_cone_solver} Boost::headers)

voussoir_test(unit.particles LABEL unit SOURCES scene/particles_test.cpp
  scene/particles_energy_test.cpp scene/bad_particles_test.cpp
  LIBS voussoir_core cereal::cereal fmt::fmt Boost::headers)

if(TARGET voussoir_limit)
  voussoir_test(unit.limit LABEL unit SOURCES limit/limit_test.cpp limit/factor_of_safety_test.cpp limit/self_stress_test.cpp
    LIBS voussoir_limit Boost::headers)
endif()

# the exact referee: GPL, so a library of its own that only tests link
add_library(voussoir_exact_referee STATIC testing/exact_referee.cpp testing/exact_centre.cpp testing/exact_programs.cpp
  testing/exact_contacts.cpp)
target_link_libraries(voussoir_exact_referee PUBLIC voussoir_core voussoir_oracle_algebra gmpxx gmp PRIVATE voussoir_flags cddgmp)
voussoir_test(unit.exact_referee LABEL unit SOURCES testing/exact_referee_test.cpp slicing/exact_slicing_test.cpp
  LIBS voussoir_exact_referee Boost::headers)


# the contact kernel judged by it
voussoir_test(unit.certainty LONG LABEL unit
  SOURCES contact/certainty_test.cpp contact/centre_test.cpp contact/sensitivity_test.cpp contact/catalogue_test.cpp contact/symmetry_test.cpp
    contact/face_integral_test.cpp
    geometry/catalogue_test.cpp testing/pair_families.cpp testing/pair_judge.cpp
  LIBS voussoir_exact_referee Boost::headers fmt::fmt hwy::hwy)

voussoir_test(unit.faces LABEL unit
  SOURCES contact/region_integral_test.cpp step/face_forces_test.cpp
  LIBS voussoir_exact_referee cereal::cereal Boost::headers fmt::fmt)

voussoir_test(unit.newton LONG LABEL unit
  SOURCES step/static_solver_test.cpp step/static_solver_verdict_test.cpp solvers/block_solver_test.cpp
  LIBS voussoir_core voussoir_oracle_algebra cereal::cereal Boost::headers)

voussoir_test(unit.step LABEL unit
  SOURCES step_test.cpp run/simulate_test.cpp run/excavate_test.cpp stage/install_bolts_test.cpp stage/install_grouted_test.cpp stage/install_linings_test.cpp testing/whole_scenes_test.cpp step/joint_forces_test.cpp step/loads_test.cpp testing/step_memory_test.cpp base/energy_test.cpp step/prescribed_test.cpp
    load/boundary_stress_test.cpp load/water_test.cpp load/water_bends_test.cpp step/water_test.cpp scene/water_scene_test.cpp
    model/state_hash_test.cpp run/reduction_test.cpp step/relaxation_test.cpp run/checkpoint_test.cpp
  LIBS voussoir_core voussoir_oracle_algebra cereal::cereal Boost::headers fmt::fmt)

voussoir_test(unit.rest LABEL unit
  SOURCES step/rest_test.cpp step/free_fall_test.cpp run/settled_test.cpp scene/stage_excavations_test.cpp
  LIBS voussoir_core cereal::cereal Boost::headers fmt::fmt)
