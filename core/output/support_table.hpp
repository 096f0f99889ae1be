// Output of supports, a row for each kind: tables, frames, monitors.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "core/model/supports_state.hpp"
#include "core/output/bolt_output.hpp"
#include "core/output/lining_output.hpp"

namespace voussoir {

// A kind without entries is output by another row.
template <int Dim>
struct OutputSupport {
  SupportKind kind;
  // its table, and its rows: the forces of each at the end of a stage, counted from 1; the text is empty without rows
  const char* table = nullptr;
  void (*add_rows)(const Model<Dim>&, const State<Dim>&, int stage, Results&) = nullptr;
  std::string (*csv)(const Results&) = nullptr;
  // Numbers the installed supports by this model, which may have more: by the rows of the stage that ended last.
  // Returns a mismatch as the end of a sentence about the other run; empty: none.
  std::string (*find_again)(const Model<Dim>&, int stages, const Results&, State<Dim>&) = nullptr;
  // frames: the word in the names of their files, whether the model has any, their drawing, and what the viewer shows
  // of a line
  const char* frames = nullptr;
  bool (*has)(const Model<Dim>&) = nullptr;
  PolyData (*lines)(const Model<Dim>&, const State<Dim>&, double time) = nullptr;
  ViewLine (*view)(const Model<Dim>&, const PolyData& lines, std::size_t line) = nullptr;
  // quantities of their monitors
  std::optional<Quantity> quantity = {};
  void (*add_columns)(const Monitor&, const AddColumn&) = nullptr;
  void (*add_values)(const Monitor&, const Model<Dim>&, const State<Dim>&, std::vector<double>&) = nullptr;
};

template <int Dim>
constexpr OutputSupport<Dim> output_supports[] = {
    {.kind = SupportKind::bolt,
     .table = "bolts.csv",
     .add_rows = add_bolt_rows<Dim>,
     .csv = bolts_csv,
     .find_again = find_bolts_again<Dim>,
     .frames = "bolts",
     .has = [](const Model<Dim>& model) { return !model.bolts.empty(); },
     .lines = bolt_lines<Dim>,
     .view = bolt_view<Dim>,
     .quantity = Quantity::bolt_force,
     .add_columns = add_bolt_columns,
     .add_values = add_bolt_values<Dim>},
    {.kind = SupportKind::grouted_bolt},  // with the bolts
    {.kind = SupportKind::lining,
     .table = "lining.csv",
     .add_rows = add_lining_rows<Dim>,
     .csv = lining_csv,
     .find_again = find_linings_again<Dim>,
     .frames = "linings",
     .has = [](const Model<Dim>& model) { return !model.linings.empty(); },
     .lines = lining_lines<Dim>,
     .view = lining_view<Dim>,
     .quantity = Quantity::lining_force,
     .add_columns = add_lining_columns,
     .add_values = add_lining_values<Dim>},
};
static_assert(has_each_kind(output_supports<2>) && has_each_kind(output_supports<3>), "a row for each kind of support");

// names of all tables of supports
std::vector<std::string> support_table_files();

// tables that have rows; throws OutputError
void write_support_tables(const std::filesystem::path& folder, const Results& results);

}  // namespace voussoir
