// Frames for ParaView, read back.
#include "core/output/paraview.hpp"

#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>

#include "core/output/xml_reader_test.hpp"
#include "core/slicing/block.hpp"
#include "core/testing/temporary_folder.hpp"

namespace voussoir::paraview_test {
namespace {

namespace fs = std::filesystem;
using test::Element;
using test::XmlReader;

// unit cubes (squares) in a row, the first fixed, all far from the origin; the second moved and rotated by 90 degrees
template <int Dim>
Model<Dim> row_of_blocks(int count) {
  Model<Dim> model;
  model.origin = Vector<Dim>::Constant(1000);
  model.joints.push_back({"A & B", {Vector<Dim>::Unit(0), 0}, 0});
  model.properties.push_back({"rock", 1e9, 1e8, 0.5, false});
  for (int b = 0; b < count; ++b) {
    HalfSpaces<Dim> planes;
    std::vector<int> joints;
    for (int k = 0; k < Dim; ++k)
      for (const double sign : {1.0, -1.0}) {
        planes.push_back({sign * Vector<Dim>::Unit(k), 0.5 + (k == 0 ? sign * b : 0)});
        joints.push_back(k == 0 && sign > 0 ? 0 : no_joint);
      }
    const BlockResult<Dim> block = make_block<Dim>(planes, joints);
    EXPECT_EQ(block.status, BlockStatus::ok);
    model.bodies.push_back(make_body<Dim>({block.part}, 2000));
    model.bodies.back().name = b == 0 ? "base" : "";
    model.bodies.back().fixed = b == 0;
  }
  list_parts(model);
  return model;
}

Spin<2> quarter_turn(const Model<2>&) {
  return Spin<2>(M_PI / 2);
}
Spin<3> quarter_turn(const Model<3>&) {
  return {0, 0, M_PI / 2};
}

template <int Dim>
State<Dim> moved_state(const Model<Dim>& model) {
  State<Dim> state = initial_state(model);
  state.bodies.motions[1].displacement = 0.25 * Vector<Dim>::Unit(1);
  state.bodies.motions[1].rotation = turned(state.bodies.motions[1].rotation, quarter_turn(model));
  state.bodies.motions[1].velocity = 2 * Vector<Dim>::Unit(0);
  Contact<Dim> contact;
  contact.part_a = 0, contact.part_b = 1;
  contact.geometry.point = 0.5 * Vector<Dim>::Unit(0);
  contact.geometry.normal = Vector<Dim>::Unit(0);
  contact.geometry.overlap = 1e-4;
  contact.force = 3 * Vector<Dim>::Unit(0);
  state.contacts.list = {contact, contact};
  state.contacts.list[0].status = ContactStatus::touching;  // the second is only a candidate
  return state;
}

// checks that apply to every .vtp, then returns the piece
Element checked_piece(const std::string& text, const char* kind, const char* count) {
  const Element root = XmlReader(text).read();
  EXPECT_EQ(root.name, "VTKFile");
  EXPECT_EQ(root.attributes.at("type"), "PolyData");
  const Element piece = root.child("PolyData").child("Piece");
  const double points = piece.number("NumberOfPoints"), cells = piece.number(count);
  EXPECT_EQ(piece.child("Points").named("Points").numbers().size(), 3 * points);

  const Element& connectivity = piece.child(kind).named("connectivity");
  const Element& offsets = piece.child(kind).named("offsets");
  EXPECT_EQ(connectivity.attributes.at("type"), "Int64");
  EXPECT_EQ(offsets.attributes.at("type"), "Int64");
  for (const double point : connectivity.numbers())
    EXPECT_TRUE(point >= 0 && point < points);
  const std::vector<double> ends = offsets.numbers();
  EXPECT_EQ(ends.size(), cells);
  for (std::size_t k = 1; k < ends.size(); ++k)
    EXPECT_GT(ends[k], ends[k - 1]);
  if (!ends.empty()) {
    EXPECT_EQ(ends.back(), connectivity.numbers().size());
  }
  for (const Element& array : piece.child("CellData").children)
    EXPECT_EQ(array.numbers().size(), cells * array.number("NumberOfComponents")) << array.attributes.at("Name");
  for (const Element& array : piece.child("PointData").children)
    EXPECT_EQ(array.numbers().size(), points * array.number("NumberOfComponents")) << array.attributes.at("Name");
  return piece;
}

struct Polygon {
  std::vector<Vector<3>> corners;
  Vector<3> area = Vector<3>::Zero();  // times the normal
  Vector<3> middle = Vector<3>::Zero();
};

std::vector<Polygon> polygons(const Element& piece) {
  const std::vector<double> points = piece.child("Points").named("Points").numbers();
  const std::vector<double> connectivity = piece.child("Polys").named("connectivity").numbers();
  std::vector<Polygon> list;
  std::size_t at = 0;
  for (const double end : piece.child("Polys").named("offsets").numbers()) {
    Polygon polygon;
    for (; at < static_cast<std::size_t>(end); ++at) {
      const std::size_t point = 3 * static_cast<std::size_t>(connectivity[at]);
      polygon.corners.emplace_back(points[point], points[point + 1], points[point + 2]);
      polygon.middle += polygon.corners.back();
    }
    polygon.middle /= static_cast<double>(polygon.corners.size());
    for (std::size_t k = 0; k < polygon.corners.size(); ++k)
      polygon.area += 0.5 * (polygon.corners[k] - polygon.middle)
                                .cross(polygon.corners[(k + 1) % polygon.corners.size()] - polygon.middle);
    list.push_back(polygon);
  }
  return list;
}

std::string joint_name(const Element& root) {
  std::string name;
  for (const double byte : root.child("PolyData").child("FieldData").named("joint_names").numbers())
    if (byte > 0) name += static_cast<char>(byte);
  return name;
}

TEST(Paraview, CubesAreClosedByOutwardPolygons) {
  const Model<3> model = row_of_blocks<3>(2);
  const std::string text = vtp(block_faces(model, moved_state(model), 0.75));
  const Element piece = checked_piece(text, "Polys", "NumberOfPolys");
  const std::vector<Polygon> faces = polygons(piece);
  ASSERT_EQ(faces.size(), 12u);

  // the second cube has moved by 0.25 in y; each cube's faces point away from its middle and close it
  const Vector<3> middles[] = {{1000, 1000, 1000}, {1001, 1000.25, 1000}};
  const std::vector<double> body = piece.child("CellData").named("body").numbers();
  Vector<3> sum[2] = {Vector<3>::Zero(), Vector<3>::Zero()};
  double surface[2] = {};
  for (std::size_t f = 0; f < faces.size(); ++f) {
    const int b = static_cast<int>(body[f]);
    EXPECT_EQ(faces[f].corners.size(), 4u);
    EXPECT_NEAR(faces[f].area.normalized().dot(faces[f].middle - middles[b]), 0.5, 1e-12);
    sum[b] += faces[f].area;
    surface[b] += faces[f].area.norm();
  }
  for (const int b : {0, 1}) {
    EXPECT_LT(sum[b].norm(), 1e-12);
    EXPECT_NEAR(surface[b], 6, 1e-12);
  }
}

TEST(Paraview, CellsNameTheirBodyAndJoint) {
  const Model<3> model = row_of_blocks<3>(2);
  const std::string text = vtp(block_faces(model, moved_state(model), 0.75));
  const Element data = checked_piece(text, "Polys", "NumberOfPolys").child("CellData");
  const Element root = XmlReader(text).read();
  EXPECT_EQ(joint_name(root), "A & B");
  EXPECT_EQ(root.child("PolyData").child("FieldData").named("TimeValue").numbers(), std::vector<double>{0.75});

  const std::vector<double> body = data.named("body").numbers(), joint = data.named("joint").numbers(),
                            fixed = data.named("fixed").numbers(), displacement = data.named("displacement").numbers(),
                            velocity = data.named("velocity").numbers();
  int made_by_joint = 0;
  for (std::size_t f = 0; f < body.size(); ++f) {
    EXPECT_EQ(fixed[f], body[f] == 0);
    EXPECT_EQ(displacement[3 * f + 1], body[f] == 1 ? 0.25 : 0);
    EXPECT_EQ(velocity[3 * f], body[f] == 1 ? 2 : 0);
    if (joint[f] == 0)
      ++made_by_joint;
    else
      EXPECT_EQ(joint[f], -1);
  }
  EXPECT_EQ(made_by_joint, 2);
}

// the rotated block's points started at those of the initial model; each has the velocity v + w × r
template <int Dim>
void expect_points_to_tell_their_motion(const Spin<Dim>& spin) {
  const Model<Dim> model = row_of_blocks<Dim>(2);
  State<Dim> state = moved_state(model);
  Motion<Dim>& motion = state.bodies.motions[1];
  motion.angular_momentum = angular_momentum<Dim>(model.bodies[1], motion.rotation, spin);
  const auto piece_of = [&](const State<Dim>& of) {
    return checked_piece(vtp(block_faces(model, of, 0)), "Polys", "NumberOfPolys");
  };
  const Element piece = piece_of(state);
  const std::vector<double> start = piece_of(initial_state(model)).child("Points").named("Points").numbers(),
                            now = piece.child("Points").named("Points").numbers(),
                            way = piece.child("PointData").named("displacement").numbers(),
                            velocity = piece.child("PointData").named("velocity").numbers();
  EXPECT_EQ(piece.child("PointData").named("displacement").attributes.at("type"), "Float32");
  ASSERT_EQ(now.size(), start.size());
  const Vector<3> centroid(1001, 1000.25, Dim == 3 ? 1000 : 0);
  for (std::size_t k = 0; k < now.size(); k += 3) {
    const bool free = k >= now.size() / 2;
    const Vector<3> arm = Vector<3>(now[k], now[k + 1], now[k + 2]) - centroid;
    Vector<3> expected = Vector<3>::Zero();
    if (free) expected = Vector<3>(2, 0, 0) + Vector<3>(0, 0, 3).cross(arm);
    for (std::size_t axis = 0; axis < 3; ++axis) {
      EXPECT_NEAR(way[k + axis], now[k + axis] - start[k + axis], 2e-7);
      EXPECT_NEAR(velocity[k + axis], expected[axis], 5e-7);
    }
    // a corner of a unit square that is rotated by a quarter turn moves by one side
    EXPECT_NEAR(Vector<3>(way[k], way[k + 1] - (free ? 0.25 : 0), way[k + 2]).norm(), free ? 1 : 0, 1e-6);
  }
}

TEST(Paraview, PointsHaveDisplacementsAndVelocities) {
  expect_points_to_tell_their_motion<2>(Spin<2>(3));
  expect_points_to_tell_their_motion<3>({0, 0, 3});
}

TEST(Paraview, FacesNameTheSetOfTheirJoint) {
  const Model<3> model = row_of_blocks<3>(2);
  const auto cells = [&](const JointSets& sets) {
    return checked_piece(vtp(block_faces(model, initial_state(model), 0, sets)), "Polys", "NumberOfPolys")
        .child("CellData");
  };
  const Element named = cells({{0}, {"bedding"}});
  EXPECT_EQ(named.named("set").numbers(), named.named("joint").numbers()) << "the only joint belongs to the only set";
  const std::vector<double> none(12, -1);
  EXPECT_EQ(cells({{-1}, {}}).named("set").numbers(), none);
  EXPECT_EQ(cells({}).named("set").numbers(), none);
}

TEST(Paraview, LinesJoinBodiesThatTouch) {
  const Model<3> model = row_of_blocks<3>(2);
  State<3> state = moved_state(model);
  const auto piece_of = [&] { return checked_piece(vtp(force_lines(model, state, 0)), "Lines", "NumberOfLines"); };
  EXPECT_EQ(piece_of().child("CellData").named("normal_N").numbers(), std::vector<double>{3});
  state.contacts.list[1].status = ContactStatus::touching;
  state.contacts.list[1].force = {1, 4, 0};
  const Element piece = piece_of(), cells = piece.child("CellData");
  EXPECT_EQ(piece.child("Points").named("Points").numbers(),
            (std::vector<double>{1000, 1000, 1000, 1001, 1000.25, 1000}));
  EXPECT_EQ(cells.named("body_a").numbers(), std::vector<double>{0});
  EXPECT_EQ(cells.named("body_b").numbers(), std::vector<double>{1});
  EXPECT_EQ(cells.named("contacts").numbers(), std::vector<double>{2});
  EXPECT_EQ(cells.named("force").numbers(), (std::vector<double>{4, 4, 0}));
  EXPECT_EQ(cells.named("normal_N").numbers(), std::vector<double>{4});
  EXPECT_EQ(cells.named("shear_N").numbers(), std::vector<double>{4});
  for (const double magnitude : piece.child("PointData").named("magnitude_N").numbers())
    EXPECT_NEAR(magnitude, std::sqrt(32), 1e-6);
}

TEST(Vtp, SinglePrecisionReplacesWhatItCannotRepresent) {
  PolyData data;
  data.points = {{0, 0, 0}};
  data.point_data = {{"some", 5, false, {0.1, -1e300, 1e-300, std::nan(""), -3e38}, true}};
  const std::vector<double> read =
      checked_piece(vtp(data), "Polys", "NumberOfPolys").child("PointData").named("some").numbers();
  EXPECT_EQ(read, (std::vector<double>{0.1F, 0, 0, 0, -3e38F}));
}

TEST(Vtp, NumbersAreTheirBits) {
  PolyData data;
  data.kind = PolyData::Cells::vertices;
  // any bits of a double, also bytes that would be mark-up
  std::vector<double> numbers{0.1, -0.0, 1 / 3.0, 5e-324, 1e300, 0x1.c3e3c2f3e2f3cp+10, -123456789.123456789};
  while (numbers.size() % 3 != 0)
    numbers.push_back(0);
  for (std::size_t k = 0; k < numbers.size(); k += 3) {
    data.points.push_back({numbers[k], numbers[k + 1], numbers[k + 2]});
    data.cells.push_back({static_cast<int>(k / 3)});
  }
  data.cell_data = {{"whole", 1, true, {-1, 2147483648.0, std::nan("")}}};
  const std::string text = vtp(data);
  const Element piece = checked_piece(text, "Verts", "NumberOfVerts");
  const std::vector<double> read = piece.child("Points").named("Points").numbers();
  ASSERT_EQ(read.size(), numbers.size());
  for (std::size_t k = 0; k < numbers.size(); ++k)
    EXPECT_EQ(std::bit_cast<std::uint64_t>(read[k]), std::bit_cast<std::uint64_t>(numbers[k])) << k;
  EXPECT_EQ(piece.child("CellData").named("whole").numbers(), (std::vector<double>{-1, 2147483648.0, 0}));
  EXPECT_EQ(vtp(data), text);
}

TEST(Paraview, ASquareIsOnePolygonInThePlane) {
  const Model<2> model = row_of_blocks<2>(3);
  const Element piece = checked_piece(vtp(block_faces(model, moved_state(model), 0)), "Polys", "NumberOfPolys");
  const std::vector<Polygon> squares = polygons(piece);
  ASSERT_EQ(squares.size(), 3u);
  for (const Polygon& square : squares) {
    EXPECT_EQ(square.corners.size(), 4u);
    EXPECT_LT((square.area - Vector<3>(0, 0, 1)).norm(), 1e-12);
    EXPECT_EQ(square.middle[2], 0);
  }
  EXPECT_NEAR(squares[1].middle[1], 1000.25, 1e-12);
}

TEST(Paraview, OnlyTouchingContactsAreShown) {
  const Model<3> model = row_of_blocks<3>(2);
  const Element piece = checked_piece(vtp(contact_points(model, moved_state(model), 0)), "Verts", "NumberOfVerts");
  EXPECT_EQ(piece.number("NumberOfPoints"), 1);
  const std::vector<double> point = piece.child("Points").named("Points").numbers();
  EXPECT_EQ(point, (std::vector<double>{1000.5, 1000, 1000}));
  EXPECT_EQ(piece.child("PointData").named("force").numbers(), (std::vector<double>{3, 0, 0}));
  EXPECT_EQ(piece.child("PointData").named("normal").numbers(), (std::vector<double>{1, 0, 0}));
  EXPECT_EQ(piece.child("PointData").named("overlap").numbers(), std::vector<double>{1e-4});
}

TEST(Paraview, ExcavatedBodiesAreLeftOut) {
  Model<3> model = row_of_blocks<3>(3);
  model.bodies[1].present = false;
  const Element piece = checked_piece(vtp(block_faces(model, moved_state(model), 0)), "Polys", "NumberOfPolys");
  EXPECT_EQ(piece.number("NumberOfPolys"), 12);
  for (const double body : piece.child("CellData").named("body").numbers())
    EXPECT_NE(body, 1);
}

TEST(Paraview, AFailedStateStillOpens) {
  const Model<2> model = row_of_blocks<2>(2);
  State<2> state = moved_state(model);
  state.bodies.motions[1].displacement[0] = std::nan("");
  checked_piece(vtp(block_faces(model, state, 0)), "Polys", "NumberOfPolys");
  state.contacts.list.clear();
  checked_piece(vtp(contact_points(model, state, 0)), "Verts", "NumberOfVerts");
}

TEST(Paraview, CollectionsNameFilesThatExist) {
  const TemporaryFolder folder;
  const Model<2> model = row_of_blocks<2>(2);
  FrameSeries series{folder.path};
  for (const double time : {0.0, 0.1, 0.3})
    write_frame(series, model, moved_state(model), time);
  for (const char* name : {"blocks.pvd", "contacts.pvd", "force_lines.pvd"}) {
    const Element root = XmlReader(read(folder.path / name)).read();
    EXPECT_EQ(root.attributes.at("type"), "Collection");
    const std::vector<Element>& entries = root.child("Collection").children;
    ASSERT_EQ(entries.size(), 3u);
    EXPECT_EQ(entries[2].number("timestep"), 0.3);
    for (const Element& entry : entries)
      EXPECT_TRUE(fs::exists(folder.path / entry.attributes.at("file")));
  }
}

TEST(Paraview, TrialsAreASeriesOfTheirOwn) {
  const TemporaryFolder folder;
  const Model<2> model = row_of_blocks<2>(2);
  FrameSeries series{folder.path}, trials{folder.path, {}, trial_series};
  write_frame(series, model, moved_state(model), 0.1);
  for (const int trial : {2, 3})
    write_frame(trials, model, moved_state(model), trial);
  const auto entries_of = [&](const char* name) {
    return XmlReader(read(folder.path / name)).read().child("Collection").children;
  };
  EXPECT_EQ(entries_of("blocks.pvd").size(), 1u);
  const std::vector<Element> tried = entries_of("trial_blocks.pvd");
  ASSERT_EQ(tried.size(), 2u);
  EXPECT_EQ(tried[1].number("timestep"), 3);
  EXPECT_EQ(tried[1].attributes.at("file"), "frames/trial_blocks_0001.vtp");

  // neither removes the other's frames
  cut_back(folder.path, {});
  EXPECT_TRUE(fs::exists(folder.path / "frames/trial_contacts_0001.vtp"));
  EXPECT_FALSE(fs::exists(folder.path / "frames/blocks_0000.vtp"));
  cut_back(folder.path, {2}, trial_series);
  EXPECT_FALSE(fs::exists(folder.path / "frames/trial_contacts_0001.vtp"));
  EXPECT_EQ(entries_of("trial_blocks.pvd").size(), 1u);
}

}  // namespace
}  // namespace voussoir::paraview_test
