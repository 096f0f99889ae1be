# Half of a test's compile time is reading the same headers: they are compiled once for the unit tests of core and app, once for
# those of them that are optimised, once for the cases and once for the closed forms, whose macros differ, and once for
# the programs that only write text. Every source still includes the headers it uses.
set(VOUSSOIR_COMMON_HEADERS <Eigen/Dense> <algorithm> <filesystem> <functional> <map> <optional> <ranges> <span> <string> <vector>)
# The sources of tests and cases are not optimised: their compile time was half of that of `make test`, and what takes time in
# most of them is the library's work. OPTIMISED programs have exact arithmetic or brute force of their own. A constant of a
# header must not initialise one of a test's: without optimisation clang 14 may initialise it later.
set(VOUSSOIR_TEST_OPTIMISATION $<$<CONFIG:Release>:-O0>)
set(VOUSSOIR_OPTIMISED_TESTS $<$<CONFIG:Release>:-O1>)
# voussoir_precompiled_tests(<name> <optimisation> [HEADERS <further ones…>] LIBS <targets…>). A third of the compile time of a case,
# or of a test of the program, is the headers of loaded scenes and results: HEADERS has them. A change of one compiles these tests
# again, as it does without. Not for the unit tests of the core: with its headers they took longer, and the headers twice as long.
function(voussoir_precompiled_tests name optimisation)
  cmake_parse_arguments(arg "" "" "HEADERS;LIBS" ${ARGN})
  add_library(${name} OBJECT ${PROJECT_SOURCE_DIR}/cmake/precompiled.cpp)
  target_link_libraries(${name} PRIVATE voussoir_flags GTest::gtest ${arg_LIBS})
  target_precompile_headers(${name} PRIVATE <gtest/gtest.h> ${VOUSSOIR_COMMON_HEADERS} ${arg_HEADERS})
  target_compile_options(${name} PRIVATE ${optimisation})
endfunction()
if(VOUSSOIR_BUILD_TESTS)
  find_package(Eigen3 3.4 REQUIRED NO_MODULE)
  find_package(fmt REQUIRED)
  find_package(nlohmann_json REQUIRED)
  voussoir_precompiled_tests(voussoir_unit_headers "${VOUSSOIR_TEST_OPTIMISATION}" LIBS voussoir_core)
  voussoir_precompiled_tests(voussoir_optimised_unit_headers "${VOUSSOIR_OPTIMISED_TESTS}" LIBS voussoir_core)
  # those that app/testing/program.hpp includes; itself it has a macro of its program
  voussoir_precompiled_tests(voussoir_program_headers "${VOUSSOIR_TEST_OPTIMISATION}"
    HEADERS <fmt/format.h> <nlohmann/json.hpp> ${PROJECT_SOURCE_DIR}/app/base/run_scene.hpp ${PROJECT_SOURCE_DIR}/app/testing/process.hpp
    LIBS voussoir_core fmt::fmt nlohmann_json::nlohmann_json)
  # those that cases/case_tools.hpp includes; itself it has a macro of each case
  voussoir_precompiled_tests(voussoir_case_headers "${VOUSSOIR_TEST_OPTIMISATION}"
    HEADERS <fmt/format.h> ${PROJECT_SOURCE_DIR}/app/base/run_scene.hpp ${PROJECT_SOURCE_DIR}/verification/case_report.hpp
    LIBS voussoir_core voussoir_reference fmt::fmt)
  voussoir_precompiled_tests(voussoir_reference_headers "${VOUSSOIR_TEST_OPTIMISATION}" LIBS voussoir_reference Eigen3::Eigen)
  voussoir_precompiled_tests(voussoir_text_headers "${VOUSSOIR_TEST_OPTIMISATION}" LIBS Eigen3::Eigen fmt::fmt nlohmann_json::nlohmann_json)
  target_precompile_headers(voussoir_text_headers PRIVATE <fmt/format.h> <nlohmann/json.hpp>)
endif()

# voussoir_writes_text(<target> …): targets that read files and write text, as fast without optimisation as anybody needs
function(voussoir_writes_text)
  foreach(target ${ARGN})
    target_compile_options(${target} PRIVATE ${VOUSSOIR_TEST_OPTIMISATION})
    if(VOUSSOIR_BUILD_TESTS)
      target_link_libraries(${target} PRIVATE fmt::fmt)
      target_precompile_headers(${target} REUSE_FROM voussoir_text_headers)
    endif()
  endforeach()
endfunction()

# voussoir_test(<name> [LONG] [OPTIMISED] LABEL <label> SOURCES <patterns…> LIBS <targets…>): one GoogleTest program, one CTest entry,
# with floating-point traps on. A pattern (core/*_test.cpp) takes the sources that no earlier program of the same
# CMakeLists.txt took: name the exceptions first. With LONG, its test suites whose names end in Long are <name>.long
# (label long), which only `ctest -C Long` runs.
function(voussoir_test name)
  cmake_parse_arguments(arg "LONG;OPTIMISED" "LABEL" "SOURCES;LIBS" ${ARGN})
  if(NOT VOUSSOIR_BUILD_TESTS)
    return()
  endif()
  string(REPLACE "." "_" target ${name})
  _voussoir_untaken(sources ${name} ${arg_SOURCES})
  add_executable(${target} ${sources})
  target_link_libraries(${target} PRIVATE voussoir_flags voussoir_traps ${arg_LIBS} GTest::gtest_main)
  target_compile_definitions(${target} PRIVATE VOUSSOIR_SOURCE_DIR="${PROJECT_SOURCE_DIR}")
  set(uses_core OFF)
  if("${arg_LIBS}" MATCHES "voussoir_(core|app|exact_referee)")
    set(uses_core ON)
  endif()
  if(arg_OPTIMISED)
    target_compile_options(${target} PRIVATE ${VOUSSOIR_OPTIMISED_TESTS})
    if(uses_core)
      target_precompile_headers(${target} REUSE_FROM voussoir_optimised_unit_headers)
    endif()
  else()
    target_compile_options(${target} PRIVATE ${VOUSSOIR_TEST_OPTIMISATION})
    if("voussoir_app" IN_LIST arg_LIBS AND "fmt::fmt" IN_LIST arg_LIBS)
      target_precompile_headers(${target} REUSE_FROM voussoir_program_headers)
    elseif(uses_core)
      target_precompile_headers(${target} REUSE_FROM voussoir_unit_headers)
    elseif("voussoir_reference" IN_LIST arg_LIBS)
      target_precompile_headers(${target} REUSE_FROM voussoir_reference_headers)
    elseif("${arg_LIBS}" MATCHES "voussoir_(reports|verdicts|verification|contact_tables)")
      target_precompile_headers(${target} REUSE_FROM voussoir_text_headers)
    endif()
  endif()
  voussoir_compile_as_one(${target})
  voussoir_optimised_first(${target} ${arg_LIBS})
  voussoir_test_entries(${name} ${target} ${CMAKE_CURRENT_BINARY_DIR} ${arg_LONG} ${sources})
  set_tests_properties(${name} PROPERTIES LABELS ${arg_LABEL})
endfunction()

# The linker keeps the first of several copies of an inline function. Those of the libraries are optimised: they come
# before the sources of the test, whose copies are not, and the libraries' work takes as long as in the program.
function(voussoir_optimised_first target)
  set(first)
  if("${ARGN}" MATCHES "voussoir_(app|exact_referee|limit)")
    list(APPEND ARGN voussoir_core)  # with them
  endif()
  foreach(library voussoir_core voussoir_app voussoir_reference)
    if(${library} IN_LIST ARGN)
      list(APPEND first $<TARGET_FILE:${library}>)
    endif()
  endforeach()
  if(first)
    target_link_options(${target} PRIVATE LINKER:--whole-archive ${first} LINKER:--no-whole-archive)
  endif()
endfunction()

# Long ones of the short tests begin first, or a core would wait for the last of them; seconds of a first run, without costs of its own.
function(voussoir_begins_early seconds)
  foreach(name ${ARGN})
    if(TEST ${name})
      set_tests_properties(${name} PROPERTIES COST ${seconds})
    endif()
  endforeach()
endfunction()

function(_voussoir_untaken result name)
  get_property(taken DIRECTORY PROPERTY VOUSSOIR_TAKEN)
  set(sources)
  foreach(pattern ${ARGN})
    file(GLOB found CONFIGURE_DEPENDS ${pattern})
    list(REMOVE_ITEM found ${taken} ${sources})
    if(NOT found)
      message(FATAL_ERROR "${name}: ${pattern} matches no source, or none that no other program took before")
    endif()
    list(APPEND sources ${found})
  endforeach()
  set_property(DIRECTORY APPEND PROPERTY VOUSSOIR_TAKEN ${sources})
  set(${result} ${sources} PARENT_SCOPE)
endfunction()

# The CTest entries of a GoogleTest program that runs in a folder: <name>, and with `long` <name>.long. Suites whose names
# end in Figure only write data of figures: the report runs them (voussoir_case). Long suites without `long` are a mistake,
# as they would run in every `make test`, and so are `long` without Long suites, which would run nothing, and a test named
# DISABLED_…, which nothing runs.
function(voussoir_test_entries name target folder long)
  set(suites)
  foreach(source ${ARGN})
    file(STRINGS ${source} found REGEX "^TEST(_F|_P)?\\([A-Za-z]+Long,")
    list(APPEND suites ${found})
    file(STRINGS ${source} disabled REGEX "^TEST.*DISABLED_")
    if(disabled)
      message(FATAL_ERROR "${name}: ${disabled} would never run; a long test is in a suite whose name ends in Long")
    endif()
  endforeach()
  if(suites AND NOT long)
    message(FATAL_ERROR "${name}: test suites whose names end in Long need LONG: ${suites}")
  elseif(long AND NOT suites)
    message(FATAL_ERROR "${name}: LONG, but there is no test suite whose name ends in Long")
  endif()
  add_test(NAME ${name} WORKING_DIRECTORY ${folder}
    COMMAND ${target} --gtest_brief=1 --gtest_filter=-*Long.*:*Figure.*)
  if(long)
    add_test(NAME ${name}.long CONFIGURATIONS Long WORKING_DIRECTORY ${folder}
      COMMAND ${target} --gtest_brief=1 --gtest_filter=*Long.*)
    set_tests_properties(${name}.long PROPERTIES LABELS long TIMEOUT 14400)
  endif()
endfunction()
