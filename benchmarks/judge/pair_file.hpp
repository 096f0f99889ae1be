// pairs.json: pairs of the kernel benchmark as planes, each with the answer of exact arithmetic, so that any contact
// kernel can be judged by them. What every key means is in the file itself, under "definitions".
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "core/geometry/half_space.hpp"

namespace voussoir::benchmarks {

// Two blocks in the axes of the first, and the answer for exactly these doubles. The numbers behind `touch` are rounded
// from exact ones, and those behind `lp_optimum` are of touching pairs only.
struct ExactPair {
  std::string shape, state;  // names of the benchmark
  int number = 0;
  double unit = 1;  // m, of lengths: unit_of(shape)
  HalfSpaces<3> a, b;

  bool touch = false;
  double lp_optimum = 0;                   // m: min over x of the largest n·x - d (Boon 2013, Eq. 3.27)
  double smallest_translation = 0;         // m: of B, until the blocks only just touch
  std::vector<Vector<3>> normals;          // its directions, unit, from A to B
  std::vector<int> faces_a, faces_b;       // that bound the overlap
  Vector<3> centroid = Vector<3>::Zero();  // m, of the overlap
  double volume = 0;                       // m³
  double area = 0;                         // m²: of its section through the centroid, normal to normals[0]

  std::string name() const { return shape + "/" + state + "/" + std::to_string(number); }
};

struct PairFile {
  std::uint64_t seed = 0;
  std::vector<ExactPair> pairs;
};

// 1e-6 of a pair's unit, m: the finest tolerance that the benchmark's peers are set to, and 1 % of an overlap of 1e-4
double length_tolerance(const ExactPair& pair);

std::string pair_file_text(const PairFile& file);

// Throws std::runtime_error with one line (file, pair, key, repair) if the file is missing or is not such a file.
PairFile read_pair_file(const std::filesystem::path& path);

}  // namespace voussoir::benchmarks
