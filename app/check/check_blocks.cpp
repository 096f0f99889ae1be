#include "app/check/check_blocks.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>

#include "app/check/check_line.hpp"
#include "core/model/body_title.hpp"
#include "core/potential/particle.hpp"
#include "core/scene/bodies.hpp"
#include "core/scene/joint_ends.hpp"
#include "core/scene/joint_outline.hpp"
#include "core/scene/region.hpp"

namespace voussoir {
namespace {

constexpr std::size_t most_named = 3;

// one number of a block
struct Judged {
  double value;
  std::size_t body;
};

template <int Dim>
double shortest_edge(const Body<Dim>& body) {
  double shortest = std::numeric_limits<double>::infinity();
  for (const Polytope<Dim>& part : body.parts)
    for (const std::vector<int>& loop : part.loops)
      for (std::size_t k = 0; k < loop.size(); ++k)
        if (const int begin = loop[k], end = loop[(k + 1) % loop.size()]; begin != end)
          shortest = std::min(shortest, (part.vertices[end] - part.vertices[begin]).norm());
  return shortest;
}

// of the box along the axes, as slicing measures a part
template <int Dim>
double aspect_ratio(const Body<Dim>& body) {
  Vector<Dim> low = Vector<Dim>::Constant(std::numeric_limits<double>::max()), high = -low;
  for (const Polytope<Dim>& part : body.parts)
    for (const Vector<Dim>& vertex : part.vertices) {
      low = low.cwiseMin(vertex);
      high = high.cwiseMax(vertex);
    }
  return (high - low).maxCoeff() / (high - low).minCoeff();
}

// the first of them; of two that are equal the one of lower number first
template <int Dim>
std::string worst_of(const Model<Dim>& model, std::vector<Judged> all, const std::function<bool(double, double)>& worse,
                     const char* unit) {
  std::stable_sort(all.begin(), all.end(), [&](const Judged& a, const Judged& b) { return worse(a.value, b.value); });
  std::string text;
  for (std::size_t k = 0; k < std::min(all.size(), most_named); ++k) {
    const std::string title = title_of(model, all[k].body);
    const bool named = !model.bodies[all[k].body].name.empty();
    text += fmt::format("{}{} {:.4g}{}", k ? ", " : "",
                        named ? title : fmt::format("block {} ({})", all[k].body, title), all[k].value, unit);
  }
  return text;
}

}  // namespace

template <int Dim>
void print_missing_joints(const Scene& scene, const Model<Dim>& model) {
  if (!scene.domain || scene.joints.empty()) return;
  const Polytope<Dim> domain = make_domain<Dim>(scene, model.origin);
  std::size_t missing = 0;
  std::string names;
  for (std::size_t j = 0; j < scene.joints.size(); ++j) {
    const JointSpec& joint = scene.joints[j];
    const HalfSpace<Dim> plane = to_half_space<Dim>(joint.plane, model.origin);
    Outline<Dim> outline;
    if (scene.slicing.ends != JointEnds::ignored) outline = outline_of<Dim>(joint, plane.normal, model.origin);
    Polytope<Dim> solid = domain;
    if (joint.within)
      for (const HalfSpace<Dim>& bound : region_planes<Dim>(*joint.within, model.origin))
        solid.faces.push_back(bound);
    for (const HalfSpace<Dim>& bound : end_bounds<Dim>(scene, j, domain, model.origin))
      solid.faces.push_back(bound);
    if (measure_inside(plane, outline, solid) > 0) continue;
    if (missing++ < most_named) names += (names.empty() ? "" : ", ") + joint.name;
  }
  if (missing > most_named) names += fmt::format(" and {} more", missing - most_named);
  print_line("", missing == 0 ? fmt::format("none of {} stated joints misses the domain", scene.joints.size())
                              : fmt::format("{} of {} stated joints {} the domain: {}", missing, scene.joints.size(),
                                            missing == 1 ? "misses" : "miss", names));
}

template <int Dim>
void print_worst_blocks(const Model<Dim>& model) {
  std::vector<Judged> volumes, edges, ratios;
  for (std::size_t b = 0; b < model.bodies.size(); ++b) {
    const Body<Dim>& body = model.bodies[b];
    if (body.parts.empty() || std::any_of(body.parts.begin(), body.parts.end(), is_particle<Dim>)) continue;
    volumes.push_back({volume(body), b});
    edges.push_back({shortest_edge(body), b});
    ratios.push_back({aspect_ratio(body), b});
  }
  if (volumes.empty()) return;
  print_line("worst", fmt::format("smallest {}: {}", Dim == 3 ? "volume" : "area",
                                  worst_of(model, volumes, std::less<>(), Dim == 3 ? " m³" : " m²")));
  print_line("", fmt::format("shortest edge: {}", worst_of(model, edges, std::less<>(), " m")));
  print_line("", fmt::format("largest aspect ratio of the box along the axes: {}",
                             worst_of(model, ratios, std::greater<>(), "")));
}

template void print_missing_joints<2>(const Scene&, const Model<2>&);
template void print_missing_joints<3>(const Scene&, const Model<3>&);
template void print_worst_blocks<2>(const Model<2>&);
template void print_worst_blocks<3>(const Model<3>&);

}  // namespace voussoir
