// Which contacts are carried as a whole (pressed_face.hpp).
#pragma once

#include "core/law/joint_properties.hpp"
#include "core/settings.hpp"

namespace voussoir {

// what can be integrated: constant stiffness per area, constant friction, no bond
inline bool can_be_integrated(const JointProperties& properties) {
  return !properties.constant_stiffness && properties.laws.is_plain();
}

inline bool carried_whole(const ContactSettings& settings, const JointProperties& properties) {
  return settings.face == ContactFace::integrated && can_be_integrated(properties);
}

}  // namespace voussoir
