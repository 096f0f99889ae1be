#include "core/output/bolts_csv.hpp"

#include <fmt/format.h>

#include "core/output/atomic_file.hpp"
#include "text/csv_table.hpp"

namespace voussoir {

std::string bolts_csv(const std::vector<BoltRow>& rows) {
  std::string text = csv_line({"stage", "bolts", "bolt", "joint", "x_m", "y_m", "z_m", "body_a", "body_b", "force_N",
                               "shear_N", "extension_m", "plastic_m", "use", "broken", "slip_m"}) +
                     "\n";
  for (const BoltRow& r : rows) {
    std::vector<std::string> cells{std::to_string(r.stage), r.bolts, std::to_string(r.bolt), std::to_string(r.joint)};
    for (const double x : {r.x, r.y, r.z})
      cells.push_back(csv_cell(x));
    cells.push_back(std::to_string(r.body_a));
    cells.push_back(std::to_string(r.body_b));
    for (const double x : {r.force, r.shear, r.extension, r.plastic})
      cells.push_back(csv_cell(x));
    cells.push_back(r.use ? csv_cell(*r.use) : "");
    cells.push_back(r.broken ? "1" : "0");
    cells.push_back(r.slip ? csv_cell(*r.slip) : "");
    text += csv_line(cells) + "\n";
  }
  return text;
}

void write_bolts_csv(const std::filesystem::path& path, const std::vector<BoltRow>& rows) {
  write_file(path, bolts_csv(rows));
}

}  // namespace voussoir
