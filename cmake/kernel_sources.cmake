# The sources of the contact kernel and of its blocks, for builds that contain nothing else: fuzz_contact and the
# kernel's probe by another compiler. Paths are absolute.
set(VOUSSOIR_KERNEL_SOURCES
  geometry/facet_weights.cpp geometry/half_space.cpp geometry/half_space_inl.cpp geometry/polytope.cpp geometry/surface.cpp geometry/types.cpp
  solvers/feasibility.cpp solvers/extended_precision_feasibility.cpp solvers/weighted_centre.cpp
  solvers/central_path.cpp
  slicing/block.cpp
  contact/narrow_phase.cpp contact/reference_kernel.cpp contact/bracketing.cpp contact/extended_precision_overlap.cpp
  contact/overlap_region.cpp contact/pair_geometry.cpp contact/kernel/kernel.cpp)
list(TRANSFORM VOUSSOIR_KERNEL_SOURCES PREPEND ${PROJECT_SOURCE_DIR}/core/)
