#include "core/stage/excavation.hpp"

#include <algorithm>
#include <numeric>
#include <set>
#include <span>
#include <stdexcept>

#include "core/slicing/clump.hpp"

namespace voussoir {
namespace {

template <int Dim>
std::vector<const Excavation<Dim>*> regions_named(const Model<Dim>& model, const std::vector<std::string>& names) {
  std::vector<const Excavation<Dim>*> regions;
  for (const std::string& name : names) {
    const auto found = std::ranges::find(model.excavations, name, &Excavation<Dim>::name);
    if (found == model.excavations.end()) throw std::out_of_range(name);
    regions.push_back(&*found);
  }
  return regions;
}

// numbers of the pieces formed by some parts of a body: parts with a common face are connected
template <int Dim>
std::vector<int> piece_of_parts(const Model<Dim>& model, const Body<Dim>& body, const std::vector<int>& places) {
  std::vector<Polytope<Dim>> parts;
  std::set<int> joints;
  for (const int k : places) {
    parts.push_back(body.parts[k]);
    joints.insert(body.parts[k].joints.begin(), body.parts[k].joints.end());
  }
  std::vector<Cut<Dim>> cuts;
  for (const int joint : joints) {
    if (joint == no_joint) continue;
    const HalfSpace<Dim>& plane = model.joints[joint].plane;
    Cut<Dim> cut{{plane.normal, plane.offset - plane.normal.dot(body.reference)}, joint};
    cut.kind = JointKind::construction;
    cuts.push_back(std::move(cut));
  }
  return bodies_of(parts, cuts, false);
}

bool one_piece(const std::vector<int>& piece) {
  return std::ranges::all_of(piece, [](int p) { return p == 0; });
}

// The remaining parts of a body, piece by piece, the largest first. A body of blocks given directly that was not
// connected by faces before stays one body.
template <int Dim>
std::vector<std::vector<int>> pieces_left(const Model<Dim>& model, const Body<Dim>& body,
                                          const std::vector<int>& left) {
  const std::vector<int> piece = piece_of_parts(model, body, left);
  if (one_piece(piece)) return {left};
  std::vector<int> all(body.parts.size());
  std::iota(all.begin(), all.end(), 0);
  if (!one_piece(piece_of_parts(model, body, all))) return {left};
  std::vector<std::vector<int>> pieces(*std::ranges::max_element(piece) + 1);
  for (std::size_t k = 0; k < left.size(); ++k)
    pieces[piece[k]].push_back(left[k]);
  const auto volume_of = [&](const std::vector<int>& parts) {
    double sum = 0;
    for (const int k : parts)
      sum += body.parts[k].mass.volume;
    return sum;
  };
  std::ranges::stable_sort(pieces, std::greater<>(), volume_of);
  return pieces;
}

// its reference is the shift of the centroid in the original body's frame
template <int Dim>
Body<Dim> piece_of(const Body<Dim>& whole, const std::vector<int>& places) {
  std::vector<Polytope<Dim>> parts;
  for (const int k : places)
    parts.push_back(whole.parts[k]);
  Body<Dim> piece = assemble_body<Dim>(std::move(parts), whole.mass / volume(whole));
  piece.name = whole.name;
  piece.fixed = whole.fixed;
  piece.prescribed = whole.prescribed;
  piece.free_translation = whole.free_translation;
  piece.free_rotation = whole.free_rotation;
  return piece;
}

// Adds the pieces of a body to the model; `now` has the index of each of the body's parts.
template <int Dim>
void divide(Model<Dim>& model, int b, const std::vector<std::vector<int>>& pieces, std::span<PartId> now,
            Excavated<Dim>& moved) {
  const Body<Dim> whole = model.bodies[b];
  std::ranges::fill(now, PartId{-1, -1});
  std::vector<int> bodies;
  for (const std::vector<int>& parts : pieces) {
    const bool first = bodies.empty();
    const int id = first ? b : static_cast<int>(model.bodies.size());
    for (std::size_t k = 0; k < parts.size(); ++k)
      now[parts[k]] = {id, static_cast<int>(k)};
    Body<Dim> piece = piece_of(whole, parts);
    const Vector<Dim> shift = piece.reference;
    piece.reference += whole.reference;
    if (first) {
      model.bodies[b] = std::move(piece);
      moved.shift[b] = shift;
    } else {
      piece.name.clear();
      model.bodies.push_back(std::move(piece));
      moved.origin.push_back(b);
      moved.shift.push_back(shift);
    }
    bodies.push_back(id);
  }

  const auto stressed = std::ranges::find(model.boundary, b, &BoundaryForces<Dim>::body);
  if (stressed != model.boundary.end()) {
    const DepthStress<Dim> stress = stressed->stress;
    for (const int id : bodies)
      load_boundary(model, id, stress);
  }
  const auto forced = std::ranges::find(model.prescribed, b, &PrescribedMotion<Dim>::body);
  if (forced != model.prescribed.end()) {
    const PrescribedMotion<Dim> motion = *forced;
    for (std::size_t k = 1; k < bodies.size(); ++k) {
      model.prescribed.push_back(motion);
      model.prescribed.back().body = bodies[k];
    }
  }
  for (AppliedForce<Dim>& f : model.applied) {
    if (f.body != b || f.place.isZero(0)) continue;
    const PartId at = now[part_at(whole, f.place)];
    if (at.body < 0) {
      f.force.setZero();
      continue;
    }
    f.body = at.body;
    f.place -= moved.shift[at.body];
  }
}

}  // namespace

template <int Dim>
int part_at(const Body<Dim>& body, const Vector<Dim>& point) {
  const auto outside = [&](const Polytope<Dim>& part) {
    double most = -std::numeric_limits<double>::infinity();
    for (const HalfSpace<Dim>& face : part.faces)
      most = std::max(most, signed_distance<Dim>(face, point));
    return most;
  };
  return static_cast<int>(std::ranges::min_element(body.parts, {}, outside) - body.parts.begin());
}

template <int Dim>
int body_around(const Model<Dim>& model, const Vector<Dim>& point) {
  for (std::size_t b = 0; b < model.bodies.size(); ++b) {
    const Body<Dim>& body = model.bodies[b];
    const Vector<Dim> place = point - body.reference;
    if (!body.present || place.norm() > body.radius) continue;
    if (std::ranges::any_of(body.parts, [&](const Polytope<Dim>& part) { return lies_inside<Dim>(part.faces, place); }))
      return static_cast<int>(b);
  }
  return -1;
}

template <int Dim>
Excavated<Dim> excavate(Model<Dim>& model, const std::vector<std::string>& names) {
  const std::vector<const Excavation<Dim>*> regions = regions_named(model, names);
  double least_radius = 0;
  for (const Excavation<Dim>* region : regions)
    least_radius = std::max(least_radius, region->least_radius);

  const std::size_t count = model.bodies.size();
  Excavated<Dim> moved;
  moved.origin.resize(count);
  std::iota(moved.origin.begin(), moved.origin.end(), 0);
  moved.shift.assign(count, Vector<Dim>::Zero());
  std::vector<PartId> now = model.parts;
  std::size_t first = 0;  // part of the body
  for (std::size_t b = 0; b < count; ++b) {
    Body<Dim>& body = model.bodies[b];
    const std::size_t parts = body.parts.size(), begin = first;
    first += parts;
    if (!body.present) continue;
    std::vector<int> left;
    for (std::size_t k = 0; k < parts; ++k) {
      const Vector<Dim> centroid = body.reference + body.parts[k].mass.centroid;
      if (std::ranges::none_of(regions, [&](const auto* region) { return lies_inside<Dim>(region->region, centroid); }))
        left.push_back(static_cast<int>(k));
    }
    if (left.size() == parts) continue;
    std::vector<std::vector<int>> pieces;
    if (!left.empty()) pieces = pieces_left(model, body, left);
    if (!body.fixed)
      std::erase_if(pieces, [&](const std::vector<int>& piece) {
        return std::ranges::all_of(piece, [&](int k) { return body.parts[k].inscribed_radius < least_radius; });
      });
    if (pieces.empty()) {
      body.present = false;
      body.fixed = true;
      continue;
    }
    divide<Dim>(model, static_cast<int>(b), pieces, std::span(now).subspan(begin, parts), moved);
  }
  std::erase_if(model.applied, [](const AppliedForce<Dim>& f) { return f.force.isZero(0); });
  std::ranges::stable_sort(model.applied, {}, &AppliedForce<Dim>::body);
  std::ranges::stable_sort(model.prescribed, {}, &PrescribedMotion<Dim>::body);

  list_parts(model);
  std::vector<int> first_part(model.bodies.size());
  for (std::size_t i = model.parts.size(); i-- > 0;)
    first_part[model.parts[i].body] = static_cast<int>(i);
  for (const PartId& part : now)
    moved.part.push_back(part.body < 0 ? -1 : first_part[part.body] + part.part);
  bound_water_stiffness(model);
  return moved;
}

template <int Dim>
bool follow(const Model<Dim>& before, const Model<Dim>& model, const Excavated<Dim>& moved, int& body,
            Vector<Dim>& place) {
  const auto first = std::ranges::find(before.parts, body, &PartId::body) - before.parts.begin();
  const int part = moved.part[first + part_at<Dim>(before.bodies[body], place)];
  if (part < 0 || !model.bodies[model.parts[part].body].present) return false;
  body = model.parts[part].body;
  place -= moved.shift[body];
  return true;
}

template bool follow<2>(const Model<2>&, const Model<2>&, const Excavated<2>&, int&, Vector<2>&);
template bool follow<3>(const Model<3>&, const Model<3>&, const Excavated<3>&, int&, Vector<3>&);
template int part_at<2>(const Body<2>&, const Vector<2>&);
template int part_at<3>(const Body<3>&, const Vector<3>&);
template Excavated<2> excavate<2>(Model<2>&, const std::vector<std::string>&);
template Excavated<3> excavate<3>(Model<3>&, const std::vector<std::string>&);

template int body_around<2>(const Model<2>&, const Vector<2>&);
template int body_around<3>(const Model<3>&, const Vector<3>&);

}  // namespace voussoir
