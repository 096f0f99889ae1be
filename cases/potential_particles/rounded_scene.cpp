#include "cases/potential_particles/rounded_scene.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <cmath>
#include <limits>
#include <stdexcept>

#include "core/potential/valid_shape.hpp"

namespace voussoir::cases {
namespace {

template <int Dim>
std::string numbers(const Vector<Dim>& v) {
  return fmt::format("[{}]", fmt::join(v.data(), v.data() + Dim, ", "));
}

}  // namespace

// Planes and R converge together: R is that of the planes moved in, and determines by how much they move. From one
// iteration to the next the error falls by about k r/R.
template <int Dim>
PotentialShape<Dim> rounded(const HalfSpaces<Dim>& faces, const Vector<Dim>& centre, const Rounding& rounding) {
  constexpr int rounds = 60;
  constexpr double room = 1e-9;  // of R: beyond the rounding of the radius that just encloses
  const double r = rounding.radius, k = rounding.sphericity;
  PotentialShape<Dim> shape{faces, r, k, std::numeric_limits<double>::infinity(), centre};
  for (int i = 0; i < rounds; ++i) {
    for (std::size_t f = 0; f < faces.size(); ++f) {
      const double foot = -signed_distance<Dim>(faces[f], centre);
      const double left = 1 - k * std::pow(foot / shape.sphere_radius, 2);
      const double inside = r * std::sqrt(std::max(left, 0.0) / (1 - k));
      if (!(left > 0 && inside < foot)) throw std::domain_error("the block is too small for this radius");
      shape.planes[f].offset = faces[f].offset - inside;
    }
    shape.sphere_radius = (1 + room) * enclosing_radius<Dim>(shape.planes, r, centre);
    if (!(shape.sphere_radius > 0)) throw std::domain_error("the block is too small for this radius");
  }
  return shape;
}

template <int Dim>
std::string blocks_as_particles(const Model<Dim>& model, const State<Dim>& state, const Rounding& rounding) {
  std::string text = "blocks = [\n";
  for (std::size_t b = 0; b < model.bodies.size(); ++b) {
    const Body<Dim>& body = model.bodies[b];
    const Matrix<Dim> turn = matrix(state.bodies.motions[b].rotation);
    const Vector<Dim> place = model.origin + body.reference + state.bodies.motions[b].displacement;
    if (body.parts.size() != 1) throw std::domain_error("a body of several parts");
    HalfSpaces<Dim> faces;
    for (const HalfSpace<Dim>& f : body.parts.front().faces) {
      const Vector<Dim> normal = turn * f.normal;
      faces.push_back({normal, f.offset + normal.dot(place)});
    }
    std::string particle;
    if (rounding.radius > 0) {
      const PotentialShape<Dim> shape = rounded<Dim>(faces, place, rounding);
      faces = shape.planes;
      particle = fmt::format(
          ", shape = \"potential\", corner_radius = {}, sphericity = {}, sphere_radius = {}, centre = {}, "
          "mass_tolerance = {}",
          shape.corner_radius, shape.sphericity, shape.sphere_radius, numbers<Dim>(shape.centre), mass_tolerance<Dim>);
    }
    std::string planes;
    for (const HalfSpace<Dim>& f : faces)
      planes +=
          fmt::format("{}{{ normal = {}, offset = {} }}", planes.empty() ? "" : ", ", numbers<Dim>(f.normal), f.offset);
    const std::string name = body.name.empty() ? fmt::format("block_{}", b) : body.name;
    text += fmt::format("  {{ name = \"{}\", fixed = {}, planes = [{}]{} }},\n", name, body.fixed, planes, particle);
  }
  return text + "]\n";
}

template <int Dim>
double smallest_size(const Model<Dim>& model) {
  double least = std::numeric_limits<double>::infinity();
  for (const Body<Dim>& body : model.bodies)
    if (!body.fixed) least = std::min(least, body.size);
  return least;
}

template PotentialShape<2> rounded<2>(const HalfSpaces<2>&, const Vector<2>&, const Rounding&);
template PotentialShape<3> rounded<3>(const HalfSpaces<3>&, const Vector<3>&, const Rounding&);
template std::string blocks_as_particles<2>(const Model<2>&, const State<2>&, const Rounding&);
template std::string blocks_as_particles<3>(const Model<3>&, const State<3>&, const Rounding&);
template double smallest_size<2>(const Model<2>&);
template double smallest_size<3>(const Model<3>&);

}  // namespace voussoir::cases
