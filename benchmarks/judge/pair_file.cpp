#include "benchmarks/judge/pair_file.hpp"

#include <fmt/format.h>

#include <fstream>
#include <nlohmann/json.hpp>
#include <stdexcept>

namespace voussoir::benchmarks {
namespace {

using Json = nlohmann::ordered_json;

constexpr const char* pair_format = "voussoir pairs 1";
constexpr double tolerance_of_unit = 1e-6;

Json definitions() {
  return {
      {"a, b",
       "planes [n1, n2, n3, d] of both blocks, in the axes of the first, m: x is inside if n·x <= d for each. "
       "The doubles as they are written are the pair."},
      {"touch", "true if the blocks have a common interior point; decided in rational arithmetic"},
      {"lp_optimum_m",
       "the least s for which some x has n·x - d <= s for all planes; negative if the blocks touch. "
       "Twice its size is the overlap of the deepest point."},
      {"smallest_translation_m", "the least length by which B must move to touch no more"},
      {"smallest_directions", "the directions of that move, unit, from A to B"},
      {"allowed_normals",
       "directions along which B separates within length_tolerance_m of the smallest translation. A kernel that gives "
       "another overlap may also give one of the cone of the outward normals of A's planes and the reversed ones of "
       "B's planes whose distance to its point is at most max(0.02 of the smaller inscribed radius, 2 |lp_optimum_m|)"},
      {"allowed_points", "n·x <= d + length_tolerance_m for all planes of both blocks"},
      {"faces_a, faces_b", "numbers, from 0, of the planes that bound the overlap"},
      {"centroid_m, volume_m3", "of the overlap"},
      {"area_m2", "of the overlap's section through its centroid, normal to the first of smallest_directions"},
      {"length_tolerance_m", "1e-6 of unit_m: the finest tolerance the libraries of the benchmark are set to"}};
}

Json planes_json(const HalfSpaces<3>& planes) {
  Json list = Json::array();
  for (const HalfSpace<3>& p : planes)
    list.push_back({p.normal[0], p.normal[1], p.normal[2], p.offset});
  return list;
}

Json vector_json(const Vector<3>& v) {
  return {v[0], v[1], v[2]};
}

Json pair_json(const ExactPair& pair) {
  Json j{{"name", pair.name()},      {"shape", pair.shape},
         {"state", pair.state},      {"number", pair.number},
         {"unit_m", pair.unit},      {"length_tolerance_m", length_tolerance(pair)},
         {"a", planes_json(pair.a)}, {"b", planes_json(pair.b)},
         {"touch", pair.touch},      {"lp_optimum_m", pair.lp_optimum}};
  if (!pair.touch) return j;
  j["smallest_translation_m"] = pair.smallest_translation;
  j["smallest_directions"] = Json::array();
  for (const Vector<3>& n : pair.normals)
    j["smallest_directions"].push_back(vector_json(n));
  j["faces_a"] = pair.faces_a;
  j["faces_b"] = pair.faces_b;
  j["centroid_m"] = vector_json(pair.centroid);
  j["volume_m3"] = pair.volume;
  j["area_m2"] = pair.area;
  return j;
}

Vector<3> vector_of(const Json& j) {
  return {j.at(0).get<double>(), j.at(1).get<double>(), j.at(2).get<double>()};
}

HalfSpaces<3> planes_of(const Json& j) {
  HalfSpaces<3> planes;
  for (const Json& p : j)
    planes.push_back({vector_of(p), p.at(3).get<double>()});
  return planes;
}

ExactPair pair_of(const Json& j) {
  ExactPair pair;
  j.at("shape").get_to(pair.shape);
  j.at("state").get_to(pair.state);
  j.at("number").get_to(pair.number);
  j.at("unit_m").get_to(pair.unit);
  pair.a = planes_of(j.at("a"));
  pair.b = planes_of(j.at("b"));
  j.at("touch").get_to(pair.touch);
  j.at("lp_optimum_m").get_to(pair.lp_optimum);
  if (!pair.touch) return pair;
  j.at("smallest_translation_m").get_to(pair.smallest_translation);
  for (const Json& n : j.at("smallest_directions"))
    pair.normals.push_back(vector_of(n));
  j.at("faces_a").get_to(pair.faces_a);
  j.at("faces_b").get_to(pair.faces_b);
  pair.centroid = vector_of(j.at("centroid_m"));
  j.at("volume_m3").get_to(pair.volume);
  j.at("area_m2").get_to(pair.area);
  return pair;
}

}  // namespace

double length_tolerance(const ExactPair& pair) {
  return tolerance_of_unit * pair.unit;
}

std::string pair_file_text(const PairFile& file) {
  std::string text = fmt::format(
      "{{\"format\": \"{}\",\n\"units\": {{\"length\": \"m\"}},\n\"seed\": {},\n\"definitions\": {},\n\"pairs\": [",
      pair_format, file.seed, definitions().dump(1));
  for (std::size_t i = 0; i < file.pairs.size(); ++i)
    text += (i == 0 ? "\n" : ",\n") + pair_json(file.pairs[i]).dump();
  return text + "\n]}\n";
}

PairFile read_pair_file(const std::filesystem::path& path) {
  std::ifstream in(path);
  if (!in) throw std::runtime_error(fmt::format("{}: cannot be read; voussoir_pairs writes it", path.string()));
  PairFile file;
  std::string at = "the file";
  try {
    const Json j = Json::parse(in);
    if (j.at("format") != pair_format) throw std::runtime_error(fmt::format("format is not \"{}\"", pair_format));
    j.at("seed").get_to(file.seed);
    for (const Json& pair : j.at("pairs")) {
      at = fmt::format("pair {}", pair.value("name", std::to_string(file.pairs.size())));
      file.pairs.push_back(pair_of(pair));
    }
  } catch (const std::exception& fault) {
    throw std::runtime_error(
        fmt::format("{}: {}: {}; write it again by voussoir_pairs", path.string(), at, fault.what()));
  }
  return file;
}

}  // namespace voussoir::benchmarks
