#include "app/study/key_table.hpp"

#include <algorithm>
#include <iterator>
#include <string>

namespace voussoir {
namespace study_rows {

using enum StudyValue;

// clang-format off
constexpr StudyKey all[] = {
    {.key = "scene", .type = text, .required = true, .meaning = "the scene's file, relative to the study"},
    {.key = "quantity", .type = text, .required = true,
     .meaning = "a value of results.json, e.g. `\"critical_friction\"`; with `history` the name of the quantity taken"},
    {.key = "history", .type = table, .meaning = "takes the quantity from a column of history.csv instead"},
    {.key = "set", .type = texts, .meaning = "`\"key=value\"` as after --set, for every run"},
    {.key = "limit", .type = table,
     .meaning = "runs by `voussoir limit` instead of `voussoir run`; `{}` for the critical friction under gravity"},
    {.key = "blocks", .type = table,
     .meaning = "runs by `voussoir blocks`, in space or in the plane: `quantity` is `least_factor`, `volume_below_1`, "
         "`blocks_below_1` or `least_critical_coefficient`"},
    {.key = "begin", .type = text,
     .meaning = "a stage of the scene: runs that are the same up to its end begin with the last state of one shared run, which "
         "the study makes first"},
    {.key = "sweep", .type = tables, .meaning = "one setting that is changed, `[[sweep]]`; any number"},
    {.key = "grid", .type = tables, .meaning = "all combinations of the values of two or three keys, `[[grid]]`: a table and a map"},
    {.key = "sample", .type = tables,
     .meaning = "runs whose keys are drawn at random, `[[sample]]`: mean, deviation, histogram and fraction failed"},
    {.key = "reliability", .type = tables,
     .meaning = "reliability analyses, `[[reliability]]`: design points by FORM, and small probabilities by importance "
         "sampling, from some hundred answers"},
    {.table = "history", .key = "column", .type = text, .required = true, .meaning = "a column of history.csv, by its full name"},
    {.table = "history", .key = "take", .type = choice, .required = true, .words = "largest|smallest|last",
     .meaning = "which of its numbers"},
    {.table = "history", .key = "unit", .type = text, .required = true, .meaning = "of that number, e.g. `\"N\"`"},
    {.table = "sweep", .key = "name", .type = text, .required = true, .meaning = "in the table and the figure"},
    {.table = "sweep", .key = "key", .type = text, .required = true,
     .meaning = "key of the scene as after --set, e.g. `\"time.fraction\"`"},
    {.table = "sweep", .key = "values", .type = values, .required = true, .meaning = "the values of the key, one run each"},
    {.table = "sweep", .key = "with", .type = tables, .meaning = "further keys that change together with `key`, value by value"},
    {.table = "sweep", .key = "unit", .type = text, .meaning = "of the values, e.g. `\"deg\"`"},
    {.table = "sweep", .key = "scene", .type = text, .meaning = "another scene for this sweep"},
    {.table = "sweep", .key = "set", .type = texts, .meaning = "`\"key=value\"` for every run of this sweep, after the study's own"},
    {.table = "sweep", .key = "extrapolate", .type = table,
     .meaning = "adds the result that each two neighbouring runs give at a value of 0, if the error is proportional to a power "
         "of the value"},
    {.table = "sweep", .key = "limit", .type = table,
     .meaning = "runs of this sweep by `voussoir limit`, instead of the study's own `limit`"},
    {.table = "sweep", .key = "blocks", .type = table, .meaning = "likewise by `voussoir blocks`"},
    {.table = "with", .key = "key", .type = text, .required = true, .meaning = "key of the scene as after --set"},
    {.table = "with", .key = "values", .type = values, .required = true, .meaning = "its values, one for each of the sweep's values"},
    {.table = "grid", .key = "name", .type = text, .required = true, .meaning = "in the table and the figure"},
    {.table = "grid", .key = "keys", .type = tables, .required = true,
     .meaning = "two or three, each a key with its values; the last changes fastest"},
    {.table = "grid", .key = "fails", .type = table,
     .meaning = "the results that count as failed; the map marks them, and with a ring those whose error bar contains the limit"},
    {.table = "grid", .key = "scene", .type = text, .meaning = "another scene for this grid"},
    {.table = "grid", .key = "set", .type = texts, .meaning = "`\"key=value\"` for every run of this grid, after the study's own"},
    {.table = "grid", .key = "limit", .type = table, .meaning = "as of a sweep"},
    {.table = "grid", .key = "blocks", .type = table, .meaning = "as of a sweep"},
    {.table = "grid.keys", .key = "key", .type = text, .required = true, .meaning = "key of the scene as after --set"},
    {.table = "grid.keys", .key = "values", .type = values, .required = true, .meaning = "its values, at least two"},
    {.table = "grid.keys", .key = "unit", .type = text, .meaning = "of the values"},
    {.table = "sample", .key = "name", .type = text, .required = true, .meaning = "in the table and the figure"},
    {.table = "sample", .key = "rows", .type = number, .required = true,
     .meaning = "number of runs, 2 to 100,000, with `blocks` to 5,000,000; the first of them are those of a smaller sample, but"
         " for a Latin hypercube"},
    {.table = "sample", .key = "method", .type = choice, .words = "random|latin",
     .meaning = "latin: a Latin hypercube, in which each key has one value in each of as many classes of equal probability as "
         "there are rows: closer means and deviations, hardly closer shares (default: random)"},
    {.table = "sample", .key = "correlation", .type = lists,
     .meaning = "`[[\"key\", \"key\", number]]`: Pearson's correlation of two keys' values (Nataf's model); other keys are "
         "independent"},
    {.table = "sample", .key = "seed", .type = number,
     .meaning = "another seed gives another sample; a value depends on seed, row and key only, so that samples of one seed can "
         "be compared row by row (default: 0)"},
    {.table = "sample", .key = "keys", .type = tables, .required = true, .meaning = "each a key with the distribution of its values"},
    {.table = "sample", .key = "fails", .type = table,
     .meaning = "the results that count as failed; reported: their fraction with its 95 % confidence interval, and the number "
         "of results whose error bar contains the limit, which are neither failed nor stable"},
    {.table = "sample", .key = "scene", .type = text, .meaning = "another scene for this sample"},
    {.table = "sample", .key = "set", .type = texts, .meaning = "`\"key=value\"` for every run of this sample, after the study's own"},
    {.table = "sample", .key = "limit", .type = table, .meaning = "as of a sweep"},
    {.table = "sample", .key = "blocks", .type = table, .meaning = "as of a sweep"},
    {.table = "sample.keys", .key = "key", .type = text, .required = true, .meaning = "key of the scene as after --set"},
    {.table = "sample.keys", .key = "law", .type = choice, .required = true, .words = "normal|lognormal|uniform|triangular|exponential|fisher|seed",
     .meaning = "fisher: of a joint's pole, `key` the joint, e.g. `\"joints.A\"`; seed: a whole number for the `seed` of a "
         "joint set"},
    {.table = "sample.keys", .key = "mean", .type = number,
     .meaning = "of a normal, lognormal or exponential distribution before it is cut: of the value itself, not of its logarithm"},
    {.table = "sample.keys", .key = "deviation", .type = number,
     .meaning = "of a normal or lognormal distribution: standard deviation of the value itself"},
    {.table = "sample.keys", .key = "mode", .type = number, .meaning = "of a triangular distribution: the most likely value"},
    {.table = "sample.keys", .key = "least", .type = number,
     .meaning = "of a uniform or triangular distribution its lower end; for the others values below it are drawn again"},
    {.table = "sample.keys", .key = "most", .type = number, .meaning = "likewise the upper end"},
    {.table = "sample.keys", .key = "dip", .type = number, .meaning = "of a Fisher distribution: dip of the mean plane, deg"},
    {.table = "sample.keys", .key = "dip_direction", .type = number, .meaning = "likewise its dip direction, deg"},
    {.table = "sample.keys", .key = "concentration", .type = number,
     .meaning = "Fisher's constant K; 0.63 of the poles lie within 81 deg/√K of the mean"},
    {.table = "sample.keys", .key = "per", .type = choice, .words = "property|set|joint",
     .meaning = "which joints share a draw of a friction angle or cohesion, with `blocks` (default: property, all of them)"},
    {.table = "sample.keys", .key = "unit", .type = text, .meaning = "of the value"},
    {.table = "reliability", .key = "name", .type = text, .required = true, .meaning = "in the results"},
    {.table = "reliability", .key = "keys", .type = tables, .required = true,
     .meaning = "each a key with the distribution of its values, as of a sample, but for the laws and `per` that have no order"},
    {.table = "reliability", .key = "correlation", .type = lists, .meaning = "as of a sample"},
    {.table = "reliability", .key = "fails", .type = table, .required = true, .meaning = "the results that count as failed"},
    {.table = "reliability", .key = "method", .type = choice, .words = "importance|form",
     .meaning = "form: the design point and its first-order probability alone, not checked (default: importance)"},
    {.table = "reliability", .key = "target", .type = number,
     .meaning = "standard error over probability at which importance sampling ends, 0.001 to 1 (default: 0.1)"},
    {.table = "reliability", .key = "most_rows", .type = number, .meaning = "of importance sampling (default: 20,000)"},
    {.table = "reliability", .key = "seed", .type = number, .meaning = "as of a sample"},
    {.table = "reliability", .key = "scene", .type = text, .meaning = "another scene for this analysis"},
    {.table = "reliability", .key = "set", .type = texts, .meaning = "`\"key=value\"` for every answer, after the study's own"},
    {.table = "reliability", .key = "limit", .type = table, .meaning = "as of a sweep"},
    {.table = "reliability", .key = "blocks", .type = table, .meaning = "as of a sweep: answers in microseconds, without files"},
    {.table = "fails", .key = "below", .type = number, .meaning = "results below it count as failed, e.g. 1 for a factor of safety"},
    {.table = "fails", .key = "above", .type = number, .meaning = "results above it count as failed; state this or below"},
    {.table = "extrapolate", .key = "power", .type = number, .required = true,
     .meaning = "the power, above 0, at most 10; 0.6666667 for a rate of reduction"},
    {.table = "limit", .key = "load", .type = choice_or_text, .words = "gravity|applied|left|right|east|west|north|south|up|down", .otherwise = ", or a direction such as `\"1,0,-0.5\"`",
     .meaning = "as after `voussoir limit --load`"},
    {.table = "limit", .key = "friction", .type = texts, .meaning = "names as after `--friction`"},
    {.table = "limit", .key = "factor", .type = boolean, .meaning = "`--factor`"},
    {.table = "limit", .key = "joint", .type = texts, .meaning = "names as after `--joint`"},
    {.table = "limit", .key = "cohesion", .type = boolean, .meaning = "`--cohesion`"},
    {.table = "limit", .key = "with_dilation", .type = boolean,
     .meaning = "`--with-dilation`: the bound alone. Without it the quantities are `…_least` and `…_largest`, and the plain "
         "name where they agree to 1 %"},
    {.table = "limit", .key = "decide", .type = boolean, .meaning = "`--decide`: the plain name holds what runs on elastic joints find"},
    {.table = "blocks", .key = "strength_of", .type = text, .meaning = "as after `voussoir blocks --strength-of`"},
    {.table = "blocks", .key = "after", .type = text, .meaning = "`--after`"},
    {.table = "blocks", .key = "seismic", .type = text, .meaning = "`--seismic`"},
};
// clang-format on

}  // namespace study_rows

std::span<const StudyKey> study_keys() {
  return study_rows::all;
}

std::string_view tables_at(const StudyKey& key) {
  // the keys of an analysis are those of a sample
  const std::string_view table = key.table == "reliability" ? "sample" : key.table;
  const std::string within = std::string(table) + '.' + std::string(key.key);
  for (const std::string& name : {within, std::string(key.key)}) {
    const auto row = std::ranges::find(study_rows::all, std::string_view(name), &StudyKey::table);
    if (row != std::end(study_rows::all)) return row->table;
  }
  return {};
}

}  // namespace voussoir
