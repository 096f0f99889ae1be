#include "benchmarks/peers/clip.hpp"

#include <algorithm>
#include <numeric>

#include "benchmarks/peers/peers.hpp"

namespace voussoir::benchmarks {
namespace {

// m, for parts of about 1: vertices in the plane within rounding are kept. Without it, corners of more than three
// planes are on either side by chance, edges leave a face more than once, and the region does not close.
constexpr double in_plane = 1e-13;

}  // namespace

Overlap Clipper::clip(const Polytope<3>& part, const HalfSpaces<3>& planes) {
  vertices_ = part.vertices;
  alive_.resize(vertices_.size());
  std::iota(alive_.begin(), alive_.end(), 0);
  loop_count_ = part.loops.size();
  if (loops_.size() < loop_count_) loops_.resize(loop_count_);
  for (std::size_t i = 0; i < loop_count_; ++i)
    loops_[i] = part.loops[i];
  for (const HalfSpace<3>& plane : planes)
    if (!cut_by(plane)) return {};
  return measure();
}

// false if nothing is left
bool Clipper::cut_by(const HalfSpace<3>& plane) {
  distances_.resize(vertices_.size());
  bool any_kept = false, any_lost = false;
  for (const int v : alive_) {
    distances_[v] = signed_distance(plane, vertices_[v]);
    (distances_[v] > in_plane ? any_lost : any_kept) = true;
  }
  if (!any_lost) return true;
  if (!any_kept) return false;

  std::erase_if(alive_, [this](int v) { return distances_[v] > in_plane; });
  cuts_.clear();
  section_edges_.clear();
  next_count_ = 0;
  for (std::size_t i = 0; i < loop_count_; ++i) {
    if (next_loops_.size() <= next_count_) next_loops_.emplace_back();
    if (hit(loops_[i]))
      cut_loop(loops_[i], next_loops_[next_count_]);
    else
      std::swap(loops_[i], next_loops_[next_count_]);
    if (!next_loops_[next_count_].empty()) ++next_count_;
  }
  close_section();
  std::swap(loops_, next_loops_);
  loop_count_ = next_count_;
  return true;
}

bool Clipper::hit(const Loop& loop) const {
  return std::any_of(loop.begin(), loop.end(), [this](int v) { return distances_[v] > in_plane; });
}

void Clipper::cut_loop(const Loop& loop, Loop& left) {
  left.clear();
  int leaves = -1, enters = -1;
  for (std::size_t k = 0; k < loop.size(); ++k) {
    const int here = loop[k], next = loop[k + 1 < loop.size() ? k + 1 : 0];
    const bool kept = distances_[here] <= in_plane, next_kept = distances_[next] <= in_plane;
    if (kept) left.push_back(here);
    if (kept && !next_kept) left.push_back(leaves = vertex_on(here, next));
    if (!kept && next_kept) left.push_back(enters = vertex_on(next, here));
  }
  // the new edge of this face runs from the exit of its loop to the re-entry; the section's runs back
  if (leaves >= 0) section_edges_.emplace_back(enters, leaves);
}

// the two faces of an edge share its new vertex
int Clipper::vertex_on(int kept, int lost) {
  for (const Cut& cut : cuts_)
    if (cut.kept == kept && cut.lost == lost) return cut.vertex;
  const double inside = std::min(distances_[kept], 0.0), fraction = inside / (inside - distances_[lost]);
  vertices_.push_back(vertices_[kept] + fraction * (vertices_[lost] - vertices_[kept]));
  alive_.push_back(static_cast<int>(vertices_.size()) - 1);
  cuts_.push_back({kept, lost, static_cast<int>(vertices_.size()) - 1});
  return cuts_.back().vertex;
}

// the face in the plane itself: its edges, one from each cut face, in a ring
void Clipper::close_section() {
  if (section_edges_.empty()) return;
  if (next_loops_.size() <= next_count_) next_loops_.emplace_back();
  Loop& ring = next_loops_[next_count_++];
  ring.clear();
  const int first = section_edges_[0].first;
  int at = first;
  do {
    ring.push_back(at);
    int next = first;
    for (const auto& [from, to] : section_edges_)
      if (from == at) next = to;
    at = next;
  } while (at != first && ring.size() <= section_edges_.size());
}

// tetrahedra from one corner of the region, so that a small region loses no digits
Overlap Clipper::measure() const {
  if (loop_count_ == 0) return {};
  const Vector<3> apex = vertices_[loops_[0][0]];
  double six_volumes = 0;
  Vector<3> moment = Vector<3>::Zero();
  for (std::size_t i = 0; i < loop_count_; ++i) {
    const Loop& loop = loops_[i];
    const Vector<3> a = vertices_[loop[0]] - apex;
    for (std::size_t k = 1; k + 1 < loop.size(); ++k) {
      const Vector<3> b = vertices_[loop[k]] - apex, c = vertices_[loop[k + 1]] - apex;
      const double part = a.dot(b.cross(c));
      six_volumes += part;
      moment += part * (a + b + c);
    }
  }
  if (!(six_volumes > 0)) return {};
  return {six_volumes / 6, apex + moment / (4 * six_volumes)};
}

namespace {

std::shared_ptr<Prepared> prepare_clip(const Workload& work) {
  return prepared_query(pairs_per_workload,
                        [&work, clipper = Clipper(), planes = HalfSpaces<3>()](std::size_t i) mutable {
                          const Pair<3>& pair = work.pairs[i];
                          planes.clear();
                          for (const HalfSpace<3>& face : pair.b->faces) {
                            const Vector<3> normal = pair.rotation * face.normal;
                            planes.push_back({normal, face.offset + normal.dot(pair.offset)});
                          }
                          return clipper.clip(*pair.a, planes).volume > 0;
                        });
}

}  // namespace

std::vector<Method> clip_methods() {
  return {{hand_clip, "point", "decision point", any_pair, prepare_clip}};
}

}  // namespace voussoir::benchmarks
