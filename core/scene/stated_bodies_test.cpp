// Parts of one body that overlap: refused with the volume that they share, by Lasserre's recursion over planes.
#include "core/scene/stated_bodies.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/testing/bad_scenes.hpp"
#include "core/testing/oracles.hpp"
#include "core/testing/shapes.hpp"

namespace voussoir::stated_bodies_test {
namespace {

using namespace shapes;
using bad_scenes::complaint_about;

template <int Dim>
std::string head() {
  return fmt::format(
      "dimension = {}\ndensity = 1000\nstage = [{{ name = \"s\", kind = \"settle\" }}]\n"
      "joint_properties = [{{ name = \"rock\", normal_stiffness = 1e9, shear_stiffness = 1e9, friction_deg = 30 }}]\n",
      Dim);
}

template <int Dim>
std::string block_text(const std::string& name, const HalfSpaces<Dim>& planes, const std::string& owner = "") {
  std::string text = fmt::format("[[blocks]]\nname = \"{}\"\n", name);
  if (!owner.empty()) text += fmt::format("part_of = \"{}\"\n", owner);
  text += "planes = [";
  for (const HalfSpace<Dim>& plane : planes) {
    text += "{ normal = [";
    for (int k = 0; k < Dim; ++k)
      text += fmt::format("{:.17g}, ", plane.normal[k]);
    text += fmt::format("], offset = {:.17g} }}, ", plane.offset);
  }
  return text + "]\n";
}

template <int Dim>
double volume_of(HalfSpaces<Dim> planes) {
  // no two planes may coincide
  for (std::size_t i = 0; i < planes.size(); ++i)
    for (std::size_t j = planes.size() - 1; j > i; --j)
      if ((planes[i].normal - planes[j].normal).norm() < 1e-12) {
        planes[i].offset = std::min(planes[i].offset, planes[j].offset);
        planes.erase(planes.begin() + static_cast<long>(j));
      }
  return static_cast<double>(oracle::volume<Dim>(planes));
}

template <int Dim>
HalfSpaces<Dim> shared(HalfSpaces<Dim> a, const HalfSpaces<Dim>& b) {
  a.insert(a.end(), b.begin(), b.end());
  return a;
}

// the number before a word
double number_before(const std::string& text, const std::string& word) {
  const std::size_t end = text.find(word);
  if (end == std::string::npos) return -1;
  const std::size_t begin = text.rfind(' ', end - 1);
  return std::stod(text.substr(begin + 1, end - begin - 1));
}

// A plate or a block, and another that penetrates one of its faces by 1e-9 to 1 of its own width. Both are rotated
// together.
template <int Dim>
struct Pair {
  HalfSpaces<Dim> a, b;

  explicit Pair(Random& random) {
    const double thin = integer(random, 0, 1) ? power_of_ten(random, -4, 0) : 1;
    const double by = power_of_ten(random, -9, 0) * thin;
    Vector<Dim> low = Vector<Dim>::Constant(-1), high = Vector<Dim>::Constant(1);
    low[0] = -thin;
    high[0] = thin;
    a = box<Dim>(low, high);
    Vector<Dim> shift = Vector<Dim>::Zero();
    for (int k = 1; k < Dim; ++k)
      shift[k] = uniform(random, -1, 1);
    const double width = power_of_ten(random, -2, 0);
    low[0] = thin - by;
    high[0] = thin - by + width;
    b = box<Dim>(low, high);
    for (HalfSpace<Dim>& plane : b)
      plane.offset += plane.normal.dot(shift);
    // some corners are cut off
    for (int k = integer(random, 0, 2); k > 0; --k) {
      const Vector<Dim> n = direction<Dim>(random);
      a.push_back({n, 0.7 * (std::abs(n[0]) * thin + (n.cwiseAbs().sum() - std::abs(n[0])))});
    }
    const Matrix<Dim> turn = matrix(orientation<Dim>(random));
    const Vector<Dim> place = Vector<Dim>::Constant(uniform(random, -5, 5));
    a = placed<Dim>(a, turn, place);
    b = placed<Dim>(b, turn, place);
  }
};

template <int Dim>
void expect_overlaps_refused() {
  Random random(70 + Dim);
  int refused = 0, accepted = 0;
  for (int i = 0; i < 300; ++i) {
    const Pair<Dim> pair(random);
    const double of_a = volume_of<Dim>(pair.a), of_b = volume_of<Dim>(pair.b),
                 both = volume_of<Dim>(shared<Dim>(pair.a, pair.b));
    const double fraction = both / std::min(of_a, of_b);
    if (std::abs(fraction / 1e-6 - 1) < 0.01) continue;  // 1e-8 of a width: coordinates of 5 m round by 1e-16
    const std::string text = head<Dim>() + block_text<Dim>("a", pair.a) + block_text<Dim>("a2", pair.b, "a");
    const std::string message = complaint_about(text);
    SCOPED_TRACE(fmt::format("{}: {} of the smaller one, {}", i, fraction, message));
    if (fraction > 1e-6) {
      ++refused;
      EXPECT_NE(message.find("blocks.a2.part_of = \"a\": overlaps part 'a' of the same body by"), std::string::npos);
      // the coordinates' rounding over the depth of penetration
      EXPECT_NEAR(number_before(message, Dim == 2 ? " m²" : " m³") / both, 1, 1e-5 + 1e-13 / fraction);
      EXPECT_NEAR(number_before(message, " of the smaller one;") / fraction, 1, 0.006 + 1e-13 / fraction);
    } else {
      ++accepted;
      ASSERT_EQ(message, "");
      const Model<Dim> model = prepare<Dim>(parse_scene(text, "scene.toml")).model;
      EXPECT_NEAR(model.bodies.front().mass / (1000 * (of_a + of_b)), 1, 1e-9) << "mass is that of the parts as stated";
    }
  }
  EXPECT_GT(refused, 50);
  EXPECT_GT(accepted, 50);
}

TEST(PartsOfABody, ThatOverlapAreRefused) {
  expect_overlaps_refused<2>();
  expect_overlaps_refused<3>();
}

template <int Dim>
std::string box_text(const std::string& name, const std::vector<double>& low, const std::vector<double>& high,
                     const std::string& more = "") {
  return fmt::format("[[blocks]]\nname = \"{}\"\nbox = {{ min = [{}], max = [{}] }}\n{}", name, fmt::join(low, ", "),
                     fmt::join(high, ", "), more);
}

TEST(PartsOfABody, AreRefusedAsStated) {
  const std::string a = box_text<3>("a", {0, 0, 0}, {1.5, 1, 1}), of_a = "part_of = \"a\"\n";
  const auto told = [&](const std::string& text, const std::string& phrase) {
    const std::string message = complaint_about(head<3>() + text);
    EXPECT_NE(message.find(phrase), std::string::npos) << message;
    EXPECT_EQ(message.find('\n'), std::string::npos);
  };
  told(a + box_text<3>("a2", {0.5, 0, 0}, {2, 1, 1}, of_a), "by 1 m³, 0.667 of the smaller one");
  told(box_text<3>("a2", {0.5, 0, 0}, {2, 1, 1}, of_a) + a, "blocks.a2.part_of = \"a\": overlaps part 'a'");
  told(a + box_text<3>("twice", {0, 0, 0}, {1.5, 1, 1}, of_a), "by 1.5 m³, 1 of the smaller one");
  told(a + box_text<3>("within", {0.5, 0.25, 0.25}, {1, 0.75, 0.75}, of_a), "by 0.125 m³, 1 of the smaller one");
  told(a + box_text<3>("b", {1.5, 0, 0}, {3, 1, 1}, of_a) + box_text<3>("c", {2, 0, 0}, {3, 1, 1}, of_a),
       "blocks.c.part_of = \"a\": overlaps part 'b'");
  const std::string copies = a + box_text<3>("side", {1.5, 0, 0}, {2, 1, 1}, of_a);
  EXPECT_EQ(
      complaint_about(head<3>() + copies + "[[repeat]]\nblocks = [\"a\", \"side\"]\ncount = 2\nshift = [5, 0, 0]\n"),
      "");
  told(a + box_text<3>("side", {1.25, 0, 0}, {2, 1, 1}, of_a) +
           "[[repeat]]\nblocks = [\"a\", \"side\"]\ncount = 2\nshift = [5, 0, 0]\n",
       "blocks.side-1.part_of = \"a-1\": overlaps part 'a-1' of the same body by 0.25 m³");
  // faces, edges and corners may touch; separate bodies are not affected
  EXPECT_EQ(complaint_about(head<3>() + a + box_text<3>("face", {1.5, 0.2, 0.2}, {2, 2, 0.8}, of_a) +
                            box_text<3>("edge", {-1, -1, 0}, {0, 0, 1}, of_a) +
                            box_text<3>("corner", {-1, -1, 1}, {0, 0, 2}, of_a)),
            "");
  EXPECT_EQ(complaint_about(head<3>() + a + box_text<3>("b", {0.5, 0, 0}, {2, 1, 1})), "");
}

// rounded bodies: two spheres of radius 1 whose centres are 1 apart share a lens of 5 π/12
TEST(PartsOfABody, ThatArePotentialParticlesAreRefusedToo) {
  const auto complaint = [](double apart) {
    std::string text = head<3>();
    text.replace(text.find("friction_deg"), 0, "constant_stiffness = true, ");
    for (const double x : {0.0, apart})
      text += fmt::format(
          "[[blocks]]\nname = \"{}\"\nshape = \"potential\"\nsphericity = 1\nsphere_radius = 1\n"
          "centre = [{}, 0, 0]\n{}",
          x == 0 ? "ball" : "second", x, x == 0 ? "" : "part_of = \"ball\"\n");
    return complaint_about(text);
  };
  EXPECT_NEAR(number_before(complaint(1), " m³"), 5 * std::numbers::pi / 12, 0.03);
  EXPECT_NE(complaint(1).find("by about"), std::string::npos);
  EXPECT_NE(complaint(1.99).find("overlaps"), std::string::npos);
  EXPECT_EQ(complaint(2), "");
}

}  // namespace
}  // namespace voussoir::stated_bodies_test
