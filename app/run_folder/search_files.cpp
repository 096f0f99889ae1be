#include "app/run_folder/search_files.hpp"

#include "core/output/atomic_file.hpp"
#include "core/output/search_csv.hpp"

namespace voussoir {

void write_search(const std::filesystem::path& folder, const Results& results) {
  if (const std::string table = search_csv(results.trials); !table.empty()) write_file(folder / search_table, table);
}

}  // namespace voussoir
