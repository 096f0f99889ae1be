// The files of a run in progress: tables, frames for ParaView and for the viewer, the viewer's page.
#pragma once

#include <filesystem>
#include <optional>

#include "core/output/paraview.hpp"
#include "core/output/view.hpp"
#include "core/run/simulate.hpp"

namespace voussoir {

// The path to the result, and the trials that were rejected; the viewer shows both. Series that the scene does not
// request are not written.
struct WrittenSeries {
  std::optional<FrameSeries> frames, trials;
  std::optional<ViewSeries> view;
};

template <int Dim>
void write_tables(const std::filesystem::path& folder, const Progress<Dim>& progress);

// Removes output beyond `progress`, the run's checkpoint, and warns of lost files.
template <int Dim>
WrittenSeries cut_back_to(const Prepared<Dim>& prepared, const Progress<Dim>& progress,
                          const std::filesystem::path& folder);

// Lets `watcher` write the frames of the run that is at `progress`.
template <int Dim>
void write_frames(WrittenSeries& written, const Progress<Dim>& progress, Watcher<Dim>& watcher);

// response spectra of the records that the stages prescribe, if there are any
void write_record_spectra(const std::filesystem::path& folder, const std::vector<StagePlan>& stages);
void write_monitor_spectra(const std::filesystem::path& folder, const History& history,
                           const std::vector<StagePlan>& stages);

// a program without the viewer leaves the page to one that has it
void write_page(const std::filesystem::path& folder);

}  // namespace voussoir
