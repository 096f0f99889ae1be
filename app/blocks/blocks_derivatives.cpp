#include "app/blocks/blocks_derivatives.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>

#include "core/output/block_verdicts.hpp"

namespace voussoir {
namespace {

constexpr double rounding = 1e-14;     // of one answer, relative
constexpr double same_factor = 1e-11;  // relative: two blocks have the least factor
constexpr const char* nothing_moves = "no block moves without friction: no factor, so no derivative";

// the blocks that give the least factor, and what bounds them
struct LeastRow {
  PieceAnswer answer;
  std::set<std::string> joints;
  double length = 1;  // m
};

// The smooth piece: mechanism, joints that bound the blocks with their sides, corners. A block's number and volume
// may change with the order of slicing, these do not.
template <int Dim>
std::string piece_of(const Survey<Dim>& survey, const SurveyRow<Dim>& row) {
  std::vector<std::string> faces;
  for (const RockFace<Dim>& face : row.faces)
    faces.push_back(fmt::format("{}{}", face.normal[Dim - 1] < 0 ? '-' : '+', survey.joint_name(face)));
  std::sort(faces.begin(), faces.end());
  std::vector<std::size_t> corners;
  for (const int body : row.bodies)
    for (const Polytope<Dim>& part : survey.assembly.model.bodies[body].parts)
      corners.push_back(part.vertices.size());
  std::sort(corners.begin(), corners.end());
  return fmt::format("{} {} of {} on {}; {}; {}", word_of(row.kind()), row.bodies.size(), row.bolted.verdict.loaded,
                     fmt::join(loaded_joints(survey, row), ", "), fmt::join(faces, " "), fmt::join(corners, " "));
}

template <int Dim>
std::string words_of(const Survey<Dim>& survey, const SurveyRow<Dim>& row) {
  const std::vector<std::string> joints = loaded_joints(survey, row);
  return fmt::format("block {} {}{}{}", survey.body_names(row), word_of(row.kind()), joints.empty() ? "" : " on ",
                     fmt::join(joints, ", "));
}

// Of rows with the same least factor that of the piece asked for, else the first by its piece, so that neighbouring
// scenes agree.
template <int Dim>
LeastRow least_row(const Scene& scene, const SurveyRequest& request, const std::string& piece) {
  const Prepared<Dim> prepared = prepare<Dim>(scene);
  const bool any_free = std::ranges::any_of(
      prepared.model.bodies, [](const Body<Dim>& body) { return body.present && !body.fixed && !body.parts.empty(); });
  LeastRow least;
  least.answer.reason = nothing_moves;
  if (!any_free) return least;
  const Survey<Dim> survey = survey_blocks(prepared, request);
  double factor = std::numeric_limits<double>::infinity();
  std::vector<const SurveyRow<Dim>*> moving;
  for (const auto* list : {&survey.rows, &survey.clusters})
    for (const SurveyRow<Dim>& row : *list) {
      if (!moves(row.kind()) || !row.bolted.factor) continue;
      moving.push_back(&row);
      factor = std::min(factor, *row.bolted.factor);
    }
  const SurveyRow<Dim>* chosen = nullptr;
  std::string chosen_piece;
  for (const SurveyRow<Dim>* row : moving) {
    if (*row->bolted.factor > factor + same_factor * std::abs(factor)) continue;
    const std::string its = piece_of(survey, *row);
    if (chosen && chosen_piece == piece) break;
    if (!chosen || its == piece || its < chosen_piece) {
      chosen = row;
      chosen_piece = its;
    }
  }
  if (!chosen || !std::isfinite(factor)) return least;
  least.answer = {*chosen->bolted.factor, chosen_piece, words_of(survey, *chosen), ""};
  for (const RockFace<Dim>& face : chosen->faces)
    least.joints.insert(survey.joint_name(face));
  least.length = std::pow(chosen->volume, 1.0 / Dim);
  return least;
}

LeastRow least_row(const Scene& scene, const SurveyRequest& request, const std::string& piece) {
  return scene.dimension == 2 ? least_row<2>(scene, request, piece) : least_row<3>(scene, request, piece);
}

// a key of a joint that does not bound the blocks
bool is_elsewhere(const MovingKey& key, const std::set<std::string>& joints) {
  constexpr std::string_view begin = "joints.";
  if (!key.key.starts_with(begin)) return false;
  const std::string_view rest = std::string_view(key.key).substr(begin.size());
  return !joints.contains(std::string(rest.substr(0, rest.find('.'))));
}

}  // namespace

DerivativeTable blocks_derivatives(const Scene& scene, const SurveyRequest& stated, const KeyHook& hook) {
  SurveyRequest request = stated;
  request.factors_only = true;
  const LeastRow base = least_row(scene, request, "");
  std::vector<MovingKey> keys = moving_keys(*scene.tree);
  std::erase_if(keys, [&](const MovingKey& key) { return is_elsewhere(key, base.joints); });
  const double factor = base.answer.value.value_or(0);
  const AnswerWith answer_with = [&](const std::vector<std::string>& overrides) {
    return least_row(read_tree(*scene.tree, scene.file, overrides), request, base.answer.piece).answer;
  };
  return derivative_table(
      keys, base.answer,
      {.name = "least_factor", .unit = "1", .bar = rounding * std::abs(factor), .length = base.length}, answer_with,
      hook);
}

}  // namespace voussoir
