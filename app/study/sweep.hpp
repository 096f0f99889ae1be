// The variations of a study: settings of scenes, one at a time, in all combinations, or at random.
#pragma once

#include <cmath>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "app/study/drawn_keys.hpp"

namespace voussoir {

// a command of the program that takes no steps: limit, blocks
struct OtherCommand {
  std::string name;
  std::vector<std::string> options;
};

// a key that changes with that of its sweep
struct TiedKey {
  std::string key;
  std::vector<std::string> values;  // one for each of the sweep's
  std::string unit = {};
};

// undecided: the error bar of the result contains the limit
enum class RowVerdict { stands, fails, undecided };

// the results that count as failed
struct Fails {
  bool below = true;  // the limit; false: above it
  double limit = 0;

  // A search's bracket is its result's error bar: if it contains the limit, the search has found neither a stable nor a
  // failed state on the side that decides.
  RowVerdict verdict(double result, std::optional<double> error_bar) const {
    if (error_bar && std::abs(result - limit) <= *error_bar) return RowVerdict::undecided;
    return (below ? result < limit : result > limit) ? RowVerdict::fails : RowVerdict::stands;
  }
};

// one_key: several values of one key, and of keys tied to it; grid and sample: `with` contains all keys, `values` only
// name the runs; reliability: there are no planned runs, and `with` has some values of the keys
enum class Varied { one_key, grid, sample, reliability };

// form: the design point and its first-order probability alone
enum class ReliabilityMethod { importance, form };

struct ReliabilityPlan {
  ReliabilityMethod method = ReliabilityMethod::importance;
  double target = 0.1;    // standard error over probability at which sampling ends
  int most_rows = 20000;  // of importance sampling
};

// one key, several values
struct Sweep {
  Varied varied = Varied::one_key;
  std::string name = {};
  std::string key = {};                             // as after --set; empty: the scene as it is
  std::vector<std::string> values = {};             // as after --set key=
  std::vector<std::optional<double>> numbers = {};  // the same if they are numbers
  std::vector<TiedKey> with = {};
  std::string unit = {};  // of the values; may be empty
  std::filesystem::path scene = {};
  std::vector<std::string> overrides = {};  // key=value, for every run of this sweep; the plan's own first
  std::optional<double> power = {};         // fit result against value^power and extrapolate to value 0
  std::vector<std::size_t> counts = {};     // of a grid: the number of values of each key
  std::optional<Fails> fails = {};
  std::optional<OtherCommand> other = {};  // instead of `voussoir run`
  std::optional<DrawnKeys> drawn = {};     // of a sample or a reliability analysis
  std::optional<ReliabilityPlan> reliability = {};

  // Rows of block theory take microseconds: they are drawn and judged when a study is gathered, without runs of their
  // own. `values` is empty, and `with` has the first rows only.
  bool is_drawn_in_process() const { return varied == Varied::sample && other && other->name == "blocks"; }
};

enum class Take { largest, smallest, last };

// a number from a column of history.csv
struct HistoryQuantity {
  std::string column;
  Take take = Take::last;
  std::string unit;
};

struct StudyPlan {
  std::string quantity;                    // a name in the values of results.json
  std::optional<HistoryQuantity> history;  // the source of this name, if not results.json
  std::string begin;                       // the stage at whose end runs begin, run once; empty: each at the start
  bool wide_brackets = false;              // a search that ended with a wider bracket than requested has a value, too
  std::vector<Sweep> sweeps;               // the first is the scene as it is, under the name "default"
};

// the overrides of the run at a place among the sweep's values, as after --set
std::vector<std::string> overrides_of(const Sweep& sweep, std::size_t place);

// a value as displayed: without the quotes that --set takes
std::string shown_value(const std::string& value);

// a column's name, "density (kg/m3)"
std::string with_unit(const std::string& name, const std::string& unit);

}  // namespace voussoir
