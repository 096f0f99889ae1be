# Debian packages by CPack: voussoir (program), libvoussoir-dev, and python3-voussoir if the Python module is built.
# Each contains its install component, its copyright, and Debian's changelog.
set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGE_NAME voussoir)
set(CPACK_PACKAGE_VERSION ${PROJECT_VERSION})
set(CPACK_PACKAGE_DESCRIPTION_SUMMARY "")  # each package has its own
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_STRIP_FILES ON)
set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_RELEASE 1)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)
set(VOUSSOIR_MAINTAINER "The Voussoir authors <voussoir@localhost>" CACHE STRING "maintainer of the packages: name <address>")
set(CPACK_PACKAGE_CONTACT ${VOUSSOIR_MAINTAINER})

# first line, text, a blank line between paragraphs
set(about "Motion and collapse of rock blocks between joints, and of masonry,
computed contact by contact: slopes, tunnels, arches, dams.
")
set(CPACK_DEBIAN_PROGRAM_PACKAGE_NAME voussoir)
set(CPACK_DEBIAN_PROGRAM_PACKAGE_SECTION science)
set(CPACK_DEBIAN_PROGRAM_DESCRIPTION "distinct element models of jointed rock
${about}
The program runs scenes stated in TOML, searches factors of safety,
makes parameter studies, imports joints, and writes files for ParaView.")
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_NAME libvoussoir-dev)
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_SECTION libdevel)
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_DEPENDS "libeigen3-dev (>= 3.4), libfmt-dev, libhwy-dev, zlib1g-dev")
set(CPACK_DEBIAN_DEVELOPMENT_DESCRIPTION "distinct element models of jointed rock (C++ library)
${about}
The static library and its headers, for CMake and pkg-config.")
set(CPACK_DEBIAN_PYTHON_PACKAGE_NAME python3-voussoir)
set(CPACK_DEBIAN_PYTHON_PACKAGE_SECTION python)
set(CPACK_DEBIAN_PYTHON_PACKAGE_DEPENDS "python3 (>= 3.11), python3 (<< 3.12), python3-numpy")
set(CPACK_DEBIAN_PYTHON_PACKAGE_RECOMMENDS "voussoir (= ${PROJECT_VERSION})")  # its commands
set(CPACK_DEBIAN_PYTHON_DESCRIPTION "distinct element models of jointed rock (Python module)
${about}
Scenes as Python objects, their state as read-only arrays of numpy, and the
commands of the program voussoir as functions.")

# the files that every package must have in its documentation folder
string(TIMESTAMP VOUSSOIR_PACKAGE_DATE "%a, %d %b %Y %H:%M:%S +0000" UTC)  # of SOURCE_DATE_EPOCH
configure_file(changelog.Debian.in changelog.Debian @ONLY)
execute_process(COMMAND ${GZIP} -9nc changelog.Debian WORKING_DIRECTORY ${CMAKE_CURRENT_BINARY_DIR}
  OUTPUT_FILE changelog.Debian.gz COMMAND_ERROR_IS_FATAL ANY)
execute_process(COMMAND ${GZIP} -9nc ${PROJECT_SOURCE_DIR}/CHANGELOG.md WORKING_DIRECTORY ${CMAKE_CURRENT_BINARY_DIR}
  OUTPUT_FILE changelog.gz COMMAND_ERROR_IS_FATAL ANY)

# our components among those that the project installs: Python's exists if its module is built
get_cmake_property(installed COMPONENTS)
foreach(component program development python)
  if(NOT component IN_LIST installed)
    continue()
  endif()
  list(APPEND CPACK_COMPONENTS_ALL ${component})
  string(TOUPPER ${component} upper)
  set(package ${CPACK_DEBIAN_${upper}_PACKAGE_NAME})
  install(FILES copyright ${CMAKE_CURRENT_BINARY_DIR}/changelog.Debian.gz ${CMAKE_CURRENT_BINARY_DIR}/changelog.gz
    DESTINATION ${CMAKE_INSTALL_DATADIR}/doc/${package} COMPONENT ${component})
  install(FILES lintian-overrides RENAME ${package} DESTINATION ${CMAKE_INSTALL_DATADIR}/lintian/overrides COMPONENT ${component})
endforeach()
include(CPack)
