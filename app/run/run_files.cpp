#include "app/run/run_files.hpp"

#include <fmt/format.h>

#include <set>
#include <string>

#include "app/base/message.hpp"
#include "app/run_folder/search_files.hpp"
#include "app/view/page.hpp"
#include "core/output/atomic_file.hpp"
#include "core/output/history_csv.hpp"
#include "core/output/record_output.hpp"
#include "core/output/support_table.hpp"

namespace voussoir {
namespace {

namespace fs = std::filesystem;

template <int Dim>
ViewSeries cut_back_view(const Prepared<Dim>& prepared, const Progress<Dim>& progress, const fs::path& file) {
  const int frames = static_cast<int>(progress.frames.size() + progress.trial_frames.size());
  if (frames == 0) return begin_view(file, prepared);
  ViewSeries view = continue_view(file, prepared, frames + 1);
  if (view.frames == 0)
    tell("voussoir: warning: '{}' is gone or damaged: the viewer shows the frames from here on\n", file.string());
  return view;
}

}  // namespace

template <int Dim>
void write_tables(const fs::path& folder, const Progress<Dim>& progress) {
  write_history_csv(folder / "history.csv", history_so_far(progress));
  write_support_tables(folder, progress.results);
  write_search(folder, progress.results);
}

template <int Dim>
WrittenSeries cut_back_to(const Prepared<Dim>& prepared, const Progress<Dim>& progress, const fs::path& folder) {
  WrittenSeries written;
  if (prepared.output.frames) {
    written.frames = cut_back(folder, progress.frames);
    written.trials = cut_back(folder, progress.trial_frames, trial_series);
    written.frames->sets = written.trials->sets = prepared.joint_sets;
    std::set<std::string> lost = written.frames->lost;
    lost.insert(written.trials->lost.begin(), written.trials->lost.end());
    if (!lost.empty())
      tell("voussoir: warning: {} files of frames are gone, {} the first: the .pvd files leave them out\n", lost.size(),
           *lost.begin());
  }
  if (prepared.output.view) written.view = cut_back_view(prepared, progress, folder / view_file);
  write_tables(folder, progress);
  return written;
}

template <int Dim>
void write_frames(WrittenSeries& written, const Progress<Dim>& progress, Watcher<Dim>& watcher) {
  watcher.frame = [&](const Model<Dim>& model, const State<Dim>& state, double time) {
    if (written.frames) write_frame(*written.frames, model, state, time);
    if (written.view) add_view_frame(*written.view, model, state, {ViewMoment::Kind::frame, time, progress.stage, 0});
  };
  watcher.trial_frame = [&](const Model<Dim>& model, const State<Dim>& state, int trial) {
    if (written.trials) write_frame(*written.trials, model, state, trial);
    if (written.view)
      add_view_frame(*written.view, model, state,
                     {ViewMoment::Kind::trial, state.schedule.time, progress.stage, trial});
  };
}

void write_record_spectra(const fs::path& folder, const std::vector<StagePlan>& stages) {
  if (const std::string table = record_spectra_csv(record_rows(stages)); !table.empty())
    write_file(folder / record_spectra_file, table);
}

void write_monitor_spectra(const fs::path& folder, const History& history, const std::vector<StagePlan>& stages) {
  if (const std::string table = monitor_spectra_csv(history, stages); !table.empty())
    write_file(folder / monitor_spectra_file, table);
}

void write_page(const fs::path& folder) {
  write_file(folder / page_file, view_page(folder / view_file));
}

template void write_tables<2>(const fs::path&, const Progress<2>&);
template void write_tables<3>(const fs::path&, const Progress<3>&);
template WrittenSeries cut_back_to<2>(const Prepared<2>&, const Progress<2>&, const fs::path&);
template WrittenSeries cut_back_to<3>(const Prepared<3>&, const Progress<3>&, const fs::path&);
template void write_frames<2>(WrittenSeries&, const Progress<2>&, Watcher<2>&);
template void write_frames<3>(WrittenSeries&, const Progress<3>&, Watcher<3>&);

}  // namespace voussoir
