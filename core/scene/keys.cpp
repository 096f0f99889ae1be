#include "core/scene/keys.hpp"

#include <map>

#include "core/scene/keys/supports.hpp"

namespace voussoir {
namespace {

// completes a row from its member
KeyRow completed(KeyRow row) {
  if (row.members.empty()) return row;
  const KeyMember& member = row.members.front();
  row.type = member.type;
  row.choices = member.choices;
  row.holds = member.holds;
  if (!row.required && !row.no_default) row.default_value = member.default_value;
  return row;
}

std::vector<KeyRow> all_rows() {
  using namespace keys;
  std::vector<KeyTable> tables{
      top_keys(),          domain_keys(),       box_keys(),      domain_plane_keys(),   joint_keys(),
      excavation_keys(),   region_keys(),       cylinder_keys(), joint_property_keys(), block_keys(),
      block_plane_keys(),  copies_keys(),       label_keys(),    selector_keys(),       restrain_keys(),
      motion_keys(),       accuracy_keys(),     contact_keys(),  damping_keys(),        time_keys(),
      equilibrium_keys(),  slicing_keys(),      stage_keys(),    stage_run_keys(),      stage_reduce_keys(),
      stage_change_keys(), stage_statics_keys()};
  for (KeyTable& table : stage_load_keys())
    tables.push_back(std::move(table));
  for (KeyTable& table : water_keys())
    tables.push_back(std::move(table));
  for (KeyTable& table : support_keys())
    tables.push_back(std::move(table));
  for (KeyTable& table :
       std::vector<KeyTable>{excavation_forces_keys(), stage_friction_keys(), move_keys(), record_keys(),
                             samples_keys(), monitor_keys(), output_keys(), joint_set_keys()})
    tables.push_back(std::move(table));
  std::vector<KeyRow> all;
  for (const KeyTable& table : tables)
    for (KeyRow row : table.rows) {
      row.table = table.name;
      all.push_back(completed(std::move(row)));
    }
  return all;
}

}  // namespace

std::span<const KeyRow> key_rows() {
  static const std::vector<KeyRow> all = all_rows();
  return all;
}

std::span<const KeyRow> key_rows(std::string_view group) {
  static const std::map<std::string_view, std::span<const KeyRow>> groups = [] {
    std::map<std::string_view, std::span<const KeyRow>> found;
    for (const KeyRow& row : key_rows()) {
      std::span<const KeyRow>& rows = found[row.table];
      rows = {rows.empty() ? &row : rows.data(), rows.size() + 1};  // rows of one key are contiguous
    }
    return found;
  }();
  const auto at = groups.find(group);
  return at == groups.end() ? std::span<const KeyRow>() : at->second;
}

void read_keys(const Node& table, std::string_view group, const std::type_info& type, void* owner) {
  for (const KeyRow& row : key_rows(group)) {
    const Node* value = table.find(row.key);
    for (const KeyMember& member : row.members)
      if (value && *member.owner == type) member.take(*value, owner);
  }
}

}  // namespace voussoir
