#include "core/output/lining_csv.hpp"

#include "core/output/atomic_file.hpp"
#include "text/csv_table.hpp"

namespace voussoir {

std::string lining_csv(const std::vector<LiningRow>& rows) {
  std::string text = csv_line({"stage", "lining", "node", "x_m", "y_m", "ux_m", "uy_m", "thrust_N", "shear_N",
                               "moment_Nm", "smoothed_moment_Nm", "pressure_Pa", "shear_stress_Pa", "body", "use"}) +
                     "\n";
  for (const LiningRow& r : rows) {
    std::vector<std::string> cells{std::to_string(r.stage), r.lining, std::to_string(r.node)};
    for (const double x : {r.x, r.y, r.ux, r.uy, r.forces.thrust, r.forces.shear, r.forces.moment})
      cells.push_back(csv_cell(x));
    cells.push_back(r.smoothed_moment ? csv_cell(*r.smoothed_moment) : "");
    cells.push_back(csv_cell(r.pressure));
    cells.push_back(csv_cell(r.shear));
    cells.push_back(r.rock < 0 ? "" : std::to_string(r.rock));
    cells.push_back(r.use ? csv_cell(*r.use) : "");
    text += csv_line(cells) + "\n";
  }
  return text;
}

void write_lining_csv(const std::filesystem::path& path, const std::vector<LiningRow>& rows) {
  write_file(path, lining_csv(rows));
}

}  // namespace voussoir
