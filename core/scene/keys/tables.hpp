// The tables of a scene, one file each: keys, meanings and the members that receive the values. `keys.cpp` lists them
// in the order of the page.
#pragma once

#include "core/scene/keys/members.hpp"
#include "core/scene/keys/ranges.hpp"

namespace voussoir::keys {

using enum KeyType;

// the rows of one group of keys, or some of them
struct KeyTable {
  std::string_view name;  // of the group
  std::vector<KeyRow> rows;
};

KeyTable top_keys();
KeyTable domain_keys();
KeyTable box_keys();
KeyTable domain_plane_keys();
KeyTable joint_keys();
KeyTable excavation_keys();
KeyTable region_keys();
KeyTable cylinder_keys();
KeyTable joint_property_keys();
KeyTable block_keys();
KeyTable block_plane_keys();
KeyTable label_keys();
KeyTable selector_keys();
KeyTable restrain_keys();
KeyTable motion_keys();
KeyTable accuracy_keys();
KeyTable contact_keys();
KeyTable copies_keys();
std::vector<KeyRow> statics_rows();  // of a scene
KeyTable damping_keys();
KeyTable time_keys();
KeyTable equilibrium_keys();
KeyTable slicing_keys();
KeyTable stage_keys();
KeyTable stage_run_keys();
KeyTable stage_reduce_keys();
KeyTable stage_change_keys();
KeyTable stage_statics_keys();
KeyTable excavation_forces_keys();
KeyTable stage_friction_keys();
KeyTable move_keys();
KeyTable record_keys();
KeyTable samples_keys();
std::vector<KeyTable> stage_load_keys();
std::vector<KeyTable> water_keys();
std::vector<KeyTable> bolt_keys();
KeyTable lining_keys();
KeyTable monitor_keys();
KeyTable output_keys();
KeyTable joint_set_keys();

}  // namespace voussoir::keys
