#include "app/check/judge_supports.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <utility>

#include "core/stage/install_bolts.hpp"
#include "core/stage/install_linings.hpp"

namespace voussoir {
namespace {

// of a bolt's length: the precision of numbers in a scene
constexpr double same_place = 1e-6;

// A bolt's straight line without its ends: unit direction and the point nearest to the origin, rounded so that bolts on
// one line have the same.
template <int Dim>
std::array<long long, 2 * Dim> line_of(const Bolt<Dim>& bolt, double grid) {
  Vector<Dim> along = (bolt.toe - bolt.collar).normalized();
  for (int k = 0; k < Dim; ++k) {
    if (std::abs(along[k]) <= same_place) continue;
    if (along[k] < 0) along = -along;
    break;
  }
  const Vector<Dim> foot = bolt.collar - bolt.collar.dot(along) * along;
  // the offset keeps numbers on a grid away from the border between two cells
  const auto cell = [&](double x) { return std::llround(x / grid + 0.3); };
  std::array<long long, 2 * Dim> key;
  for (int k = 0; k < Dim; ++k) {
    key[k] = std::llround(along[k] / (10 * same_place) + 0.3);
    key[Dim + k] = cell(foot[k]);
  }
  return key;
}

// those that overlap with one before them
template <int Dim>
std::vector<int> bolts_on_others(const Model<Dim>& model) {
  double longest = 0;
  for (const Bolt<Dim>& bolt : model.bolts)
    longest = std::max(longest, (bolt.toe - bolt.collar).norm());
  const double grid = 10 * same_place * longest;
  std::map<std::array<long long, 2 * Dim>, std::vector<int>> lines;
  for (std::size_t i = 0; i < model.bolts.size(); ++i)
    lines[line_of(model.bolts[i], grid)].push_back(static_cast<int>(i));
  std::vector<int> again;
  for (const auto& [line, bolts] : lines) {
    const Vector<Dim> along = (model.bolts[bolts.front()].toe - model.bolts[bolts.front()].collar).normalized();
    struct Length {
      double begin, end;
      int bolt;
    };
    std::vector<Length> lengths;
    for (const int i : bolts) {
      const double a = model.bolts[i].collar.dot(along), b = model.bolts[i].toe.dot(along);
      lengths.push_back({std::min(a, b), std::max(a, b), i});
    }
    std::ranges::stable_sort(lengths, {}, &Length::begin);
    double reached = -std::numeric_limits<double>::infinity();
    for (const Length& length : lengths) {
      if (length.begin < reached - grid) again.push_back(length.bolt);
      reached = std::max(reached, length.end);
    }
  }
  return again;
}

// bolts in the plane of a joint, with the first such joint; in a very large scene only the first bolts are tested
template <int Dim>
std::vector<std::pair<int, int>> bolts_in_joints(const Model<Dim>& model) {
  constexpr std::size_t most_pairs = 20'000'000;
  std::vector<std::pair<int, int>> found;
  if (model.joints.empty()) return found;
  const std::size_t bolts = std::min(model.bolts.size(), most_pairs / model.joints.size());
  for (std::size_t i = 0; i < bolts; ++i) {
    const Bolt<Dim>& bolt = model.bolts[i];
    const double near = same_place * (bolt.toe - bolt.collar).norm();
    for (std::size_t j = 0; j < model.joints.size(); ++j) {
      const HalfSpace<Dim>& plane = model.joints[j].plane;
      if (std::abs(signed_distance<Dim>(plane, bolt.collar)) > near ||
          std::abs(signed_distance<Dim>(plane, bolt.toe)) > near)
        continue;
      found.emplace_back(static_cast<int>(i), static_cast<int>(j));
      break;
    }
  }
  return found;
}

}  // namespace

template <int Dim>
void judge_bolts(const Model<Dim>& model, const State<Dim>& state, std::vector<std::string>& warnings) {
  struct Count {
    int all = 0, idle = 0, in_the_open = 0, again = 0, in_joint = 0;
    std::string joint;
  };
  std::vector<Count> counts(model.bolt_properties.size());
  for (const int bolt : bolts_on_others(model))
    ++counts[model.bolts[bolt].properties].again;
  for (const auto& [bolt, joint] : bolts_in_joints(model)) {
    Count& count = counts[model.bolts[bolt].properties];
    if (count.in_joint++ == 0) count.joint = model.joints[joint].name;
  }
  for (std::size_t i = 0; i < model.bolts.size(); ++i) {
    Count& count = counts[model.bolts[i].properties];
    ++count.all;
    count.idle += springs_of(model, state, static_cast<int>(i)).empty();
    count.in_the_open += !ends_in_rock(model, state, static_cast<int>(i));
  }
  for (std::size_t p = 0; p < counts.size(); ++p) {
    const Count& count = counts[p];
    const std::string& name = model.bolt_properties[p].name;
    // at this node spacing a bar is an eighth of its square, 3 %, too soft across a joint
    constexpr double coarse = 0.5;
    const BoltProperties& properties = model.bolt_properties[p];
    if (properties.node_spacing && *properties.node_spacing > coarse * transfer_length(properties))
      warnings.push_back(fmt::format(
          "bolts.{}: node_spacing, {:g} m, is more than half of the {:.2g} m over which the bond builds up the "
          "bar force: the slip of the bond is underestimated; lower it, or leave it out",
          name, *properties.node_spacing, transfer_length(properties)));
    if (count.idle > 0)
      warnings.push_back(
          fmt::format("bolts.{}: {} of {} cross no joint of the blocks as they are cut and would support "
                      "nothing: check their positions, and that lengths are in m",
                      name, count.idle, count.all));
    if (count.in_the_open > 0)
      warnings.push_back(
          fmt::format("bolts.{}: {} of {} end outside of all blocks: check their positions, and that "
                      "lengths are in m",
                      name, count.in_the_open, count.all));
    if (count.again > 0)
      warnings.push_back(
          fmt::format("bolts.{}: {} of {} overlap another bolt: check from, to and repeat, or the fan's angles "
                      "and spacing_deg",
                      name, count.again, count.all));
    if (count.in_joint > 0)
      warnings.push_back(
          fmt::format("bolts.{}: {} of {} are in the plane of a joint ('{}') and do not tie its sides: move or turn "
                      "them",
                      name, count.in_joint, count.all, count.joint));
  }
}

template <int Dim>
void judge_linings(const Model<Dim>& model, const State<Dim>& state, std::vector<std::string>& warnings) {
  constexpr int least_on_side = 3, least_on_stretch = 2;
  constexpr double least_slenderness = 1.0 / 3;
  constexpr double unusual_section = 20;  // times, or a fraction, of a rectangle's
  if constexpr (Dim == 2)
    for (const Lining& lining : model.linings) {
      const std::string& name = lining.properties.name;
      double outline = 0, beams = 0;
      for (const LiningSide& side : lining.sides)
        outline += side.length;
      for (const LiningNode& node : lining.nodes)
        beams += node.half_length[0] + node.half_length[1];
      const double spacing = beams / lining.beams();
      LiningProperties rectangle = lining.properties;
      rectangle.bending_stiffness.reset();
      const double of_rectangle = lining.properties.bending() / rectangle.bending();
      if (of_rectangle > unusual_section || of_rectangle * unusual_section < 1)
        warnings.push_back(
            fmt::format("linings.{}.bending_stiffness = {:.3g} N m²/m is {:.2g} times young_modulus thickness³ / 12 = "
                        "{:.3g}: was it given in MN m²/m?",
                        name, lining.properties.bending(), of_rectangle, rectangle.bending()));
      if (const double thickness = lining.properties.thickness; spacing < least_slenderness * thickness)
        warnings.push_back(
            fmt::format("linings.{}.nodes: beams of {:.3g} m are much shorter than the lining is thick, {:.3g} m: they "
                        "add no accuracy and reduce the time step: state {:.0f} or fewer",
                        name, spacing, thickness, std::floor(beams / (least_slenderness * thickness))));
      if (outline < least_on_side * spacing * static_cast<double>(lining.sides.size()))
        warnings.push_back(fmt::format(
            "linings.{}.nodes: beams of {:.3g} m on {} sides of {:.3g} m cut the outline's corners; state at least {}",
            name, spacing, lining.sides.size(), outline / static_cast<double>(lining.sides.size()),
            least_on_side * lining.sides.size()));
      const auto blocks = static_cast<double>(rock_around(model, state, lining).size());
      const double stretch = outline / std::max(1.0, blocks);
      if (stretch < least_on_stretch * spacing)
        warnings.push_back(
            fmt::format("linings.{}.nodes: beams of {:.3g} m, but the blocks as they are cut are {:.3g} m wide along "
                        "the outline: state "
                        "at least {:.0f} nodes, so that each block touches two",
                        name, spacing, stretch, least_on_stretch * beams / stretch));
    }
}

template void judge_bolts<2>(const Model<2>&, const State<2>&, std::vector<std::string>&);
template void judge_bolts<3>(const Model<3>&, const State<3>&, std::vector<std::string>&);
template void judge_linings<2>(const Model<2>&, const State<2>&, std::vector<std::string>&);
template void judge_linings<3>(const Model<3>&, const State<3>&, std::vector<std::string>&);

}  // namespace voussoir
