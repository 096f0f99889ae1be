# voussoir_test(<name> [LONG] LABEL <label> SOURCES <files…> LIBS <targets…>): one GoogleTest program, one CTest entry,
# with floating-point traps on. With LONG, its tests named DISABLED_… are <name>.long (label long), which only
# `ctest -C Long` runs.
function(voussoir_test name)
  cmake_parse_arguments(arg "LONG" "LABEL" "SOURCES;LIBS" ${ARGN})
  if(NOT VOUSSOIR_BUILD_TESTS)
    return()
  endif()
  string(REPLACE "." "_" target ${name})
  add_executable(${target} ${arg_SOURCES})
  target_link_libraries(${target} PRIVATE voussoir_flags voussoir_traps ${arg_LIBS} GTest::gtest_main)
  # a test's own code need not be fast, and compiling it is what `make test` waits for
  target_compile_options(${target} PRIVATE $<$<CONFIG:Release>:-O1>)
  target_compile_definitions(${target} PRIVATE VOUSSOIR_SOURCE_DIR="${PROJECT_SOURCE_DIR}")
  add_test(NAME ${name} COMMAND ${target} --gtest_brief=1 WORKING_DIRECTORY ${CMAKE_CURRENT_BINARY_DIR})
  set_tests_properties(${name} PROPERTIES LABELS ${arg_LABEL})
  if(arg_LONG)
    add_test(NAME ${name}.long CONFIGURATIONS Long WORKING_DIRECTORY ${CMAKE_CURRENT_BINARY_DIR}
      COMMAND ${target} --gtest_brief=1 --gtest_also_run_disabled_tests --gtest_filter=*DISABLED_*)
    set_tests_properties(${name}.long PROPERTIES LABELS long TIMEOUT 14400)
  endif()
endfunction()
