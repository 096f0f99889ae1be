#include "core/output/failure_mechanism.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>

namespace voussoir {
namespace {

// number of blocks, joints and clusters named in a sentence; results.json has all
constexpr std::size_t most_blocks_named = 6, most_joints_in_sentence = 3, most_clusters_of_a_kind = 2;

// from this share on it is "all of the free mass"
constexpr double all_mass = 0.9995;

constexpr double vertical = 89.95;  // deg

struct MotionWords {
  const char *one, *several;
};
constexpr MotionWords motion_words[] = {{"slides", "slide"}, {"falls", "fall"},
                                        {"lifts", "lift"},   {"topples", "topple"},
                                        {"slumps", "slump"}, {"slides and turns", "slide and turn"},
                                        {"turns", "turn"}};  // in the order of the enumeration

const MotionWords& words_of(FailureMotion motion) {
  return motion_words[static_cast<int>(motion)];
}

// three digits, more of numbers above a thousand
std::string three_digits(double number) {
  return number >= 1000 ? fmt::format("{:.0f}", number) : fmt::format("{:.3g}", number);
}

// "a, b and 3 more"; "a and b"
std::string list_of(const std::vector<std::string>& names, std::size_t most) {
  const std::size_t shown = names.size() > most ? most - 1 : names.size();
  std::vector<std::string> all(names.begin(), names.begin() + static_cast<std::ptrdiff_t>(shown));
  if (shown < names.size()) all.push_back(fmt::format("{} more", names.size() - shown));
  if (all.empty()) return "";
  const std::string last = all.back();
  all.pop_back();
  return all.empty() ? last : fmt::format("{} and {}", fmt::join(all, ", "), last);
}

std::string blocks_text(const std::vector<int>& bodies) {
  std::vector<std::string> names;
  for (const int body : bodies)
    names.push_back(fmt::format("{}", body));
  return (bodies.size() == 1 ? "block " : "blocks ") + list_of(names, most_blocks_named);
}

std::string joint_text(const MovingJoint& joint) {
  return joint.joint.empty() ? "faces that no joint made" : joint.joint;
}

std::string point_text(const std::vector<double>& point) {
  std::vector<std::string> numbers;
  for (const double x : point)
    numbers.push_back(fmt::format("{:.4g}", x + 0.0));
  return fmt::format("({})", fmt::join(numbers, ", "));
}

std::string direction_text(const MovingCluster& c, int dimension) {
  if (std::abs(c.plunge) > vertical) return c.plunge > 0 ? "straight down" : "straight up";
  if (dimension == 3) return fmt::format("{:.1f}/{:05.1f} (plunge/trend)", c.plunge, c.trend);
  return fmt::format("{:.1f} deg {} to the {}", std::abs(c.plunge), c.plunge < 0 ? "up" : "down",
                     c.trend < 180 ? "right" : "left");
}

std::vector<std::string> slipping_joints(const MovingCluster& c) {
  std::vector<std::string> names;
  for (const MovingJoint& joint : c.joints)
    if (joint.slips && joint.carries) names.push_back(joint_text(joint));
  return names;
}

std::string on_joints(const MovingCluster& c) {
  const std::vector<std::string> names = slipping_joints(c);
  if (names.empty()) return "";
  return (c.along_line ? " along the line of " : " on ") + list_of(names, most_joints_in_sentence);
}

std::string opening_joints(const MovingCluster& c) {
  std::vector<std::string> names;
  bool several = false;
  for (const MovingJoint& joint : c.joints)
    if (joint.opens && !joint.carries) {
      several = !names.empty() || joint.joint.empty();  // faces that no joint made
      names.push_back(joint_text(joint));
    }
  if (names.empty()) return "";
  return fmt::format("; {} open{}", list_of(names, most_joints_in_sentence), several ? "" : "s");
}

// how a cluster moves, after its verb
std::string manner_of(const MovingCluster& c, int dimension) {
  switch (c.motion) {
    case FailureMotion::slides:
      return on_joints(c) + ", " + direction_text(c, dimension) + opening_joints(c);
    case FailureMotion::falls:
    case FailureMotion::lifts:
      return ", " + direction_text(c, dimension) + opening_joints(c);
    case FailureMotion::topples:
      return " about the edge at " + point_text(c.about) + opening_joints(c);
    case FailureMotion::turns:
      return (c.at_edge ? " about the edge at " : " about ") + point_text(c.about) + opening_joints(c);
    case FailureMotion::slumps:
    case FailureMotion::slides_and_turns:
      break;
  }
  return on_joints(c) + ", turning about " + point_text(c.about) + opening_joints(c);
}

std::string size_text(double volume, double weight, double share, int dimension) {
  const std::string part = share >= all_mass ? "all" : fmt::format("{:.3g} %", 100 * share);
  return dimension == 3 ? fmt::format("({} m³, {} kN, {} of the free mass)", three_digits(volume),
                                      three_digits(weight / 1000), part)
                        : fmt::format("({} m³/m, {} kN/m, {} of the free mass)", three_digits(volume),
                                      three_digits(weight / 1000), part);
}

// those that move alike, the heaviest first
std::vector<std::string> clauses_of(const std::vector<const MovingCluster*>& clusters, int dimension) {
  std::vector<std::string> clauses;
  const MotionWords& words = words_of(clusters.front()->motion);
  if (clusters.size() <= most_clusters_of_a_kind) {
    for (const MovingCluster* c : clusters)
      clauses.push_back(fmt::format("{} {} {}{}", blocks_text(c->bodies),
                                    size_text(c->volume, c->weight, c->free_share, dimension),
                                    c->bodies.size() == 1 ? words.one : words.several, manner_of(*c, dimension)));
    return clauses;
  }
  std::vector<int> bodies;
  double volume = 0, weight = 0, share = 0;
  for (const MovingCluster* c : clusters) {
    bodies.insert(bodies.end(), c->bodies.begin(), c->bodies.end());
    volume += c->volume;
    weight += c->weight;
    share += c->free_share;
  }
  std::ranges::sort(bodies);
  const MovingCluster& largest = *clusters.front();
  clauses.push_back(fmt::format("{} {} {} in {} parts, the largest, {},{}", blocks_text(bodies),
                                size_text(volume, weight, share, dimension), words.several, clusters.size(),
                                blocks_text(largest.bodies), manner_of(largest, dimension)));
  return clauses;
}

// "no bond is broken, 2 have slipped, 1 is whole"
std::string bonds_clause(const BondsOfMotion& bonds) {
  std::string text = bonds.broken == 0   ? "no bond is broken"
                     : bonds.broken == 1 ? "1 bond is broken"
                                         : fmt::format("{} bonds are broken", bonds.broken);
  if (bonds.slipped > 0) text += fmt::format(", {} {} slipped", bonds.slipped, bonds.slipped == 1 ? "has" : "have");
  if (bonds.whole > 0) text += fmt::format(", {} {} whole", bonds.whole, bonds.whole == 1 ? "is" : "are");
  return text;
}

}  // namespace

const char* word_of(FailureMotion motion) {
  return words_of(motion).one;
}

std::vector<int> FailureMechanism::bodies() const {
  std::vector<int> all;
  for (const MovingCluster& cluster : clusters)
    all.insert(all.end(), cluster.bodies.begin(), cluster.bodies.end());
  std::ranges::sort(all);
  return all;
}

std::string sentence_of(const FailureMechanism& mechanism) {
  std::vector<FailureMotion> kinds;  // in the order of the clusters
  for (const MovingCluster& cluster : mechanism.clusters)
    if (std::ranges::find(kinds, cluster.motion) == kinds.end()) kinds.push_back(cluster.motion);
  std::vector<std::string> clauses;
  for (const FailureMotion kind : kinds) {
    std::vector<const MovingCluster*> alike;
    for (const MovingCluster& cluster : mechanism.clusters)
      if (cluster.motion == kind) alike.push_back(&cluster);
    for (std::string& clause : clauses_of(alike, mechanism.dimension))
      clauses.push_back(std::move(clause));
  }
  if (clauses.empty()) return "";
  if (mechanism.bonds) clauses.push_back(bonds_clause(*mechanism.bonds));
  return fmt::format("{}", fmt::join(clauses, "; "));
}

}  // namespace voussoir
