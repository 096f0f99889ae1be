#include "app/blocks/blocks_view.hpp"

#include <fmt/format.h>

#include "app/blocks/verdict_words.hpp"
#include "app/view/page.hpp"
#include "core/output/atomic_file.hpp"
#include "core/output/view.hpp"

namespace voussoir {
namespace {

std::string rest_sentence(BlockKind kind) {
  switch (kind) {
    case BlockKind::enclosed:
      return "is enclosed: it has no free face";
    case BlockKind::tapered:
      return "is tapered (type IV): it has a free face, but every direction closes a joint";
    case BlockKind::no_load:
      return "is removable, but no load acts on it";
    case BlockKind::stable:
      return "is stable without friction (type III): removable, but its load presses it in";
    default:
      return "is undecided: the projection reached its limit of steps";
  }
}

// "slides on two faces (A1, B1) towards 38.0/169.1 (plunge/trend), type I: factor of safety 1.0694; …"
template <int Dim>
std::string motion_sentence(const Survey<Dim>& survey, const SurveyRow<Dim>& row) {
  const std::string joints = joints_shown(survey, row), more = verdict_remarks(survey, row);
  std::string text = kind_label(row);
  if (!joints.empty()) text += fmt::format(" ({})", joints);
  text += fmt::format(Dim == 3 ? " towards {} (plunge/trend)" : ", plunge {}",
                      direction_shown<Dim>(row.bolted.verdict.motion));
  text += fmt::format(", type {}: factor of safety {:.4f}; force for {:g}: {}", type_of(row, survey.request.required),
                      *row.bolted.factor, survey.request.required, force_shown(row, Dim == 3 ? " kN" : " kN/m"));
  return more.empty() ? text : fmt::format("{}; {}", text, more);
}

template <int Dim>
std::string row_sentence(const Survey<Dim>& survey, const SurveyRow<Dim>& row) {
  return moves(row.kind()) ? motion_sentence(survey, row) : rest_sentence(row.kind());
}

ViewVerdict::Kind shown_kind(BlockKind kind) {
  switch (kind) {
    case BlockKind::enclosed:
    case BlockKind::tapered:
      return ViewVerdict::Kind::immovable;
    case BlockKind::no_load:
    case BlockKind::stable:
      return ViewVerdict::Kind::stable;
    case BlockKind::undecided:
      return ViewVerdict::Kind::undecided;
    default:
      return ViewVerdict::Kind::judged;
  }
}

// by body; the factor is the least, alone or in a cluster
template <int Dim>
std::vector<ViewVerdict> view_verdicts(const Survey<Dim>& survey) {
  std::vector<ViewVerdict> verdicts(survey.assembly.model.bodies.size(),
                                    {ViewVerdict::Kind::fixed, {}, "It is fixed."});
  for (const SurveyRow<Dim>& row : survey.rows)
    verdicts[row.bodies[0]] = {shown_kind(row.kind()), row.bolted.factor,
                               fmt::format("It {}.", row_sentence(survey, row))};
  for (const SurveyRow<Dim>& row : survey.clusters)
    for (const int b : row.bodies) {
      ViewVerdict& verdict = verdicts[b];
      verdict.sentence += fmt::format(" As part of {} it {}.", survey.body_names(row), row_sentence(survey, row));
      if (!row.bolted.factor || (verdict.factor && *verdict.factor <= *row.bolted.factor)) continue;
      verdict.kind = ViewVerdict::Kind::judged;
      verdict.factor = row.bolted.factor;
    }
  return verdicts;
}

}  // namespace

template <int Dim>
void write_blocks_view(const std::filesystem::path& folder, const Prepared<Dim>& prepared, const Survey<Dim>& survey) {
  Prepared<Dim> judged = prepared;
  judged.model = survey.assembly.model;
  judged.state = initial_state(judged.model);
  const std::string& after = survey.request.after;
  const std::string geometry = after.empty() ? "as sliced" : fmt::format("after stage \"{}\"", after);
  const ViewSeries series = begin_view(folder / view_file, judged);
  add_view_verdicts(series, fmt::format("{}, strength of {}", geometry, survey.strength), view_verdicts(survey));
  write_file(folder / page_file, view_page(folder / view_file));
}

template void write_blocks_view<2>(const std::filesystem::path&, const Prepared<2>&, const Survey<2>&);
template void write_blocks_view<3>(const std::filesystem::path&, const Prepared<3>&, const Survey<3>&);

}  // namespace voussoir
