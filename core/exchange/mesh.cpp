#include "core/exchange/mesh.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <limits>
#include <map>
#include <set>

#include "text/text_scan.hpp"

namespace voussoir {
namespace {

// the largest coordinate of a scene, m
constexpr double largest_coordinate = 1e12;

// of one block: every facet is checked against every corner, and blocks have at most some hundred faces
constexpr std::size_t most_facets = 5000;

// of one file
constexpr std::size_t most_meshes = 100'000;

constexpr std::size_t binary_head = 84, binary_facet = 50;  // bytes

// a solid that is being read: equal points are one
class MeshBuilder {
 public:
  void begin(std::string name, int line) {
    mesh_ = {std::move(name), line, {}, {}};
    places_.clear();
  }
  // in the numbers of a file of so many digits
  void digits(int most) {
    double largest = 0;
    for (const Vector<3>& p : mesh_.points)
      largest = std::max(largest, p.cwiseAbs().maxCoeff());
    mesh_.digits = most;
    if (largest > 0 && most > 0) mesh_.spacing = std::pow(10.0, std::floor(std::log10(largest)) + 1 - most);
  }
  void single_precision() {
    float largest = 0;
    for (const Vector<3>& p : mesh_.points)
      largest = std::max(largest, static_cast<float>(p.cwiseAbs().maxCoeff()));
    mesh_.spacing = std::nextafter(largest, std::numeric_limits<float>::infinity()) - largest;
  }
  void add(const std::vector<Vector<3>>& corners, int line, const std::string& facet) {
    if (mesh_.facets.size() == most_facets)
      throw FileFault(line, 0,
                      facet + fmt::format("more than {} facets in one block; divide it, or simplify it", most_facets));
    Facet added{{}, line};
    for (const Vector<3>& corner : corners)
      added.corners.push_back(place(corner));
    std::vector<int> sorted = added.corners;
    std::sort(sorted.begin(), sorted.end());
    if (std::adjacent_find(sorted.begin(), sorted.end()) != sorted.end())
      throw FileFault(line, 0, facet + "two corners of the facet are the same point; remove the facet or the corner");
    mesh_.facets.push_back(std::move(added));
  }
  Mesh& mesh() { return mesh_; }

 private:
  int place(const Vector<3>& p) {
    // -0 and 0 are one coordinate
    const auto [at, added] = places_.emplace(std::array{p[0] + 0.0, p[1] + 0.0, p[2] + 0.0}, mesh_.points.size());
    if (added) mesh_.points.push_back(p);
    return static_cast<int>(at->second);
  }

  Mesh mesh_;
  std::map<std::array<double, 3>, std::size_t> places_;
};

void add_mesh(std::vector<Mesh>& meshes, const Mesh& mesh, int line) {
  if (meshes.size() == most_meshes)
    throw FileFault(line, 0, fmt::format("more than {} blocks; divide the file", most_meshes));
  meshes.push_back(mesh);
}

// significant digits of a number as it is written
int digits_of(std::string_view number) {
  int digits = 0;
  for (const char c : number.substr(0, number.find_first_of("eE")))
    digits += (c >= '1' && c <= '9') || (c == '0' && digits > 0);
  return digits;
}

// `digits`: the most so far
Vector<3> point_of(const std::vector<Word>& words, std::size_t first, int& digits) {
  Vector<3> p;
  for (int k = 0; k < 3; ++k) {
    const Word& word = words[first + k];
    p[k] = number_of(word, std::string(1, "xyz"[k]));
    digits = std::max(digits, digits_of(word.text));
    if (std::abs(p[k]) > largest_coordinate)
      throw FileFault(word.line, word.column, "the coordinate exceeds 1e12 m; is it in m?");
  }
  return p;
}

// ---- STL

// reads `solid … endsolid` line by line
class StlReader {
 public:
  explicit StlReader(std::string_view text) : reader_(text) {}

  std::vector<Mesh> read() {
    std::vector<Mesh> meshes;
    while (next()) {
      const std::string_view line = reader_.line();
      expect("solid");
      const std::size_t behind = words_[0].column - 1 + words_[0].text.size();
      const std::string_view rest = line.substr(behind);
      const std::size_t from = rest.find_first_not_of(" \t"), to = rest.find_last_not_of(" \t");
      solid(from == std::string_view::npos ? "" : std::string(rest.substr(from, to - from + 1)));
      add_mesh(meshes, builder_.mesh(), reader_.number());
    }
    return meshes;
  }

 private:
  bool next() {
    while (reader_.next()) {
      words_ = words_of(reader_.line(), reader_.number());
      if (!words_.empty()) return true;
    }
    return false;
  }
  void need(const char* what) {
    if (!next())
      throw FileFault(reader_.number(), 0, std::string("the file ends before '") + what + "'; is it cut off?");
  }
  void expect(std::string_view word) const {
    if (words_[0].text != word)
      throw FileFault(words_[0].line, words_[0].column,
                      "found " + shown(words_[0].text) + " instead of '" + std::string(word) + "'");
  }
  void solid(const std::string& name) {
    builder_.begin(name, reader_.number());
    digits_ = 0;
    while (true) {
      need("endsolid");
      if (words_[0].text == "endsolid") return builder_.digits(digits_);
      facet();
    }
  }
  void facet() {
    expect("facet");
    const int line = reader_.number();
    need("outer loop");
    expect("outer");
    std::vector<Vector<3>> corners;
    for (int k = 0; k < 3; ++k) {
      need("vertex");
      expect("vertex");
      if (words_.size() != 4)
        throw FileFault(words_[0].line, words_[0].column,
                        "a vertex has three coordinates; write for example vertex 0 0 1");
      corners.push_back(point_of(words_, 1, digits_));
    }
    need("endloop");
    expect("endloop");
    need("endfacet");
    expect("endfacet");
    builder_.add(corners, line, "");
  }

  LineReader reader_;
  std::vector<Word> words_;
  MeshBuilder builder_;
  int digits_ = 0;  // most of a coordinate of the solid
};

template <class T>
T little_endian(std::string_view bytes, std::size_t at) {
  std::array<unsigned char, sizeof(T)> buffer;
  std::memcpy(buffer.data(), bytes.data() + at, sizeof(T));
  std::uint32_t bits = 0;
  for (std::size_t k = 0; k < sizeof(T); ++k)
    bits |= static_cast<std::uint32_t>(buffer[k]) << (8 * k);
  T value;
  std::memcpy(&value, &bits, sizeof(T));
  return value;
}

std::vector<Mesh> read_binary_stl(std::string_view bytes, std::size_t count) {
  MeshBuilder builder;
  builder.begin("", 0);
  for (std::size_t f = 0; f < count; ++f) {
    const std::string facet = fmt::format("facet {}: ", f + 1);
    std::vector<Vector<3>> corners(3);
    for (std::size_t k = 0; k < 9; ++k) {
      // behind the normal's three numbers
      const auto x = little_endian<float>(bytes, binary_head + f * binary_facet + 4 * (3 + k));
      if (!std::isfinite(x) || std::abs(x) > largest_coordinate)
        throw FileFault(0, 0, facet + "a coordinate is not finite or exceeds 1e12 m");
      corners[k / 3][k % 3] = x;
    }
    builder.add(corners, 0, facet);
  }
  builder.single_precision();
  return {builder.mesh()};
}

// ---- OBJ

class ObjReader {
 public:
  explicit ObjReader(std::string_view text) : reader_(text) {}

  std::vector<Mesh> read() {
    builder_.begin("", 1);
    while (reader_.next()) {
      const std::string_view line = reader_.line().substr(0, reader_.line().find('#'));
      const std::vector<Word> words = words_of(line, reader_.number());
      if (!words.empty()) statement(line, words);
    }
    finish();
    return std::move(meshes_);
  }

 private:
  void statement(std::string_view line, const std::vector<Word>& words) {
    static const std::set<std::string_view> without_effect{"g", "s", "vn", "vt", "vp", "usemtl", "mtllib"};
    const Word& what = words[0];
    if (what.text == "v")
      vertex(words);
    else if (what.text == "f")
      face(words);
    else if (what.text == "o")
      object(line, words);
    else if (!without_effect.contains(what.text))
      throw FileFault(
          what.line, what.column,
          "no statement " + shown(what.text) + " is known; a block has v (vertices), f (faces) and o (names)");
  }
  void vertex(const std::vector<Word>& words) {
    // a fourth is a weight, six are coordinates and colour
    if (words.size() < 4 || words.size() > 7)
      throw FileFault(words[0].line, words[0].column, "a vertex has three coordinates; write for example v 0 0 1");
    vertices_.push_back(point_of(words, 1, digits_));
  }
  void face(const std::vector<Word>& words) {
    if (words.size() < 4)
      throw FileFault(words[0].line, words[0].column, "a face has at least three corners; write for example f 1 2 3");
    std::vector<Vector<3>> corners;
    for (std::size_t k = 1; k < words.size(); ++k)
      corners.push_back(vertices_[index(words[k])]);
    builder_.add(corners, words[0].line, "");
  }
  // 3, 3/1, 3//2, 3/1/2: the first counts the vertices from 1, or backwards from -1
  std::size_t index(const Word& word) const {
    const std::string_view text = word.text.substr(0, word.text.find('/'));
    long long number = 0;
    const auto [stop, error] = std::from_chars(text.data(), text.data() + text.size(), number);
    const auto count = static_cast<long long>(vertices_.size());
    const bool whole = error == std::errc() && stop == text.data() + text.size();
    if (!whole || number == 0 || number > count || number < -count)
      throw FileFault(word.line, word.column,
                      "corner " + shown(word.text) + " is none of the " + std::to_string(count) +
                          " vertices stated so far; they are counted from 1");
    return static_cast<std::size_t>(number > 0 ? number - 1 : count + number);
  }
  void object(std::string_view line, const std::vector<Word>& words) {
    finish();
    const std::size_t from = words.size() > 1 ? words[1].column - 1 : line.size();
    std::string name(line.substr(from, line.find_last_not_of(" \t") + 1 - from));
    builder_.begin(std::move(name), words[0].line);
  }
  void finish() {
    builder_.digits(digits_);
    if (!builder_.mesh().facets.empty()) add_mesh(meshes_, builder_.mesh(), reader_.number());
  }

  LineReader reader_;
  std::vector<Vector<3>> vertices_;  // of the entire file
  int digits_ = 0;                   // most of a coordinate so far
  MeshBuilder builder_;
  std::vector<Mesh> meshes_;
};

}  // namespace

std::vector<Mesh> read_stl(std::string_view bytes) {
  std::vector<Mesh> meshes;
  const std::size_t count = bytes.size() >= binary_head ? little_endian<std::uint32_t>(bytes, binary_head - 4) : 0;
  // many binary files begin with "solid" too: their size shows which they are
  if (count > 0 && bytes.size() == binary_head + count * binary_facet) {
    meshes = read_binary_stl(bytes, count);
  } else {
    const std::size_t first = bytes.find_first_not_of(" \t\r\n");
    if (first == std::string_view::npos || !bytes.substr(first).starts_with("solid"))
      throw FileFault(
          1, 0,
          "is no STL: a text begins with 'solid', and a binary file has 84 bytes and 50 for each facet that "
          "it counts; is it cut off?");
    meshes = StlReader(bytes).read();
  }
  if (meshes.empty()) throw FileFault(1, 0, "contains no solid");
  return meshes;
}

std::vector<Mesh> read_obj(std::string_view text) {
  std::vector<Mesh> meshes = ObjReader(text).read();
  if (meshes.empty()) throw FileFault(1, 0, "contains no face; a block needs lines such as f 1 2 3");
  return meshes;
}

std::string stl_text(const std::vector<Mesh>& meshes) {
  std::string text;
  const auto vector = [](const Vector<3>& p) { return fmt::format("{} {} {}", p[0], p[1], p[2]); };
  for (const Mesh& mesh : meshes) {
    text += "solid " + mesh.name + "\n";
    for (const Facet& facet : mesh.facets)
      for (std::size_t k = 1; k + 1 < facet.corners.size(); ++k) {
        const Vector<3>&a = mesh.points[facet.corners[0]], &b = mesh.points[facet.corners[k]],
              &c = mesh.points[facet.corners[k + 1]];
        const Vector<3> area = (b - a).cross(c - a);
        const Vector<3> normal = area.norm() > 0 ? Vector<3>(area.normalized()) : Vector<3>(Vector<3>::Zero());
        text += fmt::format("facet normal {}\n outer loop\n  vertex {}\n  vertex {}\n  vertex {}\n endloop\nendfacet\n",
                            vector(normal), vector(a), vector(b), vector(c));
      }
    text += "endsolid " + mesh.name + "\n";
  }
  return text;
}

std::string obj_text(const std::vector<Mesh>& meshes) {
  std::string text;
  std::size_t before = 1;
  for (const Mesh& mesh : meshes) {
    text += "o " + mesh.name + "\n";
    for (const Vector<3>& p : mesh.points)
      text += fmt::format("v {} {} {}\n", p[0], p[1], p[2]);
    for (const Facet& facet : mesh.facets) {
      text += "f";
      for (const int corner : facet.corners)
        text += fmt::format(" {}", before + corner);
      text += "\n";
    }
    before += mesh.points.size();
  }
  return text;
}

}  // namespace voussoir
