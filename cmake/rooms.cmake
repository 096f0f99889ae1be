# voussoir_compile_by_room(<target> ["<folder> <folder>…" …]): the sources of a folder, or of several that one argument
# names, are compiled as one, which reads headers and instantiates templates once for all of them: core and program then
# take a fraction of the time. So names at file scope must differ within such a group. Sources with their own options, as
# the contact kernel, are compiled separately, and so are all in the presets for development, in which a changed file
# compiles alone and shows missing includes.
if(CMAKE_BUILD_TYPE STREQUAL "Debug")
  set(by_room OFF)
else()
  set(by_room ON)
endif()
option(VOUSSOIR_BY_ROOM "compile the sources of a folder as one" ${by_room})

function(voussoir_compile_by_room target)
  if(NOT VOUSSOIR_BY_ROOM)
    return()
  endif()
  set_target_properties(${target} PROPERTIES UNITY_BUILD ON UNITY_BUILD_MODE GROUP)
  # a false warning about types in one of the sources, as if they were in a header
  target_compile_options(${target} PRIVATE $<$<CXX_COMPILER_ID:GNU>:-Wno-subobject-linkage>)
  get_target_property(sources ${target} SOURCES)
  foreach(group ${ARGN})
    string(REPLACE " " ";" folders ${group})
    list(GET folders 0 first)
    foreach(folder ${folders})
      set(group_of_${folder} ${first})
    endforeach()
  endforeach()
  foreach(source ${sources})
    cmake_path(ABSOLUTE_PATH source BASE_DIRECTORY ${CMAKE_CURRENT_SOURCE_DIR})
    cmake_path(GET source PARENT_PATH room)
    cmake_path(RELATIVE_PATH room BASE_DIRECTORY ${CMAKE_CURRENT_SOURCE_DIR})
    if(DEFINED group_of_${room})
      set(room ${group_of_${room}})
    endif()
    string(REPLACE "/" "_" room "${target}_${room}")
    set_source_files_properties(${source} PROPERTIES UNITY_GROUP ${room})
  endforeach()
endfunction()
