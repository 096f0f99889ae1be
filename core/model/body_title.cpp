#include "core/model/body_title.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <vector>

namespace voussoir {
namespace {

constexpr std::size_t most_joints_named = 3;

template <int Dim>
std::string node_title(const Model<Dim>& model, int body) {
  for (const Lining& lining : model.linings) {
    const int node = body - lining.first_body;
    if (lining.first_body >= 0 && node >= 0 && node < static_cast<int>(lining.nodes.size()))
      return fmt::format("node {} of lining '{}'", node + 1, lining.properties.name);
  }
  return "";
}

template <int Dim>
std::string joints_title(const Model<Dim>& model, const Body<Dim>& body) {
  std::vector<int> joints;
  for (const Polytope<Dim>& part : body.parts)
    for (const int joint : part.joints)
      if (joint >= 0 && joint < static_cast<int>(model.joints.size())) joints.push_back(joint);
  std::ranges::sort(joints);
  joints.erase(std::unique(joints.begin(), joints.end()), joints.end());
  if (joints.empty()) return "";
  std::string text = joints.size() == 1 ? "of joint " : "of joints ";
  for (std::size_t k = 0; k < std::min(joints.size(), most_joints_named); ++k)
    text += (k ? ", " : "") + model.joints[joints[k]].name;
  return text + (joints.size() > most_joints_named ? ", …" : "");
}

}  // namespace

template <int Dim>
std::string title_of(const Model<Dim>& model, int body) {
  const Body<Dim>& of = model.bodies[body];
  if (!of.name.empty()) return of.name;
  if (std::string title = node_title(model, body); !title.empty()) return title;
  if (std::string title = joints_title(model, of); !title.empty()) return title;
  std::string place;
  for (int k = 0; k < Dim; ++k)
    place += fmt::format("{}{:.4g}", k ? ", " : "", model.origin[k] + of.reference[k] + 0.0);
  return "at (" + place + ") m";
}

template std::string title_of<2>(const Model<2>&, int);
template std::string title_of<3>(const Model<3>&, int);

}  // namespace voussoir
