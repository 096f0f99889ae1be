#include "app/check/check_support.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "app/base/shown_unit.hpp"
#include "app/check/check_line.hpp"
#include "core/potential/particle.hpp"
#include "core/stage/install_bolts.hpp"

namespace voussoir {
namespace {

// the bolts, and the joints they would cross if they were installed in the blocks as they are cut
template <int Dim>
void print_bolts(const Prepared<Dim>& prepared) {
  const Model<Dim>& model = prepared.model;
  const char* label = "bolts";
  for (std::size_t p = 0; p < model.bolt_properties.size(); ++p) {
    const BoltProperties& properties = model.bolt_properties[p];
    double longest_nodes = 0;  // m
    std::size_t count = 0, joints = 0, idle = 0, thin = 0, fewest = std::numeric_limits<std::size_t>::max(), most = 0;
    for (std::size_t i = 0; i < model.bolts.size(); ++i) {
      if (model.bolts[i].properties != static_cast<int>(p)) continue;
      const std::vector<BoltSpring<Dim>> springs = springs_of(model, prepared.state, static_cast<int>(i));
      ++count;
      joints += springs.size();
      if (properties.kind == BoltKind::grouted)
        longest_nodes =
            std::max(longest_nodes, node_spacing(properties, (model.bolts[i].toe - model.bolts[i].collar).norm()));
      idle += springs.empty();
      fewest = std::min(fewest, springs.size());
      most = std::max(most, springs.size());
      for (const BoltSpring<Dim>& spring : springs)
        thin += shortened(model, spring);
    }
    std::string text = fmt::format("{}: {}{}", properties.name, count,
                                   properties.kind == BoltKind::end_anchored ? " end-anchored"
                                   : properties.kind == BoltKind::grouted    ? " grouted"
                                                                             : "");
    if (properties.kind != BoltKind::end_anchored)
      text += fmt::format(" that cross {} joints of the blocks as they are cut, {} each", joints,
                          fewest == most ? fmt::format("{}", most) : fmt::format("{} to {}", fewest, most));
    if (properties.kind == BoltKind::grouted)
      text += fmt::format(
          "; node spacing at most {:.3g} m, {:.2g} of the length over which the bond builds up the bar force",
          longest_nodes, longest_nodes / transfer_length(properties));
    if (idle > 0) text += fmt::format("; {} cross none", idle);
    if (thin > 0) text += fmt::format("; {} springs have an anchor in the middle of a thin block", thin);
    print_line(label, text);
    label = "";
  }
}

// linings, and the spacing of their nodes relative to the blocks as they are cut
template <int Dim>
void print_linings(const Prepared<Dim>& prepared) {
  const char* label = "linings";
  for (const Lining& lining : prepared.model.linings) {
    double longest = 0;
    for (const LiningNode& node : lining.nodes)
      longest = std::max(longest, 2 * std::max(node.half_length[0], node.half_length[1]));
    const LiningProperties& p = lining.properties;
    print_line(label, fmt::format("{}: {} nodes on {} of {} sides, beams up to {:.3g} m long; EA {}, EI {} per m",
                                  p.name, lining.nodes.size(), lining.closed ? "a ring" : "an arc", lining.sides.size(),
                                  longest, quantity_text(p.axial(), "N"), quantity_text(p.bending(), "N m²")));
    label = "";
  }
}

}  // namespace

template <int Dim>
void print_particles(const Model<Dim>& model) {
  if (!model.particles) return;
  constexpr double none = std::numeric_limits<double>::infinity();
  int count = 0;
  double least = none, most = 0, mass = 0, drawing = 0, least_inner = none, most_inner = 0;
  for (const PartId& id : model.parts) {
    const Particle<Dim>& particle = *model.bodies[id.body].parts[id.part].particle;
    const double radius = particle.shape.corner_radius;
    if (particle.inner) {
      least_inner = std::min(least_inner, radius);
      most_inner = std::max(most_inner, radius);
      continue;
    }
    ++count;
    mass = std::max(mass, particle.mass.error);
    drawing = std::max(drawing, particle.drawing.error);
    if (particle.shape.sphericity == 1) continue;
    least = std::min(least, radius);
    most = std::max(most, radius);
  }
  print_line(
      "particles",
      fmt::format("{} of {} convex parts{}; volume, centroid and inertia within {:.2g} of the volume, drawn "
                  "within {:.2g} m",
                  count, model.parts.size(),
                  most > 0 ? fmt::format(", corner radius {:.4g} to {:.4g} m", least, most) : "", mass, drawing));
  if (!model.properties.empty())
    print_line("", fmt::format("they touch at one point, without area, with the properties {} (N/m)",
                               model.properties[model.default_properties].name));
  if (most_inner > 0)
    print_line("", fmt::format("in contact with them, blocks of half-spaces have edges rounded by {:.4g} to {:.4g} m "
                               "(contact.potential_radius): a right-angled edge recedes by {:.2g} m",
                               least_inner, most_inner, (std::sqrt(2) - 1) * most_inner));
}

template <int Dim>
void print_support(const Prepared<Dim>& prepared) {
  print_bolts(prepared);
  print_linings(prepared);
}

template void print_particles<2>(const Model<2>&);
template void print_particles<3>(const Model<3>&);
template void print_support<2>(const Prepared<2>&);
template void print_support<3>(const Prepared<3>&);

}  // namespace voussoir
