// Which contacts are integrated face contacts (integrated_contact.hpp).
#pragma once

#include "core/base/settings.hpp"
#include "core/joint_laws/joint_properties.hpp"

namespace voussoir {

// joints that can be integrated: constant stiffness per area, constant friction, no bond
inline bool can_be_integrated(const JointProperties& properties) {
  return !properties.constant_stiffness && properties.laws.is_plain();
}

inline bool is_integrated(const ContactSettings& settings, const JointProperties& properties) {
  return settings.face == ContactFace::integrated && can_be_integrated(properties);
}

}  // namespace voussoir
