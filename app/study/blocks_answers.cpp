#include "app/study/blocks_answers.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>

#include "app/blocks/seismic_option.hpp"
#include "core/base/bad_input.hpp"
#include "core/joint_sets/random_stream.hpp"
#include "core/key_blocks/mass_values.hpp"
#include "core/output/block_verdicts.hpp"
#include "core/scene/scene_error.hpp"
#include "core/scene/scene_text.hpp"
#include "core/scene/toml_text.hpp"
#include "text/angle.hpp"

namespace voussoir {
namespace {

template <int Dim>
bool has_free_block(const Model<Dim>& model) {
  return std::ranges::any_of(model.bodies,
                             [](const Body<Dim>& body) { return body.present && !body.fixed && !body.parts.empty(); });
}

template <int Dim>
std::string mode_of(const Survey<Dim>& survey, const MassValues<Dim>& mass) {
  if (!mass.least) return "";
  const std::vector<std::string> joints = loaded_joints(survey, *mass.least);
  std::string text = word_of(mass.least->kind());
  if (!joints.empty()) text += fmt::format(" on {}", fmt::join(joints, ", "));
  return text;
}

SurveyRequest request_of(const std::vector<std::string>& options) {
  SurveyRequest request;
  for (std::size_t k = 0; k + 1 < options.size(); k += 2) {
    if (options[k] == "--strength-of") request.strength_of = options[k + 1];
    if (options[k] == "--after") request.after = options[k + 1];
    if (options[k] == "--seismic") request.seismic = seismic_request(options[k + 1]);
  }
  refuse_out_of_range(request);
  request.factors_only = true;
  return request;
}

Node tree_of(const std::filesystem::path& file) {
  return parse_toml(file_text(file), std::make_shared<const std::string>(file.string()));
}

AnyPrepared prepare_blocks(const Scene& scene) {
  if (scene.dimension == 2) return prepare<2>(scene);
  return prepare<3>(scene);
}

}  // namespace

std::string status_text(const BlocksAnswer& answer) {
  switch (answer.end) {
    case RowEnd::no_block:
      return "no block forms";
    case RowEnd::nothing_moves:
      return "no block can move";
    case RowEnd::undecided:
      return "a projection found no end";
    default:
      return answer.message;
  }
}

BlocksAnswers::BlocksAnswers(const std::filesystem::path& scene, const std::vector<std::string>& overrides,
                             const std::vector<std::string>& options, const std::string& quantity)
    : file_(scene), overrides_(overrides), request_(request_of(options)), quantity_(quantity), stated_(tree_of(scene)) {
  const std::vector<std::string> names = names_of_mass_values(request_.seismic.has_value());
  if (std::ranges::find(names, quantity) == names.end())
    throw BadInput(
        fmt::format("quantity = \"{}\": block theory has no such value; {}", quantity, suggestion(quantity, names)));
  scene_ = std::make_shared<Scene>(read_tree(stated_, file_.string(), overrides_));
  prepared_ = prepare_blocks(*scene_);
  if (quantity == "volume_below_1") unit_ = scene_->dimension == 3 ? "m3" : "m2";
  if (quantity == "least_factor") divides_ = divided_by_blocks;
}

std::optional<BlocksAnswers::Strength> BlocksAnswers::strength_of(const std::string& key) const {
  constexpr std::string_view begin = "joint_properties.";
  if (!key.starts_with(begin)) return std::nullopt;
  const std::size_t dot = key.rfind('.');
  const std::string name = key.substr(begin.size(), dot - begin.size()), last = key.substr(dot + 1);
  if (last != "friction_deg" && last != "cohesion") return std::nullopt;
  for (const PropertiesSpec& spec : scene_->properties) {
    const JointProperties& joint = spec.properties;
    if (joint.name != name || joint.mobilises() || joint.states_barton_bandis() || joint.softens_cohesion()) continue;
    if (last == "cohesion" && !(joint.cohesion > 0)) continue;
    return Strength{name, last == "friction_deg"};
  }
  return std::nullopt;
}

void BlocksAnswers::vary(const DrawnKeys& drawn) {
  drawn_ = &drawn;
  keys_ = drawn.scene_keys();
  strengths_.clear();
  for (const DrawnKey& key : drawn.keys) {
    const std::optional<Strength> strength = key.pole ? std::nullopt : strength_of(key.key);
    if (key.per != DrawnPer::property && !strength)
      throw BadInput(
          fmt::format("per = \"{}\" of {}: it is for friction_deg and cohesion of joint_properties that are in "
                      "the scene, constant, and above 0",
                      key.per == DrawnPer::set ? "set" : "joint", key.key));
    if (strength) strengths_.push_back(*strength);
  }
  if (strengths_.size() != keys_.size()) strengths_.clear();
}

// Joints that do not share a draw get properties of their own, of the same name, so that a stage still finds them.
template <int Dim>
void BlocksAnswers::give_joints_their_own(Prepared<Dim>& prepared, int row) const {
  Model<Dim>& model = prepared.model;
  std::map<std::pair<int, std::string>, int> own;  // by the properties before, and the joint or set
  for (const DrawnKey& key : drawn_->keys) {
    if (key.per == DrawnPer::property) continue;
    const Strength strength = *strength_of(key.key);
    for (std::size_t j = 0; j < model.joints.size(); ++j) {
      Joint<Dim>& joint = model.joints[j];
      if (model.properties[joint.properties].name != strength.properties) continue;
      const int set = prepared.joint_sets.set_of(static_cast<int>(j));
      const std::string name =
          key.per == DrawnPer::set && set >= 0 ? "set " + prepared.joint_sets.names[set] : "joint " + joint.name;
      const auto [place, is_new] =
          own.try_emplace({joint.properties, key.key + name}, static_cast<int>(model.properties.size()));
      if (is_new) {
        JointProperties properties = model.properties[joint.properties];
        RandomStream stream(drawn_->seed, fmt::format("row {} of {} of {}", row, key.key, name));
        const double value = draw(key.law, stream).value_or(0);
        (strength.friction ? properties.friction : properties.cohesion) = strength.friction ? value * degree : value;
        model.properties.push_back(properties);
      }
      joint.properties = place->second;
    }
  }
}

template <int Dim>
BlocksAnswer BlocksAnswers::judge(Prepared<Dim> prepared, const std::vector<double>& values, int row) const {
  for (std::size_t k = 0; k < strengths_.size(); ++k)
    for (JointProperties& joint : prepared.model.properties)
      if (joint.name == strengths_[k].properties)
        (strengths_[k].friction ? joint.friction : joint.cohesion) =
            strengths_[k].friction ? values[k] * degree : values[k];
  if (drawn_) give_joints_their_own(prepared, row);
  BlocksAnswer answer;
  if (!has_free_block(prepared.model)) {
    answer.end = RowEnd::no_block;
    if (quantity_ == "volume_below_1" || quantity_ == "blocks_below_1") answer.value = 0;
    return answer;
  }
  const Survey<Dim> survey = survey_blocks(prepared, request_);
  const MassValues<Dim> mass = mass_values(survey);
  if (mass.undecided) {
    answer.end = RowEnd::undecided;
    return answer;
  }
  answer.mode = mode_of(survey, mass);
  if (quantity_ == "least_factor") answer.value = mass.least_factor;
  if (quantity_ == "volume_below_1") answer.value = mass.volume_below_1;
  if (quantity_ == "blocks_below_1") answer.value = static_cast<double>(mass.below_1.size());
  if (quantity_ == "least_critical_coefficient") answer.value = mass.least_critical_coefficient;
  if (!mass.least) answer.end = RowEnd::nothing_moves;
  return answer;
}

BlocksAnswer BlocksAnswers::answer(const std::vector<double>& values, int row) const {
  // outside of what the reader takes the row goes through it, which says why
  const auto in_range = [&](std::size_t k) {
    return strengths_[k].friction ? values[k] >= 0 && values[k] < 90 : values[k] > 0;
  };
  bool strengths_only = !strengths_.empty();
  for (std::size_t k = 0; strengths_only && k < strengths_.size(); ++k)
    strengths_only = in_range(k);
  try {
    const auto judged = [&](const AnyPrepared& any) {
      return std::visit([&](const auto& prepared) { return judge(prepared, values, row); }, any);
    };
    if (strengths_only || keys_.empty()) return judged(prepared_);
    std::vector<std::string> overrides = overrides_;
    for (std::size_t k = 0; k < keys_.size(); ++k)
      overrides.push_back(fmt::format("{}={}", keys_[k], values[k]));
    return judged(prepare_blocks(read_tree(stated_, file_.string(), overrides)));
  } catch (const SceneError& error) {
    return {RowEnd::refused, {}, "", error.what()};
  } catch (const BadInput& error) {
    return {RowEnd::refused, {}, "", error.what()};
  }
}

}  // namespace voussoir
