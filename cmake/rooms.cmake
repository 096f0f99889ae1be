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
option(VOUSSOIR_BY_ROOM "compile the sources of a folder, and those of a test program, as one" ${by_room})

# voussoir_compile_as_one(<target>): all sources of a program of tests, each of which has a namespace named as its file
function(voussoir_compile_as_one target)
  if(VOUSSOIR_BY_ROOM)
    set_target_properties(${target} PROPERTIES UNITY_BUILD ON UNITY_BUILD_BATCH_SIZE 0)
    # a false warning about types in one of the sources, as if they were in a header
    target_compile_options(${target} PRIVATE $<$<CXX_COMPILER_ID:GNU>:-Wno-subobject-linkage>)
  endif()
endfunction()

function(voussoir_compile_by_room target)
  if(NOT VOUSSOIR_BY_ROOM)
    return()
  endif()
  voussoir_compile_as_one(${target})
  set_target_properties(${target} PROPERTIES UNITY_BUILD_MODE GROUP)
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
