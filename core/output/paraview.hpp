// Frames for ParaView: the blocks with their exact faces, the touching contacts, and their changes in time.
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
// 0), in its present position, in world coordinates; excavated bodies are left out. Cell data: body, part, joint (the
// one that made the face, -1 none; 3-D only), set (of that joint, -1 none; 3-D only), fixed, displacement (m, of the
// body's centroid), velocity (m/s). Point data, to single precision: displacement (m, of the point since the start,
// including rotation: points minus this are the initial positions), velocity (m/s, of the point; half a step behind).
// Field data: body_names, joint_names, set_names.
template <int Dim>
PolyData block_faces(const Model<Dim>& model, const State<Dim>& state, double time, const JointSets& sets = {});

// The contacts that touch, one point each. Point data: body_a, body_b, joint (between them, -1 if none), properties,
// normal (from a to b), force (N, on b), overlap (m), area (m²; 2-D: m; 0 if no law needs it), plastic_slip (m),
// bonded, mobilised_friction_deg. Field data: joint_names, property_names.
template <int Dim>
PolyData contact_points(const Model<Dim>& model, const State<Dim>& state, double time);

// The bodies that touch, a line from centroid to centroid for each two of them. Cell data, to single precision: body_a,
// body_b, contacts (number of touching pairs of their parts), force (N, on b, of all of them), normal_N (sum of their
// forces along their normals, compression positive), shear_N (sum of the magnitudes of their shear forces). Point data,
// for tubes of this width: magnitude_N, of `force`.
template <int Dim>
PolyData force_lines(const Model<Dim>& model, const State<Dim>& state, double time);

// A growing series of frames in `folder`: frames/blocks_0000.vtp …, frames/contacts_0000.vtp …,
// frames/force_lines_0000.vtp …, blocks.pvd, contacts.pvd, force_lines.pvd, if the scene has supports also
// frames/bolts_0000.vtp … and bolts.pvd, with linings linings_… likewise (support_table.hpp); the name of the series is
// a prefix of each of them.
struct FrameSeries {
  std::filesystem::path folder;
  std::vector<double> times = {};   // of the frames written: s, or the numbers of trials
  std::string name = {};            // empty, or trial_series
  std::set<std::string> lost = {};  // names of frames that have been removed; no collection names them
  JointSets sets = {};              // named by faces
};

// the undone trials of a search, by their numbers: frames/trial_blocks_0000.vtp …, trial_blocks.pvd …
inline constexpr const char* trial_series = "trial_";

// The existing files of both series, whichever run wrote them: frames and collections, relative to the folder.
std::vector<std::filesystem::path> series_files(const std::filesystem::path& folder);

// The series of a run that continues from a checkpoint with frames at these times: later frames, which will be written
// again, are removed, and the collections name the remaining ones. Throws OutputError.
FrameSeries cut_back(const std::filesystem::path& folder, const std::vector<double>& times,
                     const std::string& name = {});

// Adds a frame and renews the collections, so that an interrupted run can be opened too. Throws OutputError.
template <int Dim>
void write_frame(FrameSeries& series, const Model<Dim>& model, const State<Dim>& state, double time);

}  // namespace voussoir
