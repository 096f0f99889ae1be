// What the viewer shows (viewer/README.md), straight from model and state: a file of records that grows with a run, so
// that one that is killed can be seen up to there. Geometry is in it once, in the bodies' frames; a frame is 24
// bytes a body (in the plane 12) for where it is, 4 for its speed, and what its contacts carry.
#pragma once

#include <array>
#include <filesystem>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "core/model/model.hpp"
#include "core/model/prepared.hpp"
#include "core/model/state.hpp"

namespace voussoir {

// what a frame is of
struct ViewMoment {
  enum class Kind { start, frame, trial };  // trial: of a search, and taken back
  Kind kind = Kind::frame;
  double time = 0;  // s
  int stage = 0;    // from 0
  int trial = 0;    // from 1; 0: none
};

// what the file has of a body: it gets a new shape when an excavation parts it
struct ShownBody {
  std::size_t corners = 0;
  double mass = 0;
  bool present = false;

  bool operator==(const ShownBody&) const = default;
};

// Two faces that touch have their names and numbers in the file once: bodies, parts and faces of both, then joint and
// properties.
using ViewPair = std::array<int, 8>;

// the file as it stands
struct ViewSeries {
  std::filesystem::path file;
  int frames = 0;                      // written, that of the start among them
  std::vector<ShownBody> shown = {};   // by body
  std::map<ViewPair, int> pairs = {};  // by their number
};

inline constexpr const char* view_file = "view.bin";

// A new file with what does not change and the blocks as they lie before the first stage. Throws OutputError.
template <int Dim>
ViewSeries begin_view(const std::filesystem::path& file, const Prepared<Dim>& scene);

// The file of a run that continues, cut back to its first `frames` frames, that of the start among them; one that is
// not there, damaged or shorter begins again, and has fewer. Throws OutputError.
template <int Dim>
ViewSeries continue_view(const std::filesystem::path& file, const Prepared<Dim>& scene, int frames);

// Adds a frame. Positions are to single precision, speeds and what contacts carry to four digits. A number that is not
// finite is written as 0. Throws OutputError.
template <int Dim>
void add_view_frame(ViewSeries& series, const Model<Dim>& model, const State<Dim>& state, const ViewMoment& moment);

// How many bytes of these are whole records, at most up to the end of `frames` frames, and how many frames they hold;
// nothing where they are no such file. Bytes that follow were being written when a program was killed.
struct ViewExtent {
  std::size_t bytes = 0;
  int frames = 0;
};
ViewExtent view_extent(std::string_view bytes, int frames);

}  // namespace voussoir
