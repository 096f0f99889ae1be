// Reads the input of slicing: domain, joints and excavations.
#pragma once

#include "core/scene/scene_spec.hpp"

namespace voussoir {

BoxSpec read_box(const Subject& subject);
std::optional<DomainSpec> read_domain(const Subject& scene, int dimension);
std::vector<JointSpec> read_joints(const Subject& scene, int dimension);
RegionSpec read_region(const Subject& subject, int dimension);
std::vector<ExcavationSpec> read_excavations(const Subject& scene, int dimension);

}  // namespace voussoir
