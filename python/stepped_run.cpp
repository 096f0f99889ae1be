#include "python/stepped_run.hpp"

#include <algorithm>
#include <optional>
#include <utility>

#include "core/base/version.hpp"
#include "core/model/state_hash.hpp"
#include "core/output/atomic_file.hpp"
#include "core/output/block_verdicts.hpp"
#include "core/output/history_csv.hpp"
#include "core/output/paraview.hpp"
#include "core/output/results_json.hpp"
#include "core/output/support_table.hpp"
#include "core/output/view.hpp"
#include "core/run/block_theory.hpp"
#include "core/run/simulate.hpp"
#include "core/run/snapshot.hpp"
#include "core/scene/accuracy_target.hpp"
#include "core/scene/effective_scene.hpp"
#include "core/scene/judge_values.hpp"
#include "core/scene/read_stages.hpp"
#include "core/scene/scene.hpp"

namespace voussoir::python {

BlockVerdicts judge_blocks(const OpenedScene& scene, const SurveyRequest& request) {
  return std::visit(
      [&]<int Dim>(const Prepared<Dim>& prepared) {
        const Survey<Dim> survey = survey_blocks(prepared, request);
        return BlockVerdicts{.json = blocks_json(survey, scene.stated.title, scene.hash, {}),
                             .csv = blocks_csv(survey),
                             .surface = block_verdict_faces(survey)};
      },
      scene.prepared);
}

namespace {

namespace fs = std::filesystem;

// Features of the program that are missing here are refused: a silently different result would be worse.
void refuse_what_needs_the_program(const Scene& scene) {
  const Subject top{scene.tree.get(), ""};
  const auto accuracy = child(top, "accuracy");
  if (!accuracy) return;
  const Node* budget = accuracy->node->find("budget");
  const char* key = budget && budget->boolean ? "budget" : accuracy_target(*scene.tree) ? "error" : nullptr;
  if (key) refuse(*accuracy, key, "needs several runs, as 'voussoir run' makes them; leave it out here");
}

std::vector<std::pair<std::string, bool>> features() {
  return {{"fast_arithmetic", fast_arithmetic()}};
}

// Makes the folder ready for files of this run.
void claim(const fs::path& folder, bool overwrite, const std::vector<fs::path>& inputs) {
  std::error_code error;
  if (fs::exists(folder / "run.json", error))
    throw FileInTheWay("'" + folder.string() + "' contains a run of the program: save into another folder");
  std::vector<fs::path> files = series_files(folder);
  std::vector<std::string> names = support_table_files();
  names.insert(names.end(), {"scene.toml", "history.csv", "results.json", view_file});
  for (const std::string& name : names)
    if (fs::exists(folder / name, error)) files.push_back(name);
  for (const fs::path& name : files) {
    const std::string shown = "'" + (folder / name).string() + "'";
    const auto is_it = [&](const fs::path& input) { return fs::equivalent(input, folder / name, error); };
    if (std::ranges::any_of(inputs, is_it))
      throw FileInTheWay(shown + " is read by this scene: save into another folder");
    if (!overwrite) throw FileInTheWay(shown + " exists: save into another folder, or with overwrite=True");
  }
  prepare_folder(folder);
  for (const fs::path& name : files)
    remove_file(folder / name);
}

template <int Dim>
class SteppedRunOf : public SteppedRun {
 public:
  SteppedRunOf(std::shared_ptr<const OpenedScene> scene, int threads)
      : scene_(std::move(scene)), prepared_(std::get<Prepared<Dim>>(scene_->prepared)) {
    prepared_.settings.threads = threads;
    progress_ = initial_progress(prepared_);
    show_motions();
  }

  bool advance(long long steps, const std::function<bool()>& stop) override {
    if (broken_) throw std::runtime_error("an error has ended this run; start another one");
    if (done_) return false;
    Watcher<Dim> watcher;
    watcher.pause = [&](const Progress<Dim>&) { return stop() || steps-- <= 0; };
    broken_ = true;
    done_ = simulate(prepared_, progress_, watcher);
    broken_ = false;
    return !done_;
  }

  bool done() const override { return done_; }
  int dimension() const override { return Dim; }
  double time() const override { return progress_.state.schedule.time; }
  long long steps() const override { return progress_.state.counters.steps; }
  std::string state_hash() const override { return voussoir::state_hash(model(), progress_.state); }

  std::string stage() const override { return prepared_.stages.empty() ? "" : prepared_.stages[present_stage()].name; }

  std::vector<std::string> body_names() const override {
    std::vector<std::string> names;
    for (const Body<Dim>& body : model().bodies)
      names.push_back(body.name);
    names.resize(progress_.state.bodies.motions.size());  // before the first step the stage's bodies do not exist yet
    return names;
  }

  std::shared_ptr<const MotionArrays> motions() const override { return motions_; }

  void show_motions() override {
    const std::vector<Motion<Dim>>& moved = progress_.state.bodies.motions;
    const std::size_t bodies = moved.size();
    if (!motions_ || motions_->bodies != static_cast<int>(bodies)) {
      motions_ = std::make_shared<MotionArrays>();
      motions_->bodies = static_cast<int>(bodies);
      motions_->displacement.resize(bodies * Dim);
      motions_->rotation.resize(bodies * spin_freedoms<Dim>);
      motions_->velocity.resize(bodies * Dim);
    }
    for (std::size_t b = 0; b < bodies; ++b) {
      const Spin<Dim> turned = rotation_vector(moved[b].rotation);
      std::copy_n(moved[b].displacement.data(), Dim, motions_->displacement.data() + b * Dim);
      std::copy_n(moved[b].velocity.data(), Dim, motions_->velocity.data() + b * Dim);
      std::copy_n(turned.data(), spin_freedoms<Dim>, motions_->rotation.data() + b * spin_freedoms<Dim>);
    }
  }

  PolyData contacts() const override {
    const Snapshot<Dim> now = snapshot(prepared_, progress_);
    return contact_points(now.model, now.state, now.state.schedule.time);
  }

  PolyData surface() const override {
    return block_faces(model(), progress_.state, progress_.state.schedule.time, prepared_.joint_sets);
  }

  std::string results() const override {
    if (done_) return results_json(complete_results(), record());
    Results so_far = progress_.results;
    so_far.counters = progress_.state.counters;
    so_far.energy = progress_.state.ledger.energy;
    so_far.state_hash = state_hash();
    return results_json(so_far, record());
  }

  History history() const override { return history_so_far(progress_); }

  void save(const fs::path& folder, bool overwrite) override {
    if (!saved_ || saved_->folder != folder) {
      claim(folder, overwrite, scene_->stated.files);
      saved_ = FrameSeries{.folder = folder, .sets = prepared_.joint_sets};
      saved_view_.reset();
      if (prepared_.output.view) saved_view_ = begin_view(folder / view_file, prepared_);
      write_file(folder / "scene.toml", scene_->text);
    }
    write_history_csv(folder / "history.csv", history());
    write_support_tables(folder, progress_.results);
    if (const Snapshot<Dim> now = snapshot(prepared_, progress_);
        saved_->times.empty() || saved_->times.back() != now.state.schedule.time) {
      write_frame(*saved_, now.model, now.state, now.state.schedule.time);
      if (saved_view_) add_present(*saved_view_, now);
    }
    if (done_) write_results_json(folder / "results.json", complete_results(), record());
  }

  void write_view(const fs::path& folder) const override {
    ViewSeries view = begin_view(folder / view_file, prepared_);
    add_present(view, snapshot(prepared_, progress_));
  }

 private:
  void add_present(ViewSeries& view, const Snapshot<Dim>& now) const {
    add_view_frame(view, now.model, now.state, {ViewMoment::Kind::frame, now.state.schedule.time, present_stage(), 0});
  }

  // or the last one
  int present_stage() const { return std::min(progress_.stage, static_cast<int>(prepared_.stages.size()) - 1); }

  Results complete_results() const {
    Results complete = progress_.results;
    add_block_theory(prepared_, complete);
    return complete;
  }

  Model<Dim> model() const { return model_of(prepared_, progress_); }

  RunRecord record() const {
    RunRecord record;
    record.title = prepared_.title;
    record.dimension = Dim;
    record.input_hash = scene_->hash;
    record.features = features();
    record.warnings = scene_->warnings;
    record.threads = prepared_.settings.threads;
    record.records = record_rows(prepared_.stages);
    return record;
  }

  std::shared_ptr<const OpenedScene> scene_;
  Prepared<Dim> prepared_;
  Progress<Dim> progress_;
  bool done_ = false, broken_ = false;
  std::shared_ptr<MotionArrays> motions_;
  std::optional<FrameSeries> saved_;
  std::optional<ViewSeries> saved_view_;
};

template <int Dim>
void cut(OpenedScene& scene) {
  Prepared<Dim> prepared = prepare<Dim>(scene.stated);
  scene.warnings = judge_values<Dim>(scene.stated, prepared);
  scene.prepared = std::move(prepared);
}

}  // namespace

std::shared_ptr<const OpenedScene> open_scene(Scene stated) {
  refuse_what_needs_the_program(stated);
  const auto scene = std::make_shared<OpenedScene>();
  scene->stated = std::move(stated);
  scene->text = toml_text(*scene->stated.tree);
  scene->hash = input_hash(scene->stated);
  scene->stated.dimension == 2 ? cut<2>(*scene) : cut<3>(*scene);
  return scene;
}

std::unique_ptr<SteppedRun> start(const std::shared_ptr<const OpenedScene>& scene, int threads) {
  require_stages(scene->stated);
  if (scene->stated.dimension == 2) return std::make_unique<SteppedRunOf<2>>(scene, threads);
  return std::make_unique<SteppedRunOf<3>>(scene, threads);
}

}  // namespace voussoir::python
