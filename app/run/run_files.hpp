// What a run writes as it proceeds: tables, frames for ParaView and for the viewer, the viewer's page.
#pragma once

#include <filesystem>
#include <optional>

#include "core/output/paraview.hpp"
#include "core/output/view.hpp"
#include "core/run/simulate.hpp"

namespace voussoir {

// The path to the answer, and the trials that were taken back; what the viewer shows has both. Those that the scene
// does not ask for are not written.
struct WrittenSeries {
  std::optional<FrameSeries> frames, trials;
  std::optional<ViewSeries> view;
};

template <int Dim>
void write_tables(const std::filesystem::path& folder, const Progress<Dim>& progress);

// Cuts off what the run so far has written beyond `progress`, its checkpoint, and warns of what is lost.
template <int Dim>
WrittenSeries cut_back_to(const Prepared<Dim>& prepared, const Progress<Dim>& progress,
                          const std::filesystem::path& folder);

// Lets `watcher` write the frames of the run that is at `progress`.
template <int Dim>
void write_frames(WrittenSeries& written, const Progress<Dim>& progress, Watcher<Dim>& watcher);

// a program without the viewer leaves the page to one that has it
void write_page(const std::filesystem::path& folder);

}  // namespace voussoir
