// The verdicts of a scene's blocks by block theory, at its stages.
#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "core/key_blocks/block_forces.hpp"
#include "core/key_blocks/survey.hpp"
#include "core/model/prepared.hpp"

namespace voussoir {

struct SeismicRequest {
  double coefficient = 0;         // k: a force k W on each block
  std::optional<double> trend{};  // rad, of that force; none: the worst direction of each block, in columns of its own
  double vertical = 0;            // a vertical force of this times W, with the sign that is worse
};

struct SurveyRequest {
  double required = 1.5;  // forces are for this factor
  std::optional<SeismicRequest> seismic{};
  std::optional<std::pair<double, double>> bolt{};  // rad: plunge and trend of the force of a bolt on a block
  std::string strength_of;                          // stage; empty: that of the first search, else joint_properties
  std::string after;                                // stage whose geometry is judged; empty: as sliced
  bool frictionless = false;                        // rounds of blocks that move without friction, too
  bool factors_only = false;                        // no forces, critical water and notes: for many samples
};

inline constexpr double least_required = 1e-9, most_required = 1000;

// Throws BadInput for numbers outside of their ranges.
void refuse_out_of_range(const SurveyRequest& request);

// of a block, or of a cluster of blocks that move as one
template <int Dim>
struct SurveyRow {
  std::vector<int> bodies;
  int cluster = 0;                                                 // number from 1; 0: a single block
  double volume = 0, weight = 0, free_area = 0, contact_area = 0;  // m³, N, m², m²
  double surface = 0;                                              // m²
  std::vector<RockFace<Dim>> faces;                                // of blocks that are not enclosed
  BoltedVerdict<Dim> bolted;
  Removability<Dim> removability;  // of stable and tapered blocks
  std::vector<std::string> bolts;  // names, that cross its joints
  std::optional<RequiredForce<Dim>> force{};
  std::optional<double> bolt_force{};  // N, along the requested direction
  WorstDirection<Dim> worst{};         // in the earthquake
  std::optional<double> factor_own_trend{}, critical_coefficient{}, critical_own_trend{}, critical_water{};
  std::optional<double> critical_level{};         // m, elevation
  std::optional<double> opening{};                // rad
  int opening_face = -1;                          // in `faces`
  std::vector<int> closed_faces;                  // by elastic shear, in `faces`
  std::optional<double> eccentricity{}, taper{};  // 1; rad
  std::optional<double> factor_moments{};         // of blocks that must turn (limit/block_factor), upper bound

  BlockKind kind() const { return bolted.verdict.kind; }
};

template <int Dim>
struct Survey {
  SurveyRequest request;
  Assembly<Dim> assembly;
  JointSets sets;
  std::string strength, loads;       // where friction, and where bolts, forces and water come from
  std::vector<SurveyRow<Dim>> rows;  // of every free block, by body
  std::vector<SurveyRow<Dim>> clusters;
  long pairs = 0, moving_pairs = 0;
  std::size_t largest_cluster = 2;
  SuccessiveFailure below_one, frictionless;
  std::vector<std::string> notes;  // what the verdicts leave out, one line each
  int fixed = 0;

  std::string joint_name(const RockFace<Dim>& face) const;
  std::string body_names(const SurveyRow<Dim>& row) const;  // "2+5"
};

// Throws BadInput for scenes that it cannot judge.
template <int Dim>
Survey<Dim> survey_blocks(const Prepared<Dim>& prepared, const SurveyRequest& request);

// the properties of joints with which `survey_blocks` judges
template <int Dim>
std::vector<JointProperties> properties_of_request(const Prepared<Dim>& prepared, const SurveyRequest& request);

// The blocks at a stage of the scene, from 0: its geometry, strength, loads and bolts; none if block theory cannot
// judge the scene.
template <int Dim>
std::optional<Assembly<Dim>> assembly_of_stage(const Prepared<Dim>& prepared, int stage);

const char* word_of(BlockKind kind);
// Goodman & Shi's type, with "I" for factors below the required one; empty: none
template <int Dim>
const char* type_of(const SurveyRow<Dim>& row, double required);
// "slides", "slides and turns", "turns"; empty unless it slides
template <int Dim>
const char* motion_of(const SurveyRow<Dim>& row);

}  // namespace voussoir
