#include "app/run/run_derivative_table.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "app/derivatives/derivative_files.hpp"
#include "app/run_folder/results_hash.hpp"
#include "core/base/bad_input.hpp"
#include "core/geometry/plunge_trend.hpp"
#include "core/output/atomic_file.hpp"
#include "core/output/monitor.hpp"
#include "core/run/run_derivatives.hpp"
#include "core/scene/scene.hpp"
#include "core/scene/scene_error.hpp"
#include "text/angle.hpp"
#include "text/plain_text.hpp"
#include "text/read_file.hpp"

namespace voussoir {
namespace {

// steps of the twins, over a radian, the blocks' size, or the value: near a collapse little is between two trials
constexpr double step_at_rest = 1e-5, step_in_search = 1e-7;

// of the answer, by the usual change: twins do not see less
constexpr double seen_by_twins = 1e-7;

bool is_search(const StagePlan& stage) {
  return std::holds_alternative<ReducePlan>(stage.plan);
}

// m: the smallest free block
template <int Dim>
double smallest_block(const Model<Dim>& model) {
  double size = 0;
  for (const Body<Dim>& body : model.bodies)
    if (!body.fixed && (size == 0 || body.size < size)) size = body.size;
  return size > 0 ? size : 1;
}

double step_of_key(const MovingKey& key, double relative, double size) {
  switch (key.scale) {
    case KeyScale::angle:
      return relative / degree;
    case KeyScale::length:
      return relative * size;
    case KeyScale::share:
      break;
  }
  return relative * std::abs(key.value);
}

// With which the collapse begins, of each free block; down, and as long as the farthest goes 1. The rows of `motion`
// are those of the free blocks.
template <int Dim>
struct CollapseMotion {
  std::vector<BlockAtCollapse> blocks;
  int first = -1;  // the block that moves most
  Vector<Dim> way = Vector<Dim>::Zero();
};
template <int Dim>
CollapseMotion<Dim> motion_at_collapse(const Model<Dim>& model, const CriticalDerivatives& critical) {
  constexpr int F = freedoms<Dim>, S = spin_freedoms<Dim>;
  CollapseMotion<Dim> found;
  const auto each_free = [&](const auto& look) {
    int row = 0;
    for (std::size_t b = 0; b < model.bodies.size(); ++b)
      if (!model.bodies[b].fixed && model.bodies[b].present) look(static_cast<int>(b), std::exchange(row, row + F));
  };
  each_free([&](int b, int row) {
    const Vector<Dim> own = critical.motion.template segment<Dim>(row);
    if (own.norm() > found.way.norm()) {
      found.way = own;
      found.first = b;
    }
  });
  if (found.first < 0) return found;
  const double size = (found.way.dot(model.gravity) < 0 ? -1 : 1) * found.way.norm();
  found.way /= size;
  each_free([&](int b, int row) {
    const Vector<Dim> own = critical.motion.template segment<Dim>(row) / size;
    const Spin<Dim> turn = critical.motion.template segment<S>(row + Dim) / size;
    found.blocks.push_back({label_of(model, b), {own.begin(), own.end()}, {turn.begin(), turn.end()}});
  });
  return found;
}

// the block that moves most as the collapse begins, and where to; the failed trial's motion if it is of other blocks
template <int Dim>
std::string motion_words(const Model<Dim>& model, const CriticalDerivatives& critical,
                         const CollapseMotion<Dim>& motion, const FailureMechanism& of_trial) {
  if (motion.first < 0) return "no block moves";
  const auto [plunge, trend] = plunge_and_trend<Dim>(motion.way);
  const std::vector<int> failed = of_trial.bodies();
  return fmt::format("{} moves first, {:.1f}/{:.1f} (plunge/trend){}{}", label_of(model, motion.first), plunge, trend,
                     critical.near_collapse ? "" : "; one of its joints still sticks: the derivatives are rough",
                     failed.empty() || std::ranges::count(failed, motion.first)
                         ? ""
                         : "; in the failed trial " + sentence_of(of_trial));
}

// which of the monitored values; a name that is none throws
std::size_t place_of_answer(const std::vector<Column>& columns, const std::string& of) {
  std::vector<std::string> names;
  for (const Column& column : columns)
    names.push_back(column.name);
  const auto found =
      of.empty() ? std::ranges::find_if(names, [](const std::string& n) { return n.find("displacement") != n.npos; })
                 : std::ranges::find(names, of);
  if (found != names.end()) return static_cast<std::size_t>(found - names.begin());
  if (of.empty()) throw BadInput("--derivatives: the last stage is no search, and no monitor follows a displacement");
  throw BadInput(fmt::format("--derivatives-of {}: no monitored value has this name; {}", one_line(of, 60),
                             suggestion(of, names)));
}

DerivativeRow row_of_key(const MovingKey& key, const RunDerivative& found, double unit) {
  DerivativeRow row{.key = key};
  row.refused = !found.reason.empty();
  if (row.refused) {
    row.remark = "no derivative; " + one_line(found.reason, 100);
    return row;
  }
  row.derivative.value = unit * found.value;
  row.derivative.bar = unit * found.bar;
  row.change = *row.derivative.value * key.usual;
  return row;
}

template <int Dim>
DerivativeTable table_of_twins(const Scene& scene, const Prepared<Dim>& prepared, const std::string& of) {
  const bool search = of.empty() && is_search(prepared.stages.back());
  const std::vector<Column> columns = monitor_columns<Dim>(prepared.monitors);
  const std::size_t place = search ? 0 : place_of_answer(columns, of);
  DerivativeTable table;
  table.base.reason = not_differentiable(prepared);
  if (!search && is_search(prepared.stages.back()))
    table.base.reason = "the last stage is a search: derivatives are those of what it finds";
  if (!table.base.reason.empty()) return table;

  std::vector<MovingKey> keys;
  std::vector<TwinScenes<Dim>> numbers;
  const double size = smallest_block(prepared.model);
  for (MovingKey& key : moving_keys(*scene.tree, MovedAnswer::run)) {
    const double step = step_of_key(key, search ? step_in_search : step_at_rest, size);
    const auto refuse = [&](const std::string& reason) {
      table.rows.push_back(row_of_key(key, {.reason = reason}, 1));
    };
    if (key.below < step || key.above < step) {
      refuse("its range ends here");
      continue;
    }
    try {
      const auto at = [&](double distance) {
        return std::get<Prepared<Dim>>(load_changed(scene, key.overrides(distance)).prepared);
      };
      numbers.push_back({at(-step), at(step), step});
      keys.push_back(std::move(key));
    } catch (const SceneError& error) {
      refuse(error.what());
    } catch (const BadInput& error) {
      refuse(error.what());
    }
  }

  Progress<Dim> progress;
  const AnswersAtRest<Dim> answers = [&](const Prepared<Dim>& of_scene, const Model<Dim>& model,
                                         const State<Dim>& state) {
    return std::vector<double>{columns.empty() ? 0 : monitor_values<Dim>(of_scene.monitors, model, state)[place]};
  };
  const RunDerivatives found = run_with_derivatives<Dim>(prepared, numbers, answers, progress);
  table.answers = static_cast<int>(2 * numbers.size());
  table.base.reason = found.reason;
  if (!found.reason.empty()) return table;
  const bool factor = search && std::get<ReducePlan>(prepared.stages.back().plan).searched == Searched::factor;
  const std::string name = !search ? columns[place].name : factor ? "factor_of_safety" : "critical_friction";
  const Value* value = progress.results.find(name);
  if (!value) {
    table.base.reason = "the run has no " + name;
    return table;
  }
  table.answer.name = name;
  table.answer.unit = value->unit;
  table.answer.bar = value->error_bar.value_or(0);
  table.base.value = value->value;
  table.base.words = "at rest";
  if (search) {
    CollapseMotion<Dim> motion = motion_at_collapse(prepared.model, *found.critical);
    const std::vector<StableState>& states = progress.results.at_last_stable_state;
    const std::optional<TrialRow> failed = states.empty() ? std::nullopt : states.back().failed;
    table.base.words =
        motion_words(prepared.model, *found.critical, motion, failed ? failed->mechanism : FailureMechanism{});
    table.motion = std::move(motion.blocks);
    for (const TangentOfTrial& trial : found.critical->way)
      table.way.push_back({factor ? trial.level : trial.level / degree, trial.smallest, trial.second});
  }

  for (std::size_t n = 0; n < keys.size(); ++n) {
    DerivativeRow row =
        row_of_key(keys[n], search ? found.critical->by[n] : found.at_rest[n][0], search && !factor ? 1 / degree : 1);
    const bool still = !row.refused && (std::abs(row.change) <= seen_by_twins * std::abs(value->value) ||
                                        std::abs(*row.derivative.value) <= row.derivative.bar);
    if (!still)
      table.rows.push_back(std::move(row));
    else
      table.still.push_back(row.key.key);
  }
  sort_rows(table);
  return table;
}

}  // namespace

void require_answer(const LoadedScene& scene, const std::string& of) {
  const auto require = [&]<int Dim>(const Prepared<Dim>& prepared) {
    if (!of.empty() || prepared.stages.empty() || !is_search(prepared.stages.back()))
      place_of_answer(monitor_columns<Dim>(prepared.monitors), of);
  };
  std::visit(require, scene.prepared);
}

DerivativeTable run_derivatives(const LoadedScene& scene, const std::string& of) {
  return std::visit([&](const auto& prepared) { return table_of_twins(*scene.stated, prepared, of); }, scene.prepared);
}

void add_run_derivatives(const LoadedScene& scene, const std::string& of, const std::filesystem::path& folder,
                         bool quiet) {
  const DerivativeTable table = run_derivatives(scene, of);
  write_derivatives(table, folder);
  write_results(folder, with_derivatives(read_file(folder / "results.json", largest_results), table));
  if (!quiet) fmt::print("{}", derivatives_text(table));
}

}  // namespace voussoir
