#include "core/output/history_csv.hpp"

#include "core/output/atomic_file.hpp"
#include "text/csv_table.hpp"

namespace voussoir {
std::string history_csv(const History& history) {
  std::string text = csv_line(history.columns) + "\n";
  for (const std::vector<double>& row : history.rows) {
    for (std::size_t k = 0; k < row.size(); ++k)
      text += (k > 0 ? "," : "") + csv_cell(row[k]);
    text += '\n';
  }
  return text;
}

void write_history_csv(const std::filesystem::path& path, const History& history) {
  write_file(path, history_csv(history));
}

}  // namespace voussoir
