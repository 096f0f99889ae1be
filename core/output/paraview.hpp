// What ParaView shows: the blocks with their exact faces, the contacts that touch, and how both change in time.
#pragma once

#include <filesystem>
#include <set>
#include <string>
#include <vector>

#include "core/model/model.hpp"
#include "core/model/prepared.hpp"
#include "core/model/state.hpp"
#include "core/output/vtp.hpp"

namespace voussoir {

// Every face of every part as one polygon, counter-clockwise seen from outside (2-D: every part as one polygon at z =
// 0), where it is now, in world coordinates; excavated bodies are left out. Cell data: body, part, joint (the one that
// made the face, -1 none; 3-D only), set (of that joint, -1 none; 3-D only), fixed, displacement (m, of the body's
// centroid), velocity (m/s). Point data, to single precision: displacement (m, of the point since the start, its part
// by rotation included: the points less this are where they began), velocity (m/s, of the point; half a step behind).
// Field data: body_names, joint_names, set_names.
template <int Dim>
PolyData block_faces(const Model<Dim>& model, const State<Dim>& state, double time, const JointSets& sets = {});

// The contacts that touch, one point each. Point data: body_a, body_b, joint (between them, -1 none), properties,
// normal (from a to b), force (N, on b), overlap (m), area (m²; 2-D: m; 0 where no law asked for it), plastic_slip (m),
// bonded, mobilised_friction_deg. Field data: joint_names, property_names.
template <int Dim>
PolyData contact_points(const Model<Dim>& model, const State<Dim>& state, double time);

// The bodies that touch, a line from centroid to centroid for each two of them. Cell data, to single precision: body_a,
// body_b, contacts (how many of their parts' pairs touch), force (N, on b, of all of them), normal_N (their forces
// along their normals, compression positive, added up), shear_N (the sizes of what is left of each, added up). Point
// data, for tubes as wide as it: magnitude_N, of `force`.
template <int Dim>
PolyData force_lines(const Model<Dim>& model, const State<Dim>& state, double time);

// A growing series of frames in `folder`: frames/blocks_0000.vtp …, frames/contacts_0000.vtp …,
// frames/force_lines_0000.vtp …, blocks.pvd, contacts.pvd, force_lines.pvd, where the scene has supports also
// frames/bolts_0000.vtp … and bolts.pvd, with linings linings_… likewise (support_table.hpp); the name of the series
// stands before each of them.
struct FrameSeries {
  std::filesystem::path folder;
  std::vector<double> times = {};   // of the frames written: s, or the numbers of trials
  std::string name = {};            // empty, or trial_series
  std::set<std::string> lost = {};  // names of those frames that somebody removed; no collection names them
  JointSets sets = {};              // that faces name
};

// the trials of a search that were taken back, by their numbers: frames/trial_blocks_0000.vtp …, trial_blocks.pvd …
inline constexpr const char* trial_series = "trial_";

// The files of both series that are there, whichever run wrote them: frames and collections, relative to the folder.
std::vector<std::filesystem::path> series_files(const std::filesystem::path& folder);

// The series of a run that continues from a checkpoint with frames at these times: frames beyond it, which will be
// written again, are removed, and the collections name what is left. Throws OutputError.
FrameSeries cut_back(const std::filesystem::path& folder, const std::vector<double>& times,
                     const std::string& name = {});

// Adds a frame and renews the collections, so that a run that is cut short can be opened too. Throws OutputError.
template <int Dim>
void write_frame(FrameSeries& series, const Model<Dim>& model, const State<Dim>& state, double time);

}  // namespace voussoir
