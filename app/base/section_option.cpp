#include "app/base/section_option.hpp"

#include <fmt/format.h>

#include "core/base/bad_input.hpp"
#include "text/angle.hpp"

namespace voussoir {
namespace {

constexpr const char* section_form =
    "dip/dip direction in degrees and x/y/z of a point in m, for example 90/180/0/5/0, the vertical plane y = 5";

SectionPlane section_plane(const std::string& text) {
  const std::vector<double> numbers = slashed(text, "--section", section_form);
  if (numbers.size() != 5 || numbers[0] < 0 || numbers[0] > 90 || numbers[1] < 0 || numbers[1] > 360)
    throw BadInput(
        fmt::format("--section {}: write {}; the dip is 0 to 90, its direction 0 to 360", text, section_form));
  return {{numbers[2], numbers[3], numbers[4]}, upward_normal_3d(numbers[0] * degree, numbers[1] * degree)};
}

std::string extent_of(const Model<3>& model) {
  Vector<3> low = Vector<3>::Constant(largest_argument), high = -low;
  for (const Body<3>& body : model.bodies)
    for (const Polytope<3>& part : body.parts)
      for (const Vector<3>& vertex : part.vertices) {
        const Vector<3> place = model.origin + body.reference + vertex;
        low = low.cwiseMin(place);
        high = high.cwiseMax(place);
      }
  return fmt::format("x {:.6g} to {:.6g}, y {:.6g} to {:.6g}, z {:.6g} to {:.6g} m", low[0], high[0], low[1], high[1],
                     low[2], high[2]);
}

}  // namespace

void add_section(CLI::App* command, std::vector<std::string>& sections, const std::string& layers) {
  add_repeated(command, "--section", sections,
               "write a drawing for CAD, section.dxf: the blocks cut by the plane of this dip and dip direction (deg) "
               "through this point (m), as closed lines in space, " +
                   layers + " by layers; repeat --section for each plane")
      ->type_name("DIP/DIRECTION/X/Y/Z")
      ->check(plain_text());
}

std::vector<SectionPolygon> section_polygons(const Model<2>&, const std::vector<std::string>& sections) {
  if (!sections.empty())
    throw BadInput(
        "--section cuts blocks in space but the scene has dimension = 2: --dxf draws the blocks in its plane");
  return {};
}

std::vector<SectionPolygon> section_polygons(const Model<3>& model, const std::vector<std::string>& sections) {
  std::vector<SectionPolygon> all;
  if (model.particles && !sections.empty())
    throw BadInput(
        "--section cuts blocks of half-spaces but the scene has potential particles: cut blocks.vtp in ParaView");
  for (const std::string& section : sections) {
    const std::vector<SectionPolygon> polygons = cut_blocks(model, section_plane(section));
    if (polygons.empty())
      throw BadInput(
          fmt::format("--section {}: the plane cuts no block; the blocks have {}: move its point x/y/z there", section,
                      extent_of(model)));
    all.insert(all.end(), polygons.begin(), polygons.end());
  }
  return all;
}

}  // namespace voussoir
