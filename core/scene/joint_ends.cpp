#include "core/scene/joint_ends.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <limits>

#include "core/geometry/outline.hpp"
#include "core/scene/bodies.hpp"
#include "core/scene/region.hpp"

namespace voussoir {
namespace {

// a point this near to a plane, relative to its distance from the middle of the domain, is on it within the accuracy of
// coordinates
constexpr double on_its_plane = 1e-9;

// joints whose planes intersect at less than this angle (rad) are parallel within the accuracy of angles with six
// digits
constexpr double parallel = 1e-6;

template <class Specs, class Name>
std::size_t place_of(const Specs& specs, const std::string& name, const Name& name_of) {
  return std::find_if(specs.begin(), specs.end(), [&](const auto& spec) { return name_of(spec) == name; }) -
         specs.begin();
}

// the meaning of a name in ends_at: a joint, or else an excavation
struct Named {
  std::size_t joint, excavation;  // equal to their number: none
};

Named named_by(const Scene& scene, const std::string& name) {
  return {place_of(scene.joints, name, [](const JointSpec& spec) { return spec.name; }),
          place_of(scene.excavations, name, [](const ExcavationSpec& spec) { return spec.name; })};
}

// throws the error of a name
void check_name(const Scene& scene, std::size_t joint, const std::string& name, const Named& named) {
  const JointSpec& spec = scene.joints[joint];
  const std::string shown = "'" + one_line(name, 60) + "'";
  const bool is_joint = named.joint < scene.joints.size(), is_excavation = named.excavation < scene.excavations.size();
  if (!is_joint && !is_excavation) {
    std::vector<std::string> there;
    for (std::size_t j = 0; j < joint; ++j)
      there.push_back(scene.joints[j].name);
    for (const ExcavationSpec& excavation : scene.excavations)
      there.push_back(excavation.name);
    refuse(spec.subject, "ends_at",
           fmt::format("no joint and no excavation is named {}; {}", shown, suggestion(name, there)));
  }
  if (is_joint && is_excavation)
    refuse(spec.subject, "ends_at", shown + " is a joint and an excavation; give one of them another name");
  if (named.joint == joint) refuse(spec.subject, "ends_at", shown + " is the joint itself; name another one");
  if (is_joint && named.joint > joint)
    refuse(spec.subject, "ends_at",
           fmt::format("{} comes later, and a joint can only end at earlier ones; {}", shown,
                       scene.joints[named.joint].subject.path.starts_with("joint_sets")
                           ? "joints of sets are cut after those of [[joints]]"
                           : "state it after the one that it ends at"));
  if (is_excavation && !scene.excavations[named.excavation].outline)
    refuse(spec.subject, "ends_at",
           fmt::format("{} is an excavation without an outline, so that its faces are no cuts; write outline = true "
                       "there",
                       shown));
}

[[noreturn]] void refuse_point(const JointSpec& spec, const std::string& name) {
  refuse(spec.subject, "point",
         fmt::format("is on '{}', which ends_at names, so that either side could be kept; move it along the joint to "
                     "the side on which the "
                     "joint is",
                     one_line(name, 60)));
}

template <int Dim>
HalfSpace<Dim> kept_side(const JointSpec& spec, const JointSpec& other, const Vector<Dim>& origin) {
  const HalfSpace<Dim> own = to_half_space<Dim>(spec.plane, origin), plane = to_half_space<Dim>(other.plane, origin);
  if ((own.normal - own.normal.dot(plane.normal) * plane.normal).norm() < parallel)
    refuse(spec.subject, "ends_at",
           fmt::format("the joint is parallel to '{}' and never meets it; name another, or remove it",
                       one_line(other.name, 60)));
  const Vector<Dim> point = to_vector<Dim>(spec.plane.point) - origin;
  const double distance = signed_distance<Dim>(plane, point);
  if (std::abs(distance) <= on_its_plane * (point.norm() + std::abs(plane.offset))) refuse_point(spec, other.name);
  return distance < 0 ? plane : HalfSpace<Dim>{-plane.normal, -plane.offset};
}

// area (2-D: length) of a joint's plane inside the domain and a region, one face of which may be left out
template <int Dim>
double section_of(const HalfSpace<Dim>& plane, Polytope<Dim> domain, const HalfSpaces<Dim>& region,
                  std::size_t left_out = std::numeric_limits<std::size_t>::max()) {
  for (std::size_t f = 0; f < region.size(); ++f)
    if (f != left_out) domain.faces.push_back(region[f]);
  return measure_inside(plane, Outline<Dim>{}, domain);
}

// The face of a region that the point of a joint sees along the joint: of those that bound its section, the one beyond
// which the point is farthest. Inside, all of them.
template <int Dim>
HalfSpaces<Dim> kept_of_region(const JointSpec& spec, const ExcavationSpec& excavation, const Polytope<Dim>& domain,
                               const Vector<Dim>& origin) {
  const HalfSpaces<Dim> region = region_planes<Dim>(excavation.region, origin);
  const HalfSpace<Dim> plane = to_half_space<Dim>(spec.plane, origin);
  const double section = section_of<Dim>(plane, domain, region);
  if (!(section > 0))
    refuse(spec.subject, "ends_at",
           fmt::format("the joint's plane misses the excavation '{}' in the domain; move it, or remove it from ends_at",
                       one_line(excavation.name, 60)));
  const Vector<Dim> point = to_vector<Dim>(spec.plane.point) - origin;
  double farthest = -std::numeric_limits<double>::infinity();
  std::size_t seen = 0;
  for (std::size_t f = 0; f < region.size(); ++f) {
    const double along = (region[f].normal - region[f].normal.dot(plane.normal) * plane.normal).norm();
    constexpr double more = 1 + 1e-9;  // rounding of two areas
    if (along < parallel || section_of<Dim>(plane, domain, region, f) <= more * section) continue;
    const double distance = signed_distance<Dim>(region[f], point) / along;
    if (distance > farthest) farthest = distance, seen = f;
  }
  if (std::abs(farthest) <= on_its_plane * (point.norm() + std::abs(region[seen].offset)))
    refuse_point(spec, excavation.name);
  if (farthest < 0) return region;
  return {{-region[seen].normal, -region[seen].offset}};
}

// Each cut as soon as all cuts that must precede it are made.
template <int Dim>
void put_behind(std::vector<Cut<Dim>>& cuts, const std::map<int, std::vector<int>>& behind) {
  std::map<int, std::size_t> place;  // by joint
  for (std::size_t i = 0; i < cuts.size(); ++i)
    place[cuts[i].joint] = i;
  std::vector<std::size_t> open(cuts.size(), 0);
  std::vector<std::vector<std::size_t>> followers(cuts.size());
  for (const auto& [joint, others] : behind)
    for (const int other : others) {
      ++open[place.at(joint)];
      followers[place.at(other)].push_back(place.at(joint));
    }
  std::vector<std::size_t> order, ready;
  for (std::size_t i = 0; i < cuts.size(); ++i) {
    if (open[i] > 0) continue;
    ready.push_back(i);
    while (!ready.empty()) {
      const std::size_t next = ready.back();
      ready.pop_back();
      order.push_back(next);
      // later entries of the order are handled there
      for (auto follower = followers[next].rbegin(); follower != followers[next].rend(); ++follower)
        if (--open[*follower] == 0 && *follower < i) ready.push_back(*follower);
    }
  }
  std::vector<Cut<Dim>> ordered;
  for (const std::size_t i : order)
    ordered.push_back(std::move(cuts[i]));
  cuts = std::move(ordered);
}

}  // namespace

template <int Dim>
HalfSpaces<Dim> end_bounds(const Scene& scene, std::size_t joint, const Polytope<Dim>& domain,
                           const Vector<Dim>& origin) {
  const JointSpec& spec = scene.joints[joint];
  HalfSpaces<Dim> bounds;
  if (scene.slicing.ends == JointEnds::ignored) return bounds;
  for (const std::string& name : spec.ends_at) {
    const Named named = named_by(scene, name);
    check_name(scene, joint, name, named);
    if (named.joint < scene.joints.size()) {
      bounds.push_back(kept_side<Dim>(spec, scene.joints[named.joint], origin));
    } else {
      const HalfSpaces<Dim> kept = kept_of_region<Dim>(spec, scene.excavations[named.excavation], domain, origin);
      bounds.insert(bounds.end(), kept.begin(), kept.end());
    }
  }
  return bounds;
}

template <int Dim>
void end_cuts(const Scene& scene, const Polytope<Dim>& domain, const Vector<Dim>& origin,
              const std::vector<std::vector<int>>& faces, std::vector<Cut<Dim>>& cuts) {
  std::map<int, std::vector<int>> behind;
  for (Cut<Dim>& cut : cuts) {
    const auto joint = static_cast<std::size_t>(cut.joint);
    if (joint >= scene.joints.size()) continue;
    const HalfSpaces<Dim> bounds = end_bounds<Dim>(scene, joint, domain, origin);
    if (bounds.empty()) continue;
    cut.extent.bounds.insert(cut.extent.bounds.end(), bounds.begin(), bounds.end());
    std::vector<int>& others = behind[cut.joint];
    for (const std::string& name : scene.joints[joint].ends_at) {
      const Named named = named_by(scene, name);
      if (named.joint < scene.joints.size())
        others.push_back(static_cast<int>(named.joint));
      else
        others.insert(others.end(), faces[named.excavation].begin(), faces[named.excavation].end());
    }
  }
  if (!behind.empty()) put_behind(cuts, behind);
}

template HalfSpaces<2> end_bounds<2>(const Scene&, std::size_t, const Polytope<2>&, const Vector<2>&);
template HalfSpaces<3> end_bounds<3>(const Scene&, std::size_t, const Polytope<3>&, const Vector<3>&);
template void end_cuts<2>(const Scene&, const Polytope<2>&, const Vector<2>&, const std::vector<std::vector<int>>&,
                          std::vector<Cut<2>>&);
template void end_cuts<3>(const Scene&, const Polytope<3>&, const Vector<3>&, const std::vector<std::vector<int>>&,
                          std::vector<Cut<3>>&);

}  // namespace voussoir
