#include "core/scene/wet_faces.hpp"

#include <algorithm>

namespace voussoir {
namespace {

// the numbers of a surface (core/load/water.hpp) seen from the model's origin
std::vector<double> moved(std::vector<double> numbers, const Vector<2>& origin) {
  for (std::size_t k = 0; k < numbers.size(); ++k)
    numbers[k] -= origin[static_cast<int>(k % 2)];
  return numbers;
}

std::vector<double> moved(std::vector<double> numbers, const Vector<3>& origin) {
  numbers[0] += numbers[1] * origin[0] + numbers[2] * origin[1] - origin[2];
  return numbers;
}

// Faces without rock on both sides, or with one body on both: sides of the domain, blocks given directly, faces of
// excavations and their outlines, construction joints. The pressures on the two faces of a construction joint within a
// body cancel.
template <int Dim>
std::vector<std::size_t> outer_faces(const Scene& scene, const Model<Dim>& model) {
  std::vector<std::size_t> places;
  for (std::size_t j = 0; j < model.joints.size(); ++j)
    if (j >= scene.joints.size() || scene.joints[j].kind == JointKind::construction) places.push_back(j);
  places.push_back(model.joints.size());
  return places;
}

bool is_set(const Scene& scene, const std::string& name) {
  const auto sets = children({scene.tree.get(), ""}, "joint_sets");
  return std::ranges::any_of(sets, [&](const Subject& set) { return set.node->find("name")->text == name; });
}

std::vector<std::string> known_names(const Scene& scene) {
  std::vector<std::string> names{"all", "outer"};
  for (const JointSpec& joint : scene.joints) {
    names.push_back(joint.name);
    if (!joint.set.empty()) names.push_back(joint.set);
  }
  std::ranges::sort(names);
  names.erase(std::unique(names.begin(), names.end()), names.end());
  return names;
}

// the indices in Model::water_of_joint that a word names
template <int Dim>
std::vector<std::size_t> places_of(const std::string& word, const WaterSpec& water, const Scene& scene,
                                   const Model<Dim>& model) {
  std::vector<std::size_t> places;
  if (word == "all") {
    for (std::size_t j = 0; j <= model.joints.size(); ++j)
      places.push_back(j);
    return places;
  }
  if (word == "outer") return outer_faces(scene, model);
  for (std::size_t j = 0; j < model.joints.size(); ++j)
    if (model.joints[j].name == word || (j < scene.joints.size() && scene.joints[j].set == word)) places.push_back(j);
  if (places.empty() && !is_set(scene, word))
    refuse(water.subject, "faces",
           "no joint or joint set is named '" + one_line(word, 60) + "'; " + suggestion(word, known_names(scene)));
  return places;
}

}  // namespace

template <int Dim>
void add_waters(const Scene& scene, Model<Dim>& model) {
  if (scene.waters.empty()) return;
  std::vector<Water> waters;
  std::vector<int> water_of_joint(model.joints.size() + 1, -1);
  for (const WaterSpec& spec : scene.waters) {
    const int number = static_cast<int>(waters.size());
    for (const std::string& word : spec.faces)
      for (const std::size_t place : places_of(word, spec, scene, model)) {
        const int other = water_of_joint[place];
        if (other >= 0 && other != number)
          refuse(spec.subject, "faces",
                 (place < model.joints.size() ? "the faces of joint '" + model.joints[place].name + "'"
                                              : std::string("the outer faces")) +
                     " already have the water '" + waters[other].name +
                     "', and a face has only one; name the joints of each water, or "
                     "\"outer\"");
        water_of_joint[place] = number;
      }
    const bool uniform = spec.surface.pressure.has_value();
    waters.push_back(
        {spec.name, spec.unit_weight, uniform, uniform ? spec.numbers : moved(spec.numbers, model.origin)});
  }
  assign_waters(model, std::move(waters), std::move(water_of_joint));
}

template <int Dim>
WaterPlan in_model(WaterPlan plan, const Model<Dim>& model) {
  if (model.waters[plan.water].uniform) return plan;
  plan.from = moved(std::move(plan.from), model.origin);
  plan.to = moved(std::move(plan.to), model.origin);
  return plan;
}

template void add_waters<2>(const Scene&, Model<2>&);
template void add_waters<3>(const Scene&, Model<3>&);
template WaterPlan in_model<2>(WaterPlan, const Model<2>&);
template WaterPlan in_model<3>(WaterPlan, const Model<3>&);

}  // namespace voussoir
