# Half of a test's compile time is reading the same headers: they are compiled once for the unit tests of core and app and
# once for the cases, whose macros differ. Every source still includes the headers it uses.
set(VOUSSOIR_COMMON_HEADERS <Eigen/Dense> <algorithm> <filesystem> <functional> <map> <optional> <ranges> <span> <string> <vector>)
# The sources of tests and cases are not optimised: their compile time was half of that of `make test`, and what takes time in
# most of them is the library's work. OPTIMISED programs have exact arithmetic or brute force of their own. A constant of a
# header must not initialise one of a test's: without optimisation clang 14 may initialise it later.
set(VOUSSOIR_TEST_OPTIMISATION $<$<CONFIG:Release>:-O0>)
function(voussoir_precompiled_tests name)
  add_library(${name} OBJECT ${PROJECT_SOURCE_DIR}/cmake/precompiled.cpp)
  target_link_libraries(${name} PRIVATE voussoir_flags GTest::gtest ${ARGN})
  target_precompile_headers(${name} PRIVATE <gtest/gtest.h> ${VOUSSOIR_COMMON_HEADERS})
  target_compile_options(${name} PRIVATE ${VOUSSOIR_TEST_OPTIMISATION})
endfunction()
if(VOUSSOIR_BUILD_TESTS)
  find_package(fmt REQUIRED)
  voussoir_precompiled_tests(voussoir_unit_headers voussoir_core)
  voussoir_precompiled_tests(voussoir_case_headers voussoir_core voussoir_reference fmt::fmt)
endif()

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
  if(arg_OPTIMISED)
    target_compile_options(${target} PRIVATE $<$<CONFIG:Release>:-O1>)
  else()
    target_compile_options(${target} PRIVATE ${VOUSSOIR_TEST_OPTIMISATION})
  endif()
  if(NOT arg_OPTIMISED AND ("voussoir_core" IN_LIST arg_LIBS OR "voussoir_app" IN_LIST arg_LIBS))
    target_precompile_headers(${target} REUSE_FROM voussoir_unit_headers)
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
