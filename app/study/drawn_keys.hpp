// What scatters in a sample or a reliability analysis: keys of a scene with their laws, and their correlation.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "core/probability/correlation.hpp"
#include "core/probability/limit_state.hpp"
#include "core/scene/node.hpp"

namespace voussoir {

// which joints share a draw of a joint property
enum class DrawnPer { property, set, joint };

// Fisher's law (1953) of a joint's pole around its mean: density proportional to exp(K cos θ)
struct PoleScatter {
  double dip = 0, dip_direction = 0;  // deg, the mean's
  double concentration = 0;           // K
};

struct DrawnKey {
  std::string key, unit;
  Distribution law;
  std::optional<PoleScatter> pole = {};  // instead of the law: dip and dip_direction of the joint `key`
  DrawnPer per = DrawnPer::property;

  // the keys of the scene that it sets
  std::vector<std::string> scene_keys() const;
  // the standard normals that it needs
  std::size_t components() const { return pole ? 2 : 1; }
};

struct DrawnKeys {
  std::vector<DrawnKey> keys;
  std::vector<CorrelatedPair> correlated;   // of components
  std::vector<std::vector<double>> factor;  // L of core/probability/correlation; empty: all are independent
  std::uint64_t seed = 0;
  int rows = 0;
  bool latin = false;                              // the rows of a Latin hypercube
  std::vector<std::vector<double>> latin_columns;  // by component

  std::size_t components() const;
  std::vector<std::string> scene_keys() const;  // of all keys, in the order of their values
  std::vector<std::string> units() const;       // of these
  // a sample's row, from 1, depends on seed and row alone (of a Latin hypercube on the number of rows, too)
  std::vector<double> row(int number) const;
  // the values at u, independent standard normals by component
  std::vector<double> at(const StandardPoint& u) const;
};

// `keys`, `correlation` and `seed` of a table; `method` and `rows` are the caller's. Throws SceneError.
DrawnKeys read_drawn_keys(const Subject& table);

// Fills the columns of a Latin hypercube.
void make_latin(DrawnKeys& drawn);

// a line for people and files: "normal, mean 38, deviation 3"
std::string law_text(const DrawnKey& key);

// without its table, for people: "joint_properties.rock.cohesion" and "stage.safety.friction.rock.friction_deg" are
// "rock.cohesion" and "rock.friction_deg"
std::string short_name(const std::string& key);

// which joints share a draw, a line for people; empty if no key is of joint properties
std::string sharing_text(const DrawnKeys& drawn);

// a whole number under `key`, or nothing
std::optional<double> whole_number_of(const Subject& table, const char* key, double least, double most);

}  // namespace voussoir
