#include "app/blocks/blocks_summary.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <map>

#include "app/blocks/verdict_words.hpp"
#include "text/angle.hpp"

namespace voussoir {
namespace {

constexpr double rounding_of_sums = 1e-12;
constexpr std::size_t most_listed = 8;  // blocks of a line of the table that are listed by number

template <int Dim>
const char* unit_of_volume() {
  return Dim == 3 ? "m3" : "m2";
}

// "1 block", "2 blocks"
std::string count_of(std::size_t count, const char* thing) {
  return fmt::format("{} {}{}", count, thing, count == 1 ? "" : "s");
}

// a line a class, with numbers and volumes
template <int Dim>
std::string classes(const Survey<Dim>& survey) {
  const std::array<const char*, 9> order{"enclosed",
                                         "tapered",
                                         "no load",
                                         "stable",
                                         "slides on one face",
                                         "slides on two faces",
                                         "slides along a line that more than two faces share",
                                         "falls",
                                         "lifts"};
  std::map<std::string, std::pair<long, double>> sums;
  for (const SurveyRow<Dim>& row : survey.rows) {
    auto& [blocks, volume] = sums[kind_label(row)];
    ++blocks;
    volume += row.volume;
  }
  const auto meaning = [](const std::string& label) {
    if (label == "tapered") return "  (IV: a free face, but no direction out)";
    if (label == "stable") return "  (III: without friction)";
    return "";
  };
  std::string text;
  const auto add = [&](const std::string& label) {
    const auto found = sums.find(label);
    if (found == sums.end()) return;
    text += fmt::format("  {:>7} {:>12.6g} {}  {}{}\n", found->second.first, found->second.second,
                        unit_of_volume<Dim>(), label, meaning(label));
  };
  for (const char* label : order)
    add(label);
  add("undecided");
  return text;
}

// blocks of the same sets of joints and the same factor are one line
template <int Dim>
std::string family_of(const Survey<Dim>& survey, const SurveyRow<Dim>& row) {
  std::vector<std::string> sets;
  for (int k = 0; k < row.bolted.verdict.loaded; ++k) {
    const RockFace<Dim>& face = row.faces[row.bolted.verdict.faces[k]];
    const int set = survey.sets.set_of(face.joint);
    sets.push_back(set < 0 ? survey.joint_name(face) : survey.sets.names[set]);
  }
  std::sort(sets.begin(), sets.end());
  return fmt::format("{}", fmt::join(sets, ", "));
}

// a line that several blocks share: their numbers, if they are few, and those that must turn
template <int Dim>
std::string members(const std::vector<const SurveyRow<Dim>*>& family) {
  std::vector<int> blocks;
  std::size_t turning = 0;
  for (const SurveyRow<Dim>* row : family) {
    blocks.push_back(row->bodies[0]);
    turning += row->eccentricity.value_or(0) > 1;
  }
  std::sort(blocks.begin(), blocks.end());
  std::string text = blocks.size() <= most_listed ? fmt::format("{}", fmt::join(blocks, ", ")) : "";
  if (turning > 0) text += fmt::format("{}{} of them turn", text.empty() ? "" : "; ", turning);
  return text;
}

template <int Dim>
std::string table_row(const Survey<Dim>& survey, const std::vector<const SurveyRow<Dim>*>& family) {
  const SurveyRow<Dim>& row = *family.front();
  const auto [smallest, largest] = std::minmax_element(
      family.begin(), family.end(), [](const auto* a, const auto* b) { return a->volume < b->volume; });
  const bool one = family.size() == 1;
  const std::string blocks = one ? survey.body_names(row) : fmt::format("{} blocks", family.size());
  const std::string volumes =
      one ? fmt::format("{:.4g}", row.volume) : fmt::format("{:.2g}-{:.2g}", (*smallest)->volume, (*largest)->volume);
  const std::string factor = row.bolted.factor ? fmt::format("{:.4f}", *row.bolted.factor) : "";
  return fmt::format(
      "  {:<10} {:>11}  {:<8} {:<26} {:>12} {:>8}  {:<22} {:>5}  {:>5}  {}", blocks, volumes, word_of(row.kind()),
      one ? joints_shown(survey, row) : family_of(survey, row), direction_shown<Dim>(row.bolted.verdict.motion), factor,
      one ? force_shown(row, "") : "", row.opening && one ? fmt::format("{:.1f}", to_degrees(*row.opening)) : "",
      row.eccentricity && one ? fmt::format("{:.2f}", *row.eccentricity) : "", one ? verdict_remarks(survey, row) : "");
}

std::string trimmed(std::string line) {
  line.erase(line.find_last_not_of(' ') + 1);
  return line + "\n";
}

template <int Dim>
std::string worst_rows(const Survey<Dim>& survey, int top) {
  std::vector<const SurveyRow<Dim>*> moving;
  for (const auto* list : {&survey.clusters, &survey.rows})
    for (const SurveyRow<Dim>& row : *list)
      if (moves(row.kind()) && row.bolted.factor) moving.push_back(&row);
  if (moving.empty()) return "no block moves without friction\n";
  std::stable_sort(moving.begin(), moving.end(),
                   [](const auto* a, const auto* b) { return *a->bolted.factor < *b->bolted.factor; });
  std::vector<std::vector<const SurveyRow<Dim>*>> families;
  std::map<std::string, std::size_t> places;
  for (const SurveyRow<Dim>* row : moving) {
    const std::string key = fmt::format("{} {} {:.6g} {}", row->cluster, family_of(survey, *row), *row->bolted.factor,
                                        direction_shown<Dim>(row->bolted.verdict.motion));
    const auto [place, first] = places.try_emplace(key, families.size());
    if (first)
      families.push_back({row});
    else
      families[place->second].push_back(row);
  }
  std::string text = trimmed(fmt::format(
      "  {:<10} {:>11}  {:<8} {:<26} {:>12} {:>8}  {:<22} {:>5}  {:>5}", "block",
      fmt::format("volume {}", unit_of_volume<Dim>()), "verdict", "on", Dim == 3 ? "plunge/trend" : "plunge", "factor",
      fmt::format("kN{} for {:g}", Dim == 3 ? "" : "/m", survey.request.required), "opens", "ecc."));
  const std::size_t shown = std::min<std::size_t>(families.size(), static_cast<std::size_t>(top));
  for (std::size_t f = 0; f < shown; ++f)
    text += trimmed(table_row(survey, families[f]));
  if (shown < families.size())
    text += fmt::format("  … {} more lines with higher factors: --top, blocks_verdicts.csv\n", families.size() - shown);
  return text;
}

// stable as they slide, but not as they turn
template <int Dim>
std::string turning_rows(const Survey<Dim>& survey) {
  std::vector<std::string> list;
  std::size_t count = 0;
  for (const auto* rows : {&survey.clusters, &survey.rows})
    for (const SurveyRow<Dim>& row : *rows) {
      if (row.kind() != BlockKind::stable || !row.factor_moments || *row.factor_moments >= survey.request.required)
        continue;
      if (++count <= most_listed)
        list.push_back(fmt::format("{} (at most {:.4g})", survey.body_names(row), *row.factor_moments));
    }
  if (count == 0) return "";
  return fmt::format("stable without friction as they slide, but with moments below {:g}: {}{}\n",
                     survey.request.required, fmt::join(list, ", "),
                     count > most_listed
                         ? fmt::format(" and {} more: factor_moments of blocks_verdicts.csv", count - most_listed)
                         : "");
}

template <int Dim>
std::string header(const Survey<Dim>& survey, const std::string& title) {
  std::vector<std::string> strengths;
  for (const JointProperties& joint : survey.assembly.model.properties)
    strengths.push_back(fmt::format("{} {:.4g} deg{}{}", joint.name, to_degrees(joint.friction),
                                    joint.follows_barton_bandis()
                                        ? fmt::format(" and roughness (JRC {:.3g}, JCS {:.4g} MPa)",
                                                      joint.barton_bandis.jrc, 1e-6 * joint.barton_bandis.jcs)
                                        : "",
                                    joint.cohesion > 0 ? fmt::format(" and {:.4g} kPa", joint.cohesion / 1000) : ""));
  bool water = false;
  for (const Load<Dim>& load : survey.assembly.water)
    water |= load.force.norm() > 0;
  std::string text = fmt::format("{} ({}-D): {} blocks, {} fixed\n", title.empty() ? "blocks" : title, Dim,
                                 survey.rows.size() + survey.fixed, survey.fixed);
  text +=
      fmt::format("strength of {}: {}; cohesion is perfectly plastic\n", survey.strength, fmt::join(strengths, ", "));
  text += fmt::format("loads of {}: weight{}{}{}\n", survey.loads, water ? ", water" : "",
                      survey.assembly.crossings.empty() ? "" : ", bolts (factor: active, at capacity)",
                      survey.assembly.model.applied.empty() ? "" : ", applied forces");
  if (survey.request.seismic) {
    const SeismicRequest& seismic = *survey.request.seismic;
    text += fmt::format("earthquake: a force of {:g} W on each block {}{}\n", seismic.coefficient,
                        seismic.trend ? fmt::format("towards {:g} deg", to_degrees(*seismic.trend))
                                      : "in its worst horizontal direction, in columns of blocks_verdicts.csv",
                        seismic.vertical > 0 ? fmt::format(", and {:g} W up or down", seismic.vertical) : "");
  }
  return text;
}

template <int Dim>
std::string volumes_line(const Survey<Dim>& survey) {
  std::vector<double> volumes;
  double total = 0, free_area = 0;
  for (const SurveyRow<Dim>& row : survey.rows) {
    free_area += row.free_area;
    if (!moves(row.kind())) continue;
    volumes.push_back(row.volume);
    total += row.volume;
  }
  if (volumes.empty()) return "";
  std::sort(volumes.rbegin(), volumes.rend());
  std::string text =
      fmt::format("move without friction: {:.6g} {}, {:.3g} {} per {} of free face; cumulative volume:", total,
                  unit_of_volume<Dim>(), total / free_area, unit_of_volume<Dim>(), Dim == 3 ? "m2" : "m");
  double sum = 0, reached = 0;
  std::size_t next = 0;
  for (const double share : {0.25, 0.5, 0.75, 1.0}) {
    while (next < volumes.size() && sum < share * total * (1 - rounding_of_sums)) {
      reached = volumes[next];
      sum += volumes[next++];
    }
    text += fmt::format("{} {:g} % in {} from {:.3g}", share == 0.25 ? "" : ",", 100 * share, count_of(next, "block"),
                        reached);
  }
  return text + "\n";
}

template <int Dim>
std::string rounds_line(const SuccessiveFailure& failure, const char* rule) {
  if (failure.rounds.empty()) return fmt::format("successive failure by {}: no block\n", rule);
  std::size_t blocks = 0;
  double volume = 0;
  std::vector<std::size_t> sizes;
  for (std::size_t r = 0; r < failure.rounds.size(); ++r) {
    sizes.push_back(failure.rounds[r].size());
    blocks += sizes.back();
    volume += failure.volumes[r];
  }
  return fmt::format("successive failure by {}: {}, {:.6g} {}, in {} of {}\n", rule, count_of(blocks, "block"), volume,
                     unit_of_volume<Dim>(), count_of(sizes.size(), "round"), fmt::join(sizes, ", "));
}

template <int Dim>
std::string least_line(const Survey<Dim>& survey) {
  const SurveyRow<Dim>* least = nullptr;
  int below = 0, key = 0;
  for (const auto* list : {&survey.rows, &survey.clusters})
    for (const SurveyRow<Dim>& row : *list) {
      if (!row.bolted.factor) continue;
      below += row.cluster == 0 && *row.bolted.factor < 1;
      key += row.cluster == 0 && *row.bolted.factor < survey.request.required;
      if (!least || *row.bolted.factor < *least->bolted.factor) least = &row;
    }
  if (!least) return "";
  return fmt::format("least factor {:.4f} ({} {}); {} below 1, {} below {:g} (key blocks, I)\n", *least->bolted.factor,
                     least->cluster > 0 ? "cluster" : "block", survey.body_names(*least), below, key,
                     survey.request.required);
}

}  // namespace

template <int Dim>
std::string blocks_summary(const Survey<Dim>& survey, const std::string& title, int top) {
  std::string text =
      header(survey, title) + classes(survey) + worst_rows(survey, top) + turning_rows(survey) + least_line(survey);
  text += volumes_line(survey);
  text += fmt::format(
      "clusters: {} of free neighbours, {} move as one, {} lower than their blocks; looked at: up to {} blocks, a "
      "larger "
      "cluster may be lower still\n",
      count_of(survey.pairs, "pair"), survey.moving_pairs,
      survey.clusters.empty() ? "none" : fmt::format("{}", survey.clusters.size()), survey.largest_cluster);
  text += rounds_line<Dim>(survey.below_one, "F < 1");
  if (survey.request.frictionless) text += rounds_line<Dim>(survey.frictionless, "motion without friction");
  for (const std::string& note : survey.notes)
    text += fmt::format("note: {}\n", note);
  return text;
}

template std::string blocks_summary<2>(const Survey<2>&, const std::string&, int);
template std::string blocks_summary<3>(const Survey<3>&, const std::string&, int);

}  // namespace voussoir
