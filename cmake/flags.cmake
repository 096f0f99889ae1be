# voussoir_flags: the compiler flags of every target of this project.
# No contraction and no loop vectorisation: otherwise g++ 12 fuses multiply-adds, and the same scene must give the same bits
# with any compiler and optimisation level. Without errno, which nothing reads after arithmetic, a square root is one instruction
# and not a call; its bits are the same.
add_library(voussoir_flags INTERFACE)
target_compile_features(voussoir_flags INTERFACE cxx_std_20)
set(VOUSSOIR_ARITHMETIC -ffp-contract=off -fno-math-errno $<$<CXX_COMPILER_ID:GNU>:-fno-tree-vectorize>
  $<$<CXX_COMPILER_ID:Clang>:-fno-vectorize -fno-slp-vectorize -ffp-exception-behavior=maytrap>
  CACHE STRING "flags for the rounding of arithmetic; with any others bits differ; for measurements of their cost only")
mark_as_advanced(VOUSSOIR_ARITHMETIC)
target_compile_options(voussoir_flags INTERFACE -Wall -Wextra -Wshadow -Wno-psabi ${VOUSSOIR_ARITHMETIC})

set(VOUSSOIR_SANITIZE "" CACHE STRING "sanitizers to build with, e.g. address,undefined")
if(VOUSSOIR_SANITIZE)
  target_compile_options(voussoir_flags INTERFACE -fsanitize=${VOUSSOIR_SANITIZE} -fno-omit-frame-pointer -fno-sanitize-recover=undefined)
  target_link_options(voussoir_flags INTERFACE -fsanitize=${VOUSSOIR_SANITIZE})
endif()

# a hundred programs are linked: LLVM's linker takes a quarter of the seconds of GNU's, and keeps the same copies of functions
if(CMAKE_CXX_COMPILER_ID STREQUAL "Clang")
  find_program(VOUSSOIR_LLD ld.lld)
  mark_as_advanced(VOUSSOIR_LLD)
  if(VOUSSOIR_LLD)
    add_link_options(-fuse-ld=lld)
  endif()
endif()

# assertions state invariants and cost little: they stay on in the Release preset
string(REPLACE "-DNDEBUG" "" CMAKE_CXX_FLAGS_RELEASE "${CMAKE_CXX_FLAGS_RELEASE}")
string(REPLACE "-O3" "-O2" CMAKE_CXX_FLAGS_RELEASE "${CMAKE_CXX_FLAGS_RELEASE}")
