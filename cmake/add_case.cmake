# voussoir_case(<name> [LONG] [OPTIMISED] SOURCES <files…> [LIBS <targets…>])
#   program case_<name>, CTest entry case.<name> (label case), and per <name>/<x>.gp report.<x> (label report), which draws
#   <build>/reports/figures/<x>.svg from the files that the case's test left in <build>/cases/<name>.
#   Sources are in the folder <name>; their order is that of the checks on the case's page.
#   With LONG, its test suites whose names end in Long are case.<name>.long (label long), which only `ctest -C Long` runs.
#   Suites whose names end in Figure check nothing: report.<name>.data (label report) runs them to write data of figures.
# voussoir_case_not_modelled(<name> …)
#   a case that is listed in the verdict table as not yet modelled.
# The global properties VOUSSOIR_CASES and VOUSSOIR_CASES_NOT_MODELLED contain the lists, so that the summary expects all
# cases, not only those with results.

function(voussoir_case name)
  cmake_parse_arguments(arg "LONG;OPTIMISED" "" "SOURCES;LIBS" ${ARGN})
  if(arg_UNPARSED_ARGUMENTS OR NOT arg_SOURCES)
    message(FATAL_ERROR "voussoir_case(${name}): state LONG, OPTIMISED, SOURCES and LIBS only, not: ${arg_UNPARSED_ARGUMENTS}")
  endif()
  if(NOT VOUSSOIR_BUILD_TESTS)
    return()
  endif()
  list(TRANSFORM arg_SOURCES PREPEND ${CMAKE_CURRENT_SOURCE_DIR}/${name}/ OUTPUT_VARIABLE sources)
  file(GLOB figures CONFIGURE_DEPENDS ${name}/*.gp)

  add_executable(case_${name} ${sources})
  target_link_libraries(case_${name} PRIVATE
    voussoir_flags voussoir_traps voussoir_verification voussoir::core voussoir_reference fmt::fmt ${arg_LIBS} GTest::gtest_main)
  if(NOT arg_OPTIMISED)
    target_compile_options(case_${name} PRIVATE ${VOUSSOIR_TEST_OPTIMISATION})
    target_precompile_headers(case_${name} REUSE_FROM voussoir_case_headers)
  endif()
  voussoir_compile_as_one(case_${name})
  voussoir_optimised_first(case_${name} voussoir_core voussoir_reference ${arg_LIBS})
  target_compile_definitions(case_${name} PRIVATE
    VOUSSOIR_SOURCE_DIR="${PROJECT_SOURCE_DIR}" VOUSSOIR_CASE_DIR="${PROJECT_SOURCE_DIR}/cases/${name}")

  # the program is one entry: its rows replace those of earlier runs
  set(output ${PROJECT_BINARY_DIR}/cases/${name})
  file(MAKE_DIRECTORY ${output})
  voussoir_test_entries(case.${name} case_${name} ${output} ${arg_LONG} ${sources})
  set(environment VOUSSOIR_VERDICTS=${PROJECT_BINARY_DIR}/verdicts VOUSSOIR_CASE_OUTPUT=${PROJECT_BINARY_DIR}/cases
                  VOUSSOIR_FRESH=1)
  set_tests_properties(case.${name} PROPERTIES LABELS case FIXTURES_SETUP case_${name} ENVIRONMENT "${environment}")

  if(arg_LONG)
    set_tests_properties(case.${name}.long PROPERTIES
      ENVIRONMENT "VOUSSOIR_VERDICTS=${PROJECT_BINARY_DIR}/verdicts-long;VOUSSOIR_CASE_OUTPUT=${PROJECT_BINARY_DIR}/cases-long")
  endif()

  foreach(source ${sources})
    file(STRINGS ${source} found REGEX "^TEST\\([A-Za-z]+Figure,")
    list(APPEND figure_suites ${found})
  endforeach()
  set(drawn_after case_${name})
  if(figure_suites)
    add_test(NAME report.${name}.data COMMAND case_${name} --gtest_brief=1 --gtest_filter=*Figure.*
             WORKING_DIRECTORY ${output})
    set_tests_properties(report.${name}.data PROPERTIES LABELS report FIXTURES_REQUIRED case_${name}
      FIXTURES_SETUP figures_${name} ENVIRONMENT VOUSSOIR_CASE_OUTPUT=${PROJECT_BINARY_DIR}/cases)
    list(APPEND drawn_after figures_${name})
  endif()

  # a figure is drawn only from a run that passed; without gnuplot it is a named skip
  foreach(figure ${figures})
    get_filename_component(stem ${figure} NAME_WE)
    add_test(NAME report.${stem} WORKING_DIRECTORY ${output}
      COMMAND ${PROJECT_SOURCE_DIR}/reports/draw.sh ${figure} ${PROJECT_BINARY_DIR}/reports/figures/${stem}.svg)
    set_tests_properties(report.${stem} PROPERTIES LABELS report FIXTURES_REQUIRED "${drawn_after}" SKIP_RETURN_CODE 77)
  endforeach()
  set_property(GLOBAL APPEND PROPERTY VOUSSOIR_CASES ${name})
endfunction()

function(voussoir_case_not_modelled)
  set_property(GLOBAL APPEND PROPERTY VOUSSOIR_CASES_NOT_MODELLED ${ARGN})
  list(TRANSFORM ARGN APPEND /*.cpp)
  voussoir_built_elsewhere(${ARGN})
endfunction()
