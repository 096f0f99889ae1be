#include "core/scene/keys.hpp"

#include "core/scene/keys/tables.hpp"

namespace voussoir {
namespace {

std::vector<KeyRow> all_rows() {
  std::vector<KeyTable> tables{
      top_keys(),         domain_keys(),  box_keys(),       domain_plane_keys(),   joint_keys(),
      excavation_keys(),  region_keys(),  cylinder_keys(),  joint_property_keys(), block_keys(),
      block_plane_keys(), label_keys(),   selector_keys(),  restrain_keys(),       motion_keys(),
      accuracy_keys(),    contact_keys(), damping_keys(),   time_keys(),           equilibrium_keys(),
      slicing_keys(),     stage_keys(),   stage_run_keys(), stage_reduce_keys(),   stage_change_keys()};
  for (KeyTable& table : stage_load_keys())
    tables.push_back(std::move(table));
  for (KeyTable& table : std::vector<KeyTable>{move_keys(), monitor_keys(), output_keys(), joint_set_keys()})
    tables.push_back(std::move(table));
  std::vector<KeyRow> all;
  for (const KeyTable& table : tables)
    for (KeyRow row : table.rows) {
      row.table = table.name;
      all.push_back(std::move(row));
    }
  return all;
}

}  // namespace

std::span<const KeyRow> key_rows() {
  static const std::vector<KeyRow> all = all_rows();
  return all;
}

}  // namespace voussoir
