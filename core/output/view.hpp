// Data of the viewer (viewer/README.md), from model and state: a file of records that grows with a run, so that a
// killed run can be shown up to that point. Geometry is in it once, in the bodies' frames; a frame has 24 bytes per
// body (12 in 2-D) for its pose, 4 for its speed, and the forces of its contacts.
#pragma once

#include <array>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/model/model.hpp"
#include "core/model/prepared.hpp"
#include "core/model/state.hpp"

namespace voussoir {

// the kind of a frame
struct ViewMoment {
  enum class Kind { start, frame, trial };  // trial: of a search, and undone
  Kind kind = Kind::frame;
  double time = 0;  // s
  int stage = 0;    // from 0
  int trial = 0;    // from 1; 0: none
};

// the data of a body in the file: it gets a new shape when an excavation divides it
struct ShownBody {
  std::size_t corners = 0;
  double mass = 0;
  bool present = false;

  bool operator==(const ShownBody&) const = default;
};

// Two touching faces have their names and numbers in the file once: bodies, parts and faces of both, then joint and
// properties.
using ViewPair = std::array<int, 8>;

// the present content of the file
struct ViewSeries {
  std::filesystem::path file;
  int frames = 0;                      // written, including that of the start
  std::vector<ShownBody> shown = {};   // by body
  std::map<ViewPair, int> pairs = {};  // by their number
};

inline constexpr const char* view_file = "view.bin";

// A new file with the constant data and the blocks before the first stage. Throws OutputError.
template <int Dim>
ViewSeries begin_view(const std::filesystem::path& file, const Prepared<Dim>& scene);

// The file of a run that continues, truncated to its first `frames` frames, including that of the start; a missing,
// damaged or shorter file is started again, with fewer frames. Throws OutputError.
template <int Dim>
ViewSeries continue_view(const std::filesystem::path& file, const Prepared<Dim>& scene, int frames);

// Adds a frame. Positions are to single precision, speeds and contact forces to four digits. A number that is not
// finite is written as 0. Throws OutputError.
template <int Dim>
void add_view_frame(ViewSeries& series, const Model<Dim>& model, const State<Dim>& state, const ViewMoment& moment);

// A block by block theory, for its colour and its text.
struct ViewVerdict {
  enum class Kind { judged, stable, immovable, fixed, undecided };  // viewer/src/colours.js has the same order
  Kind kind = Kind::fixed;
  std::optional<double> factor{};  // of safety; of judged ones
  std::string sentence;
};

// Adds the verdicts of all bodies, and when they hold. Throws OutputError.
void add_view_verdicts(const ViewSeries& series, const std::string& moment, const std::vector<ViewVerdict>& verdicts);

// Number of these bytes that are complete records, at most up to the end of `frames` frames, and the number of frames
// in them; nothing if they are not such a file. Further bytes were being written when a program was killed.
struct ViewExtent {
  std::size_t bytes = 0;
  int frames = 0;
};
ViewExtent view_extent(std::string_view bytes, int frames);

}  // namespace voussoir
