// The numerical choices that a scene gets if it states none: the only table behind `preset` in a scene. The preset
// "standard" sets these keys; "thesis" sets none of them, so that all have the defaults of the key table, with which
// the cases are verified.
#pragma once

#include <array>
#include <string_view>
#include <variant>

namespace voussoir {

inline constexpr std::string_view standard_preset = "standard", thesis_preset = "thesis";
inline constexpr std::array<std::string_view, 2> presets{standard_preset, thesis_preset};

// the tables of a scene that a setting of the preset applies to
enum class PresetScope {
  everywhere,
  integrable_faces,   // a joint has constant stiffness per area and constant friction, and contacts are not stated
  faces_by_points,    // joint_properties that cannot be integrated, in such a scene
  bonded_joints,      // joint_properties with tension or cohesion that are not of a lining's interface
  watched_searches,   // bisections without a stated failure displacement
  scenes_with_these,  // scenes with such a search
  searches_by_steps,  // searches that the required strength does not judge
  motions             // searches at a rate
};

// A value that the preset sets if the scene does not state the key.
struct PresetSetting {
  std::string_view table, key;  // of a scene; table "": the top
  std::variant<std::string_view, int> value;
  PresetScope scope;
};

inline constexpr PresetSetting standard_settings[] = {
    // confirmed by relaxation, which takes over what Newton's method cannot follow
    {"", "statics", "newton", PresetScope::everywhere},
    {"stage", "statics", "adaptive", PresetScope::motions},
    // slip within an increment follows its chord; the required strength chooses increments by itself
    {"stage", "static_increments", 16, PresetScope::searches_by_steps},
    // one point a face resists neither spin nor rocking
    {"contact", "face", "integrated", PresetScope::integrable_faces},
    {"joint_properties", "sub_contacts", 4, PresetScope::faces_by_points},
    // limit equilibrium's assumption, on which the trade's factors of safety rest; brittle bonds depend on stiffness
    {"joint_properties", "cohesion_law", "plastic", PresetScope::bonded_joints},
    // what is stated acts, in every command
    {"joint_properties", "bonds", "as_sliced", PresetScope::bonded_joints},
    // the loss of equilibrium itself, not a displacement
    {"stage", "failure_criterion", "required_strength", PresetScope::watched_searches},
    // one more search, with stiffer joints: what is left of the error of sliding blocks is in proportion to 1/kn
    {"accuracy", "error_bar", "stiffness", PresetScope::scenes_with_these},
};

}  // namespace voussoir
