// The order in which a scene states its blocks, joints, properties, supports and monitors changes no bit of the result.
#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>
#include <set>
#include <sstream>

#include "core/model/state_hash.hpp"
#include "core/scene/scene.hpp"
#include "core/step.hpp"
#include "core/testing/models.hpp"

namespace voussoir::permuted_input_test {
namespace {

using shapes::Random;

// ---- scenes as text -------------------------------------------------------------------------------------------------

std::string read(const std::string& file) {
  std::ifstream stream(VOUSSOIR_SOURCE_DIR "/cases/" + file);
  EXPECT_TRUE(stream) << file;
  return {std::istreambuf_iterator<char>(stream), {}};
}

// A scene divided at its top-level tables, each with its subtables; the lines before the first table come first.
std::vector<std::string> tables_of(const std::string& text) {
  std::vector<std::string> tables{""};
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);) {
    const bool header = line.starts_with("["), below = line.substr(0, line.find(']')).find('.') != std::string::npos;
    if (header && !below) tables.emplace_back();
    tables.back() += line + "\n";
  }
  return tables;
}

// lists with one table per line, in another order
std::string with_lists_permuted(const std::string& text, Random& random) {
  std::string result;
  std::vector<std::string> list;
  const auto close_list = [&] {
    shapes::shuffle(list, random);
    for (const std::string& line : list)
      result += line;
    list.clear();
  };
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);) {
    if (line.starts_with("  { ")) {
      list.push_back(line + "\n");
      continue;
    }
    close_list();
    result += line + "\n";
  }
  close_list();
  return result;
}

// the same tables in another order; stages keep their order in time
std::string permuted(const std::string& text, Random& random) {
  std::vector<std::string> tables = tables_of(text);
  std::vector<std::string> rest(tables.begin() + 1, tables.end());
  shapes::shuffle(rest, random);
  const auto is_stage = [](const std::string& table) { return table.starts_with("[[stage]]"); };
  std::vector<std::string> stages;
  std::copy_if(tables.begin(), tables.end(), std::back_inserter(stages), is_stage);
  std::string result = with_lists_permuted(tables.front(), random);
  auto stage = stages.begin();
  for (const std::string& table : rest)
    result += is_stage(table) ? *stage++ : table;
  return result;
}

// ---- hashes ---------------------------------------------------------------------------------------------------------

struct Outcome {
  std::size_t bodies = 0;
  std::string start, end;  // of all blocks at the start as text, the state's hash at the end
  int touching = 0;
};

// every number that follows from the order of planes: a block's faces, vertices, mass and axes
template <int Dim>
std::string shapes_of(const Model<Dim>& model) {
  std::ostringstream text;
  text << std::hexfloat;
  for (const Body<Dim>& body : model.bodies) {
    text << body.reference.transpose() << body.mass << body.inertia.transpose() << body.principal_axes << body.fixed;
    for (const Polytope<Dim>& part : body.parts) {
      text << part.centre.transpose() << part.inscribed_radius << part.radius;
      for (const HalfSpace<Dim>& face : part.faces)
        text << face.normal.transpose() << face.offset;
      for (const Vector<Dim>& vertex : part.vertices)
        text << vertex.transpose();
    }
  }
  return text.str();
}

template <int Dim>
Outcome outcome_of(const std::string& text, int steps) {
  Prepared<Dim> prepared = prepare<Dim>(parse_scene(text, "scene.toml"));
  Outcome outcome{prepared.model.bodies.size(), shapes_of(prepared.model), "", 0};
  for (int i = 0; i < steps; ++i)
    step(prepared.model, prepared.settings, prepared.state);
  outcome.end = state_hash(prepared.model, prepared.state);
  for (const Contact<Dim>& c : prepared.state.contacts.list)
    outcome.touching += c.touching();
  return outcome;
}

template <int Dim>
void expect_no_order(const std::string& text, std::size_t bodies, int touching, int steps) {
  Random random(91);
  const Outcome stated = outcome_of<Dim>(text, steps);
  EXPECT_GE(stated.bodies, bodies);
  EXPECT_GE(stated.touching, touching);
  std::set<std::string> orders{text};
  for (int trial = 0; trial < 4; ++trial) {
    const std::string other = permuted(text, random);
    orders.insert(other);
    const Outcome outcome = outcome_of<Dim>(other, steps);
    EXPECT_EQ(outcome.bodies, stated.bodies);
    EXPECT_TRUE(outcome.start == stated.start) << "blocks, trial " << trial;
    EXPECT_EQ(outcome.end, stated.end) << "state, trial " << trial;
  }
  EXPECT_GT(orders.size(), 3u);
}

// ---- tests ----------------------------------------------------------------------------------------------------------

TEST(PermutedInput, TheJointsOfTheWedge) {
  expect_no_order<3>(read("wedge/scene.toml"), 4, 2, 300);
}

TEST(PermutedInput, TheBlocksOfTheColumn) {
  expect_no_order<3>(read("column/scene.toml"), 9, 8, 300);
}

// joints in random directions through a box, on a floor block; two tables of properties; blocks given by their corners
template <int Dim>
std::string jointed_box(int joints, std::uint64_t seed) {
  Random random(seed);
  const auto point = [&](double reach) {
    std::string text = "[";
    for (int k = 0; k < Dim; ++k)
      text += (k ? ", " : "") + std::to_string(shapes::uniform(random, -reach, reach));
    return text + "]";
  };
  const std::string low = Dim == 3 ? "[-1, -1, -1]" : "[-1, -1]", high = Dim == 3 ? "[1, 1, 1]" : "[1, 1]";
  const std::string floor_low = Dim == 3 ? "[-3, -3, -2]" : "[-3, -2]",
                    floor_high = Dim == 3 ? "[3, 3, -1]" : "[3, -1]";
  std::string text = "dimension = " + std::to_string(Dim) + "\ndensity = 2600\n";
  text += Dim == 3 ? "gravity = [4, 1, -9]\n" : "gravity = [4, -9]\n";
  text += "[domain]\nbox = { min = " + low + ", max = " + high + " }\n";
  for (int j = 0; j < joints; ++j) {
    const double direction = Dim == 3 ? shapes::uniform(random, 0, 360) : 90 + 180 * shapes::integer(random, 0, 1);
    text += "[[joints]]\nname = \"J" + std::to_string(j) +
            "\"\nproperties = \"rock\"\ndip = " + std::to_string(shapes::uniform(random, 0, 90)) +
            "\ndip_direction = " + std::to_string(direction) + "\npoint = " + point(0.5) + "\n";
  }
  const std::string stiffness = "normal_stiffness = 1e8\nshear_stiffness = 5e7\n";
  text += "[[joint_properties]]\nname = \"rock\"\nfriction_deg = 20\n" + stiffness;
  text += "[[joint_properties]]\nname = \"default\"\nfriction_deg = 10\n" + stiffness;
  text += "[[blocks]]\nname = \"floor\"\nfixed = true\nbox = { min = " + floor_low + ", max = " + floor_high + " }\n";
  text += "[[fix]]\nbelow = [\"J0\", \"J1\"]\n[[fix]]\nabove = [\"J2\", \"J3\", \"J0\"]\n";
  text += "[[stage]]\nname = \"slide\"\nkind = \"run\"\nduration_s = 1\n";
  return text;
}

TEST(PermutedInput, ABoxCutByRandomJoints) {
  expect_no_order<3>(jointed_box<3>(7, 92), 40, 60, 200);
  expect_no_order<2>(jointed_box<2>(10, 93), 30, 40, 300);
}

// a body of parts and blocks of corners: their parts and corners in another order
TEST(PermutedInput, PartsAndCorners) {
  const auto scene = [](const std::string& first, const std::string& second, const std::string& corners) {
    return "dimension = 3\ndensity = 2600\ngravity = [2, 1, -9]\n"
           "[[blocks]]\nname = \"L\"\nbox = " +
           first + "\n[[blocks]]\npart_of = \"L\"\nname = \"L2\"\nbox = " + second +
           "\n[[blocks]]\nname = \"floor\"\nfixed = true\nbox = { min = [-4, -4, -1], max = [4, 4, 0] }\n"
           "[[blocks]]\nname = \"pyramid\"\nvertices = [" +
           corners +
           "]\n[[joint_properties]]\nname = \"rock\"\nnormal_stiffness = 1e7\nshear_stiffness = 5e6\nfriction_deg = "
           "30\n"
           "[[stage]]\nname = \"run\"\nkind = \"run\"\nduration_s = 1\n";
  };
  const std::string lying = "{ min = [0.1, 0, 0], max = [1.3, 0.7, 0.4] }",
                    standing = "{ min = [0.1, 0, 0.4], max = [0.5, 0.7, 1.1] }";
  const Outcome one = outcome_of<3>(
      scene(lying, standing, "[-2, -2, 0], [-1, -2, 0], [-1.1, -1, 0], [-2, -1.2, 0], [-1.5, -1.4, 1]"), 300);
  const Outcome two = outcome_of<3>(
      scene(standing, lying, "[-1.5, -1.4, 1], [-1.1, -1, 0], [-2, -2, 0], [-2, -1.2, 0], [-1, -2, 0]"), 300);
  EXPECT_TRUE(one.start == two.start);
  EXPECT_EQ(one.end, two.end);
  EXPECT_GE(one.touching, 2);
}

}  // namespace
}  // namespace voussoir::permuted_input_test
