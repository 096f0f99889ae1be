#include "cases/kernel_trade/radius.hpp"

#include <stdexcept>

#include "cases/kernel_trade/trade.hpp"

namespace voussoir::trade {
namespace {

Contact<3> resolve(const TouchingPair& pair, double potential_radius, KernelCounters& counters) {
  const Pair<3> input{&pair.a, &pair.b, Matrix<3>::Identity(), pair.turn, pair.offset, QueryLevel::overlap};
  ContactSettings settings;
  settings.potential_radius = potential_radius;
  const contacts::Outcome<3> outcome = contacts::resolve<3>(input, settings);
  counters = outcome.counters;
  if (!outcome.contact.touching()) throw std::logic_error("a pair of the study does not touch");
  return outcome.contact;
}

double angle(const Vector<3>& u, const Vector<3>& v) {
  return std::atan2(u.cross(v).norm(), u.dot(v));
}

}  // namespace

std::vector<EdgeTilt> edge_tilts() {
  const double size = 0.5, overlap = 1e-6 * size;
  TouchingPair pair;
  pair.a = pair.b = shapes::centred_block<3>(shapes::cube<3>(size));
  pair.turn = Matrix<3>::Identity();
  std::vector<EdgeTilt> tilts;
  for (const double radius : {1e-3, 3e-3, 1e-2, 3e-2, 1e-1, 3e-1})
    for (int k = 1; k <= 24; ++k) {
      // the blocks' edges overhang by twice the distance; the point is in the middle, by symmetry
      const double fraction = k / 16.0, distance = fraction * radius * size, r = radius * size;
      pair.offset = {2 * size - 2 * distance, 0, 2 * size - overlap};
      KernelCounters counters;
      const double tilt = angle(resolve(pair, radius, counters).geometry.normal, Vector<3>::UnitZ());
      tilts.push_back({radius, fraction, tilt, std::atan(std::max(r - distance, 0.0) / (r - 0.5 * overlap))});
    }
  return tilts;
}

std::vector<AtRadius> at_radii(double overlap) {
  struct Place {
    TouchingPair pair, deeper;
    bool face_on_face;
    Vector<3> face;
  };
  std::vector<Place> places;
  const std::vector<shapes::Platonic> solids = shapes::platonic_solids(1);
  for (std::size_t s = 0; s < solids.size(); ++s)
    for (int k = 0; k < 16; ++k) {
      Place p;
      p.face_on_face = k % 2 == 0;
      p.pair.a = p.pair.b = shapes::centred_block<3>(solids[s].planes);
      p.pair.size = p.pair.a.inscribed_radius;
      p.deeper = p.pair;
      const std::uint64_t seed = 1000 * s + k;
      shapes::Random random(seed), again(seed);
      place(p.pair, p.face_on_face, 0, overlap * p.pair.size, random);
      place(p.deeper, p.face_on_face, 0, 1.01 * overlap * p.pair.size, again);
      p.face = p.pair.a.faces.front().normal;
      places.push_back(std::move(p));
    }

  std::vector<AtRadius> settings_tried;
  for (int step = -8; step <= 30; ++step) {
    AtRadius o{
        .radius = std::pow(10.0, step / 16.0 + 1e-3), .tilt = 0, .change = 0, .without = 0, .deep = 0, .unsaid = 0};
    int faces = 0, corners = 0;
    for (const Place& p : places) {
      KernelCounters counters, ignored;
      const Vector<3> normal = resolve(p.pair, o.radius * overlap, counters).geometry.normal;
      o.without += counters.normal_fallbacks > 0;
      o.deep += counters.deep_overlaps > 0;
      o.unsaid += counters.normal_fallbacks > 0 && counters.deep_overlaps == 0;
      if (p.face_on_face) {
        ++faces;
        o.tilt += angle(normal, p.face);
      } else {
        ++corners;
        o.change += angle(normal, resolve(p.deeper, o.radius * overlap, ignored).geometry.normal);
      }
    }
    o.tilt /= faces;
    o.change /= corners;
    o.without /= static_cast<double>(places.size());
    o.deep /= static_cast<double>(places.size());
    settings_tried.push_back(o);
  }
  return settings_tried;
}

const AtRadius& ruled(const std::vector<AtRadius>& settings_tried) {
  for (const AtRadius& o : settings_tried)
    if (o.without == 0 && o.deep == 0) return o;
  throw std::logic_error("no radius is large enough");
}

}  // namespace voussoir::trade
