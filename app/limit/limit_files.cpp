#include "app/limit/limit_files.hpp"

#include <fmt/format.h>
#include <limits>

#include <algorithm>
#include <cmath>

#include "app/base/gzip.hpp"
#include "app/derivatives/derivative_files.hpp"
#include "app/run_folder/results_hash.hpp"
#include "core/output/atomic_file.hpp"
#include "core/output/paraview.hpp"

namespace voussoir {
namespace {

// ---- for both the figure and ParaView ------------------------------------------------------------------------------

constexpr double drawn_motion = 0.08;  // of the picture's larger side: the drawn displacement of the fastest block
constexpr double drawn_force = 0.12;   // of it: the length of the largest force
constexpr double drawn_margin = 0.08;  // of it: the margin around the free blocks

template <int Dim>
struct Frame {
  Vector<Dim> low, high;  // m, model coordinates
  double extent() const { return (high - low).maxCoeff(); }
};

template <int Dim>
Frame<Dim> frame_of(const Model<Dim>& model) {
  Frame<Dim> frame{Vector<Dim>::Constant(std::numeric_limits<double>::infinity()),
                   Vector<Dim>::Constant(-std::numeric_limits<double>::infinity())};
  for (const Body<Dim>& body : model.bodies) {
    if (body.fixed || !body.present) continue;
    for (const Polytope<Dim>& part : body.parts)
      for (const Vector<Dim>& vertex : part.vertices) {
        frame.low = frame.low.cwiseMin(body.reference + vertex);
        frame.high = frame.high.cwiseMax(body.reference + vertex);
      }
  }
  const Vector<Dim> margin = Vector<Dim>::Constant(drawn_margin * frame.extent());
  return {frame.low - margin, frame.high + margin};
}

bool moves(const LimitAnalysis<2>& analysis, int body) {
  const auto& moving = analysis.mechanism.moving;
  return std::any_of(moving.begin(), moving.end(), [&](const BlockMotion<2>& m) { return m.body == body; });
}

// ---- the figure ----------------------------------------------------------------------------------------------------

constexpr double picture_width = 370, gap = 20, caption_height = 28;  // px

class Picture {
 public:
  Picture(const Frame<2>& frame, int place) : frame_(frame), left_(place * (picture_width + gap)) {
    scale_ = picture_width / (frame.high[0] - frame.low[0]);
  }
  static double height(const Frame<2>& frame) {
    return picture_width * (frame.high[1] - frame.low[1]) / (frame.high[0] - frame.low[0]);
  }
  void begin(const std::string& caption) {
    const int number = left_ > 0;
    text += fmt::format(
        "<clipPath id=\"frame{}\"><rect x=\"{:.2f}\" y=\"{:.2f}\" width=\"{:.2f}\" height=\"{:.2f}\"/>"
        "</clipPath>\n<text x=\"{:.2f}\" y=\"18\">{}</text>\n<g clip-path=\"url(#frame{})\">\n",
        number, left_, caption_height, picture_width, height(frame_), left_, caption, number);
  }
  void end() { text += "</g>\n"; }
  std::string at(const Vector<2>& p) const {
    return fmt::format("{:.2f},{:.2f}", left_ + (p[0] - frame_.low[0]) * scale_,
                       caption_height + (frame_.high[1] - p[1]) * scale_);
  }
  void polygon(const Polytope<2>& part, const Vector<2>& place, const Matrix<2>& turn, const char* style) {
    // counter-clockwise about the part's middle
    std::vector<Vector<2>> corners(part.vertices);
    std::sort(corners.begin(), corners.end(), [&](const Vector<2>& a, const Vector<2>& b) {
      const Vector<2> p = a - part.centre, q = b - part.centre;
      return std::atan2(p[1], p[0]) < std::atan2(q[1], q[0]);
    });
    text += "<polygon points=\"";
    for (const Vector<2>& corner : corners)
      text += at(place + turn * corner) + " ";
    text += fmt::format("\" {}/>\n", style);
  }
  void line(const Vector<2>& from, const Vector<2>& to) {
    text += fmt::format("<polyline points=\"{} {}\"/>\n", at(from), at(to));
  }
  std::string text;

 private:
  Frame<2> frame_;
  double left_, scale_;
};

constexpr const char* fixed_style = "fill=\"#e2e2e2\" stroke=\"#909090\"";
constexpr const char* free_style = "fill=\"#ffffff\" stroke=\"#606060\"";
constexpr const char* moved_style = "fill=\"#d55e00\" fill-opacity=\"0.25\" stroke=\"#d55e00\"";
constexpr const char* left_style = "fill=\"none\" stroke=\"#909090\" stroke-dasharray=\"3 3\"";

void draw_forces(const LimitAnalysis<2>& analysis, const Frame<2>& frame, Picture& picture) {
  for (const Body<2>& body : analysis.model.bodies)
    for (const Polytope<2>& part : body.parts)
      if (body.present)
        picture.polygon(part, body.reference, Matrix<2>::Identity(), body.fixed ? fixed_style : free_style);
  double largest = 0;
  for (const std::vector<Vector<2>>& of_face : analysis.state.forces)
    for (const Vector<2>& force : of_face)
      largest = std::max(largest, force.norm());
  if (largest == 0) return;
  picture.text += "<g fill=\"none\" stroke=\"#0072b2\" stroke-width=\"2\">\n";
  for (std::size_t i = 0; i < analysis.state.forces.size(); ++i)
    for (std::size_t k = 0; k < 2; ++k) {
      const Vector<2> half = 0.5 * drawn_force * frame.extent() / largest * analysis.state.forces[i][k];
      const Vector<2>& end = analysis.assembly.faces[i].corners[k];
      if (half.norm() > 0) picture.line(end - half, end + half);
    }
  picture.text += "</g>\n";
}

void draw_mechanism(const LimitAnalysis<2>& analysis, const Frame<2>& frame, Picture& picture) {
  const double far = drawn_motion * frame.extent();
  for (const bool moving : {false, true})  // moving blocks are drawn over the others
    for (std::size_t b = 0; b < analysis.model.bodies.size(); ++b) {
      const Body<2>& body = analysis.model.bodies[b];
      if (!body.present || moves(analysis, static_cast<int>(b)) != moving) continue;
      for (const Polytope<2>& part : body.parts) {
        const char* rest_style = body.fixed ? fixed_style : moving ? left_style : free_style;
        picture.polygon(part, body.reference, Matrix<2>::Identity(), rest_style);
        if (!moving) continue;
        const BodyVelocity<2>& v = analysis.state.velocities[b];
        picture.polygon(part, body.reference + far * v.velocity, matrix(Rotation<2>{far * v.spin[0]}), moved_style);
      }
    }
}

// ---- ParaView ------------------------------------------------------------------------------------------------------

template <int Dim>
State<Dim> moved_along(const LimitAnalysis<Dim>& analysis, double distance) {
  State<Dim> state = initial_state<Dim>(analysis.model);
  for (std::size_t b = 0; b < analysis.state.velocities.size(); ++b) {
    const BodyVelocity<Dim>& v = analysis.state.velocities[b];
    Motion<Dim>& motion = state.bodies.motions[b];
    motion.displacement = distance * v.velocity;
    motion.rotation = turned(Rotation<Dim>(), Spin<Dim>(distance * v.spin));
    motion.velocity = v.velocity;
    motion.angular_momentum = angular_momentum<Dim>(analysis.model.bodies[b], {}, v.spin);
  }
  return state;
}

// points of forces on body_b
class ForcePoints {
 public:
  ForcePoints() { data_.kind = PolyData::Cells::vertices; }
  void add(int body_a, int body_b, const Vector<3>& place, const Vector<3>& normal, const Vector<3>& on_b) {
    data_.cells.push_back({static_cast<int>(data_.points.size())});
    data_.points.push_back({place[0], place[1], place[2]});
    body_a_.values.push_back(body_a);
    body_b_.values.push_back(body_b);
    normal_.values.insert(normal_.values.end(), normal.begin(), normal.end());
    force_.values.insert(force_.values.end(), on_b.begin(), on_b.end());
  }
  PolyData data() {
    data_.point_data = {body_a_, body_b_, normal_, force_};
    return data_;
  }

 private:
  PolyData data_;
  DataArray body_a_{"body_a", 1, true, {}}, body_b_{"body_b", 1, true, {}}, normal_{"normal", 3, false, {}},
      force_{"force", 3, false, {}};
};

Vector<3> in_space(const Vector<2>& p) {
  return {p[0], p[1], 0};
}

Vector<3> in_space(const Vector<3>& p) {
  return p;
}

template <int Dim>
PolyData force_points(const LimitAnalysis<Dim>& analysis) {
  ForcePoints points;
  for (std::size_t i = 0; i < analysis.state.forces.size(); ++i) {
    const CornerFace<Dim>& face = analysis.assembly.faces[i];
    for (std::size_t k = 0; k < face.corners.size(); ++k)
      points.add(face.body_a, face.body_b, in_space(Vector<Dim>(analysis.model.origin + face.corners[k])),
                 in_space(face.normal), in_space(analysis.state.forces[i][k]));
  }
  return points.data();
}

void write_figure(const LimitAnalysis<2>& analysis, const std::filesystem::path& folder) {
  write_file(folder / "limit.svg", limit_svg(analysis));
}

void write_figure(const LimitAnalysis<3>&, const std::filesystem::path&) {}

}  // namespace

std::string limit_svg(const LimitAnalysis<2>& analysis) {
  const Frame<2> frame = frame_of(analysis.model);
  Picture forces(frame, 0), mechanism(frame, 1);
  forces.begin("forces at the joints' ends");
  draw_forces(analysis, frame, forces);
  forces.end();
  mechanism.begin(analysis.mechanism.moving.empty() ? "no mechanism" : "mechanism, " + analysis.flow);
  draw_mechanism(analysis, frame, mechanism);
  mechanism.end();
  const double width = 2 * picture_width + gap, height = caption_height + Picture::height(frame);
  return fmt::format(
             "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {0:.2f} {1:.2f}\" width=\"{0:.2f}\" "
             "height=\"{1:.2f}\" font-family=\"DejaVu Sans,Helvetica,Arial,sans-serif\" font-size=\"13\" "
             "fill=\"#202020\">\n<rect width=\"100%\" height=\"100%\" fill=\"white\"/>\n",
             width, height) +
         forces.text + mechanism.text + "</svg>\n";
}

template <int Dim>
void write_limit_files(const LimitAnalysis<Dim>& analysis, const DerivativeTable* table,
                       const std::filesystem::path& folder) {
  write_figure(analysis, folder);
  const auto blocks = [&](double distance) {
    return vtp(block_faces<Dim>(analysis.model, moved_along(analysis, distance), 0));
  };
  write_file(folder / "blocks.vtp", blocks(0));
  write_file(folder / "mechanism.vtp", blocks(drawn_motion * frame_of(analysis.model).extent()));
  write_file(folder / "forces.vtp", vtp(force_points(analysis)));
  if (analysis.proof && !analysis.proof->file.empty())
    write_file(folder / "proof.json.gz", gzipped(analysis.proof->file));
  if (table) write_derivatives(*table, folder);
  const std::string results = limit_json(analysis);
  // last: if it exists, all else is complete
  write_results(folder, table ? with_derivatives(results, *table) : results);
}

template void write_limit_files(const LimitAnalysis<2>&, const DerivativeTable*, const std::filesystem::path&);
template void write_limit_files(const LimitAnalysis<3>&, const DerivativeTable*, const std::filesystem::path&);

}  // namespace voussoir
