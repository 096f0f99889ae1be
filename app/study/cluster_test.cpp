// The examples of examples/cluster, run: a study by an array of Slurm tasks of which some are requeued, killed, or lose
// their node, on a cluster that the test starts.
#include <sys/inotify.h>

#include "app/run_folder/claimed_folder.hpp"
#include "app/testing/loopback_slurm.hpp"
#include "app/testing/planned_study.hpp"

namespace voussoir {
namespace {

namespace fs = std::filesystem;

// Counts files that are renamed into place in the folders of runs: each file that the program writes completely.
class Watch {
 public:
  void add(const fs::path& folder) {
    fs::create_directories(folder);
    folders_[::inotify_add_watch(file_, folder.c_str(), IN_MOVED_TO)] = folder.filename();
  }
  ~Watch() { ::close(file_); }

  // how often each folder's file of this name was written
  std::map<std::string, int> count(const std::string& name) {
    alignas(inotify_event) char buffer[1 << 16];
    for (ssize_t length; (length = ::read(file_, buffer, sizeof buffer)) > 0;)
      for (ssize_t at = 0; at < length;) {
        const auto* event = reinterpret_cast<const inotify_event*>(buffer + at);
        EXPECT_FALSE(event->mask & IN_Q_OVERFLOW);
        if (event->len > 0) ++counts_[event->name][folders_.at(event->wd)];
        at += static_cast<ssize_t>(sizeof *event) + event->len;
      }
    return counts_[name];
  }

 private:
  int file_ = ::inotify_init1(IN_NONBLOCK | IN_CLOEXEC);
  std::map<int, std::string> folders_;
  std::map<std::string, std::map<std::string, int>> counts_;
};

// the rows of planned_study.hpp, and three that run long enough to be disturbed
class Slurm : public PlannedStudy {
 protected:
  static constexpr int slow_rows = 3, different_runs = study_runs + slow_rows;
  const std::string array_ = VOUSSOIR_SOURCE_DIR "/examples/cluster/array.sh";

  Slurm() {
    write("slow.toml", cubes_scene(2, 2, 2, 4.0, 10));
    write("study.toml", std::string(study_plan) + R"(
[[sweep]]
name = "slow"
scene = "slow.toml"
key = "density"
values = [2000, 2500, 3000]
)");
    const std::string path = std::getenv("PATH");
    ::setenv("PATH", (fs::path(VOUSSOIR_PROGRAM).parent_path().string() + ":" + path).c_str(), 1);
  }

  fs::path slow_run(int k) const { return run_of("out", study_rows + k); }

  // the rows that a message about missing rows names
  static std::string rows_named_in(const std::string& text) {
    const std::string before = "\nnot run: ";
    const std::size_t found = text.find(before);
    return found == std::string::npos
               ? ""
               : text.substr(found + before.size(), text.find(';', found) - found - before.size());
  }

  // The worker process (`voussoir study run`) of this run, as soon as the run is well under way: after a tenth of its
  // time, much later than its begin.
  int worker_of(const fs::path& run) const {
    int worker = 0;
    const auto is_under_way = [&] {
      if (!fs::exists(run / "run.json")) return false;
      worker = std::stoi(read(run / worker_file).substr(std::string("process ").size()));
      const std::vector<int> children = children_of(worker);
      return children.size() == 1 && processor_time(children[0]) > 0.2;
    };
    EXPECT_TRUE(wait_until(is_under_way)) << run;
    EXPECT_FALSE(fs::exists(run / "results.json")) << "too quick to be disturbed";
    return worker;
  }

  // s, of a process of our own; 0: none
  static double processor_time(int process) {
    std::istringstream stat(read(fmt::format("/proc/{}/stat", process)));
    std::string skipped;
    for (int field = 1; field < 14; ++field)
      stat >> skipped;
    double user = 0, system = 0;
    stat >> user >> system;
    return (user + system) / static_cast<double>(::sysconf(_SC_CLK_TCK));
  }

  // Each run ended once. Disturbed runs continued from their checkpoints; only those without one began again.
  void expect_each_run_once(Watch& watch, const std::set<std::string>& without_checkpoint) const {
    const std::map<std::string, int> begun = watch.count("run.json"), done = watch.count("results.json");
    EXPECT_EQ(begun.size(), static_cast<std::size_t>(different_runs));
    EXPECT_EQ(done.size(), static_cast<std::size_t>(different_runs));
    for (const auto& [run, times] : done)
      EXPECT_EQ(times, 1) << run;
    for (const auto& [run, times] : begun)
      EXPECT_EQ(times, without_checkpoint.contains(run) ? 2 : 1) << run;
  }
};

TEST_F(Slurm, AnArrayThatIsDisturbedGivesTheSameFile) {
  if (const std::string missing = LoopbackSlurm::missing(); !missing.empty()) GTEST_SKIP() << missing;
  const std::string out = planned("out");
  Watch watch;
  for (int row = 1; row <= study_rows + slow_rows; ++row)
    watch.add(run_of("out", row));

  LoopbackSlurm slurm(folder_ / "slurm");
  ASSERT_TRUE(slurm.is_up()) << slurm.log();
  const std::string job = slurm.submit(fmt::format("--array=1-4 '{}' '{}' 4", array_, out));

  // the most expensive rows come first, one in each share
  worker_of(slow_run(1));
  EXPECT_EQ(said(fmt::format("scontrol requeue {}_1", job)), "");
  ::kill(worker_of(slow_run(2)), SIGKILL);
  ASSERT_TRUE(wait_until([&] { return fs::exists(slow_run(1) / "checkpoint"); })) << slurm.log();
  EXPECT_GT(checkpoint_record(read(slow_run(1) / "checkpoint")).step, 0);
  slurm.kill_node(LoopbackSlurm::node_of(worker_of(slow_run(3))));
  // while Slurm detects that
  EXPECT_EQ(study({at("study.toml"), "--out", at("whole")}).code, 0);
  ASSERT_TRUE(slurm.wait_until_idle()) << slurm.log();

  // Slurm itself repeats requeued tasks and those that lost their node, not killed ones
  const std::string missing = rows_named_in(study({"gather", out}).out);
  EXPECT_NE(missing, "") << slurm.log();
  EXPECT_NE(study({"status", out}).out.find("rows done\nnot run: " + missing + "\n"), std::string::npos) << missing;
  // the run that lost its node, and the killed one if Slurm ended its task before the first checkpoint
  std::set<std::string> without_checkpoint{slow_run(3).filename()};
  if (!fs::exists(slow_run(2) / "checkpoint")) without_checkpoint.insert(slow_run(2).filename());
  const std::string again = slurm.submit(fmt::format("--array=1-2 '{}' '{}' 2 {}", array_, out, missing));
  ASSERT_TRUE(slurm.wait_until_idle()) << slurm.log();
  for (const char* task : {"_1", "_2"})
    EXPECT_NE(slurm.output(again + task).find(" 0 of them kept"), std::string::npos) << slurm.output(again + task);
  const Ended gathered = study({"gather", out});
  EXPECT_EQ(gathered.code, 0) << gathered.out << gathered.err;
  EXPECT_EQ(table("out"), table("whole"));
  expect_each_run_once(watch, without_checkpoint);
}

}  // namespace
}  // namespace voussoir
