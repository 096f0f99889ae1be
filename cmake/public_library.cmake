# The libraries that users link, text and core: static, or shared with VOUSSOIR_SHARED.
include(GNUInstallDirs)
if(VOUSSOIR_SHARED)
  set(VOUSSOIR_LIBRARY_KIND SHARED)
  # installed programs find them from their own folder, so that any prefix works
  file(RELATIVE_PATH from_program ${CMAKE_INSTALL_FULL_BINDIR} ${CMAKE_INSTALL_FULL_LIBDIR})
  set(CMAKE_INSTALL_RPATH "$ORIGIN;$ORIGIN/${from_program}")
else()
  set(VOUSSOIR_LIBRARY_KIND STATIC)
endif()

# Inline functions of Eigen have the same names in a user's program, in which other flags may have vectorised or fused them.
# A shared library exports only what is Voussoir's; in the objects of a static one Eigen's names become local.
function(voussoir_public_library target)
  set(file "\$ENV{DESTDIR}\${CMAKE_INSTALL_PREFIX}/${CMAKE_INSTALL_LIBDIR}/$<TARGET_FILE_NAME:${target}>")
  if(VOUSSOIR_SHARED)
    set(exported ${PROJECT_SOURCE_DIR}/cmake/exported_symbols.txt)
    target_link_options(${target} PRIVATE -Wl,--version-script=${exported} -Wl,-Bsymbolic-functions -Wl,--no-undefined)
    # without a macro of its own it is linked from the objects of the static one
    set_target_properties(${target} PROPERTIES DEFINE_SYMBOL "" LINK_DEPENDS ${exported} VERSION ${PROJECT_VERSION}
      SOVERSION ${PROJECT_VERSION_MAJOR}.${PROJECT_VERSION_MINOR})  # another minor version may change layouts
    install(TARGETS ${target} EXPORT voussoir-targets
      LIBRARY DESTINATION ${CMAKE_INSTALL_LIBDIR} COMPONENT program NAMELINK_COMPONENT development)
  else()
    install(TARGETS ${target} EXPORT voussoir-targets ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR} COMPONENT development)
    if(target STREQUAL voussoir_core)
      install(CODE "execute_process(COMMAND \"${PROJECT_SOURCE_DIR}/cmake/private_symbols.sh\" \"${file}\"
        COMMAND_ERROR_IS_FATAL ANY)" COMPONENT development)
    endif()
  endif()
endfunction()
