# voussoir_version(<target>): gives the target a header voussoir_version.h with the project's version and the commit built.
# The same file is the script that writes the header at build time; it touches it only when something changed.

if(CMAKE_SCRIPT_MODE_FILE)
  cmake_minimum_required(VERSION 3.25)
  set(commit "")
  find_package(Git QUIET)
  if(Git_FOUND)
    # a source archive unpacked inside another repository must not take that one's commit
    execute_process(COMMAND ${GIT_EXECUTABLE} rev-parse --show-toplevel WORKING_DIRECTORY ${SOURCE_DIR}
                    OUTPUT_VARIABLE top OUTPUT_STRIP_TRAILING_WHITESPACE ERROR_QUIET)
    if(top)
      file(REAL_PATH "${top}" top)
      file(REAL_PATH "${SOURCE_DIR}" source)
      if(top STREQUAL source)
        execute_process(COMMAND ${GIT_EXECUTABLE} describe --always --dirty WORKING_DIRECTORY ${SOURCE_DIR}
                        OUTPUT_VARIABLE commit OUTPUT_STRIP_TRAILING_WHITESPACE ERROR_QUIET)
      endif()
    endif()
  endif()
  if(NOT commit)
    file(STRINGS ${SOURCE_DIR}/cmake/archived_commit.txt commit)  # git archive has written it
    if(NOT commit MATCHES "^[0-9a-f]+$")
      set(commit unknown)
    endif()
  endif()
  file(CONFIGURE OUTPUT ${HEADER} @ONLY CONTENT [[
#define VOUSSOIR_VERSION "@VERSION@"
#define VOUSSOIR_COMMIT "@commit@"
]])
  return()
endif()

set(VOUSSOIR_VERSION_SCRIPT ${CMAKE_CURRENT_LIST_FILE})

function(voussoir_version target)
  set(folder ${CMAKE_CURRENT_BINARY_DIR}/version)
  add_custom_target(${target}_version
    COMMAND ${CMAKE_COMMAND} -DSOURCE_DIR=${PROJECT_SOURCE_DIR} -DVERSION=${PROJECT_VERSION}
            -DHEADER=${folder}/voussoir_version.h -P ${VOUSSOIR_VERSION_SCRIPT}
    BYPRODUCTS ${folder}/voussoir_version.h
    COMMENT "")
  add_dependencies(${target} ${target}_version)
  target_include_directories(${target} PRIVATE ${folder})
endfunction()
