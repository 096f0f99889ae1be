#include "core/output/support_table.hpp"

#include "core/output/atomic_file.hpp"

namespace voussoir {

std::vector<std::string> support_table_files() {
  std::vector<std::string> files;
  for (const OutputSupport<2>& row : output_supports<2>)
    if (row.table) files.push_back(row.table);
  return files;
}

void write_support_tables(const std::filesystem::path& folder, const Results& results) {
  for (const OutputSupport<2>& row : output_supports<2>)
    if (const std::string text = row.csv ? row.csv(results) : ""; !text.empty()) write_file(folder / row.table, text);
}

}  // namespace voussoir
