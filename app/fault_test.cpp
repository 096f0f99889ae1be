// Nothing is lost: a run that is killed, asked to stop, locked out, or finds its folder damaged gives, once it
// continues, the bits of an undisturbed run.
#include <sys/file.h>

#include <array>
#include <boost/random/mersenne_twister.hpp>
#include <boost/random/uniform_real_distribution.hpp>
#include <chrono>
#include <sstream>

#include "app/testing/faults.hpp"

namespace voussoir::fault_test {
namespace {

namespace fs = std::filesystem;

using Clock = std::chrono::steady_clock;
using Seconds = std::chrono::duration<double>;

// 27 blocks, 145 checkpoints, ten frames. The thousand kills have a hundred blocks, which take much longer and write
// files of the same names.
const std::string large = cubes_scene(3, 3, 3, 0.02, 10);
const std::string hundred = cubes_scene(4, 4, 6, 0.02, 10);
constexpr int large_steps = 7;  // between checkpoints
// a dozen blocks for a few hundredths of a second
const std::string small = cubes_scene(2, 2, 3, 0.008, 3);
constexpr int small_steps = 20;

constexpr std::array stopping{SIGINT, SIGTERM, SIGHUP, SIGQUIT, SIGUSR1, SIGXCPU};

class Faults : public FaultTest {
 protected:
  // the large undisturbed run, made once for all tests
  const Contents& undisturbed_large() const {
    static const Contents complete = undisturbed(write("large.toml", large), large_steps);
    return complete;
  }

  void survive_kills(const std::string& text, int wanted) const;
  void stop_by(int signal, bool continues) const;

  Process under_way(const std::string& scene, const std::string& out, Launch launch = {},
                    int steps = large_steps) const {
    launch.arguments = run_arguments(scene, out, steps);
    return {VOUSSOIR_PROGRAM, launch, folder_ / "under_way"};
  }

  // The large run, held by SIGSTOP when it has this file and not yet its last frames: on a busy machine a run may be
  // over before we look, then another begins.
  std::unique_ptr<Process> held(const std::string& out, Launch launch = {}, const char* file = "checkpoint") const {
    launch.arguments = run_arguments(write("large.toml", large), out, large_steps);
    std::unique_ptr<Process> process;
    for (int attempt = 0; attempt < 50; ++attempt) {
      process.reset();
      fs::remove_all(out);
      process = std::make_unique<Process>(VOUSSOIR_PROGRAM, launch, folder_ / "under_way");
      EXPECT_TRUE(wait_until([&] { return fs::exists(fs::path(out) / file) || process->has_ended(); }));
      if (process->hold() && !fs::exists(out + "/frames/blocks_0008.vtp")) return process;
    }
    ADD_FAILURE() << "no run was caught under way";
    return process;
  }

  // the large run, stopped with two checkpoints in its folder
  std::string interrupted(const std::string& out) const {
    const auto process = held(at(out), {}, "checkpoint.previous");
    send_held(*process, {SIGTERM});
    EXPECT_EQ(process->wait().code, 128 + SIGTERM);
    return at(out);
  }

  // to a run that is held: all arrive before it continues, and it has no step in which to notice the first
  static void send_held(const Process& process, std::initializer_list<int> signals) {
    for (const int signal : signals)
      process.send(signal);
    process.send(SIGCONT);
  }
};

// ---- kills --------------------------------------------------------------------------------------------------------

// Kills at random moments, between a hundredth of the run's own time and an eighth of it, run after run until there
// were enough. Every other one counts from the moment at which there is a checkpoint, however slow the machine.
void Faults::survive_kills(const std::string& text, int wanted) const {
  const std::string scene = write("scene.toml", text);
  const Clock::time_point began = Clock::now();
  const Contents complete = undisturbed(scene, large_steps);
  const double whole = Seconds(Clock::now() - began).count();
  ASSERT_TRUE(complete.contains("frames/blocks_0009.vtp"));

  boost::random::mt19937 random(20260101);
  boost::random::uniform_real_distribution<double> fraction(1.0 / 120, 1.0 / 8);
  int kills = 0, with_progress = 0, runs = 0, starts = 0;
  while (kills < wanted) {
    const std::string out = at("killed");
    fs::remove_all(out);
    for (bool done = false; !done; ++starts) {
      Launch launch{.arguments = run_arguments(scene, out, large_steps)};
      if (fs::exists(out + "/run.json")) launch.arguments = resume_arguments(out);
      launch.arguments.insert(launch.arguments.end(), {"--threads", starts % 3 == 2 ? "2" : "1"});
      Process process = start(launch);
      if (kills < wanted) {
        if (kills % 2 == 0)
          ASSERT_TRUE(wait_until([&] { return fs::exists(out + "/checkpoint") || process.has_ended(); }));
        std::this_thread::sleep_for(Seconds(whole * fraction(random)));
        process.send(SIGKILL);
      }
      const Ended ended = process.wait();
      done = ended.signal == 0;
      if (done) {
        ASSERT_EQ(ended.code, 0) << ended.err;
        EXPECT_EQ(ended.err, "") << "every checkpoint was whole";
      } else {
        ++kills;
        with_progress += fs::exists(out + "/checkpoint");
      }
    }
    Contents found = contents_of(out);
    // names the number of threads the run began with, not its results
    found["run.json"] = complete.at("run.json");
    expect_equal(found, complete, fmt::format("run {} after {} kills", runs, kills));
    ++runs;
  }
  EXPECT_GE(kills, wanted);
  EXPECT_GE(with_progress, wanted / 3) << "of " << kills << " kills in " << runs << " runs";
  RecordProperty("kills", kills);
  RecordProperty("kills_with_a_checkpoint", with_progress);
  RecordProperty("runs", runs);
}

TEST_F(Faults, FifteenKillsLoseNothing) {
  survive_kills(large, 15);
}

using FaultsLong = Faults;

TEST_F(FaultsLong, AThousandKillsLoseNothing) {
  survive_kills(hundred, 1000);
}

// ---- signals ------------------------------------------------------------------------------------------------------

void Faults::stop_by(int signal, bool continues) const {
  const std::string out = at("stopped");
  const auto process = held(out);
  send_held(*process, {signal});
  expect_one_line(process->wait(), 128 + signal, "continue with 'voussoir resume " + out + "'");
  EXPECT_NO_THROW(checkpoint_record(read(out + "/checkpoint")));
  if (!continues) return;
  const Ended ended = run({.arguments = resume_arguments(out)});
  EXPECT_EQ(ended.code, 0) << ended.err;
  EXPECT_EQ(ended.err, "");
  expect_equal(contents_of(out), undisturbed_large(), fmt::format("signal {}", signal));
}

// all have one handler: of one the run that continues is compared, of each in the Long test
TEST_F(Faults, ASignalStopsWithACheckpoint) {
  for (const int signal : stopping)
    stop_by(signal, signal == SIGTERM);
}

TEST_F(FaultsLong, AfterEachSignalTheRunContinues) {
  for (const int signal : stopping)
    stop_by(signal, true);
}

TEST_F(Faults, ASecondSignalOfTheKeyboardEndsTheRun) {
  const std::string scene = write("scene.toml", large), out = at("stopped");
  const Contents& complete = undisturbed_large();
  const auto process = held(out);
  send_held(*process, {SIGINT, SIGQUIT});
  EXPECT_EQ(process->wait().signal, SIGQUIT);
  EXPECT_EQ(finish(scene, out, large_steps).code, 0);
  expect_equal(contents_of(out), complete, "two signals");
}

// as when a batch system ends a job, whose processes receive signals from the system and from one another
TEST_F(Faults, ASecondSignalOfAMachineLeavesTheCheckpoint) {
  const std::string scene = write("scene.toml", large), out = at("stopped");
  const Contents& complete = undisturbed_large();
  const auto process = held(out);
  // the signal with the smallest number is delivered first
  send_held(*process, {SIGHUP, SIGUSR1, SIGTERM, SIGXCPU});
  expect_one_line(process->wait(), 128 + SIGHUP, "continue with 'voussoir resume " + out + "'");
  EXPECT_NO_THROW(checkpoint_record(read(out + "/checkpoint")));
  EXPECT_EQ(finish(scene, out, large_steps).code, 0);
  expect_equal(contents_of(out), complete, "four signals");
}

// the system repeats it with every second of processor time
TEST_F(Faults, ARepeatedLimitOfProcessorTimeStillLeavesACheckpoint) {
  const std::string scene = write("scene.toml", large), out = at("stopped");
  const Contents& complete = undisturbed_large();
  const auto process = held(out);
  process->send(SIGCONT);
  for (int k = 0; k < 20; ++k) {
    process->send(SIGXCPU);
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }
  expect_one_line(process->wait(), 128 + SIGXCPU, "continue with 'voussoir resume " + out + "'");
  EXPECT_EQ(finish(scene, out, large_steps).code, 0);
  expect_equal(contents_of(out), complete, "a limit of processor time");
}

TEST_F(Faults, AnIgnoredHangupStaysIgnored) {
  const std::string scene = write("scene.toml", large), out = at("deaf");
  const auto process = held(out, {.deaf_to_hangup = true});
  send_held(*process, {SIGHUP});
  EXPECT_EQ(process->wait().code, 0);
}

TEST_F(Faults, ASearchStopsAndContinuesToo) {
  const std::string scene = write("scene.toml", R"(title = "A block on a plane"
preset = "thesis"
dimension = 3
gravity = [0, 0, -10]
density = 2000
domain = { box = { min = [0, 0, -2], max = [2, 2, 2] } }
joints = [{ name = "bed", dip = 20, dip_direction = 90, point = [1, 1, 0] }]
joint_properties = [{ name = "rock", normal_stiffness = 1e8, shear_stiffness = 1e7, friction_deg = 60 }]
fix = [{ below = ["bed"] }]
restrain = [{ above = ["bed"], rotation = true }]
stage = [{ name = "settle", kind = "settle", gravity_ramp_s = 0.05 },
         { name = "reduce", kind = "reduce", method = "bisection", from_deg = 60, to_deg = 5, tolerance_deg = 0.001 }]
)");
  constexpr int steps = 200;  // between checkpoints
  const Contents complete = undisturbed(scene, steps);
  const auto results = nlohmann::json::parse(complete.at("results.json"));
  const long long settled = results["stages"][0]["steps"], all = results["counters"]["steps"];
  EXPECT_NEAR(results["values"]["critical_friction"]["value"].get<double>(), 20, 0.1);
  ASSERT_GT(all, settled + 1000);

  const std::string out = at("stopped");
  Process process = under_way(scene, out, {}, steps);
  ASSERT_TRUE(wait_until([&] {
    return fs::exists(out + "/checkpoint") && checkpoint_record(read(out + "/checkpoint")).step > settled + 100;
  }));
  process.send(SIGINT);
  expect_one_line(process.wait(), 128 + SIGINT, "resume");
  EXPECT_EQ(finish(scene, out, steps).code, 0);
  expect_equal(contents_of(out), complete, "a search");
}

// ---- two runs in one folder ---------------------------------------------------------------------------------------

TEST_F(Faults, AFolderHasOneRunAtATime) {
  const std::string scene = write("scene.toml", large), out = at("shared");
  const Contents& complete = undisturbed_large();
  const auto process = held(out);
  const std::string holder = fmt::format("in use by process {} ", process->pid());
  Launch again{.arguments = run_arguments(scene, out, large_steps)};
  expect_one_line(run(again), 3, holder, "run ");
  again.arguments.push_back("--overwrite");
  expect_one_line(run(again), 3, holder, "run --overwrite ");
  expect_one_line(run({.arguments = resume_arguments(out)}), 3, holder, "resume ");
  expect_one_line(run({.arguments = {"slice", scene, "--out", out}}), 3, holder, "slice ");
  const std::string plan = write("study.toml", R"(scene = "scene.toml"
quantity = "top_displacement_z"
sweep = [{ name = "stiffness", key = "joint_properties.rock.normal_stiffness", values = [1e9] }]
)");
  expect_one_line(run({.arguments = {"study", plan, "--out", out}}), 3, holder, "study ");

  // the lock dies with its holder
  process->send(SIGKILL);
  process->wait();
  EXPECT_EQ(run({.arguments = resume_arguments(out)}).code, 0);
  expect_equal(contents_of(out), complete, "after the holder was killed");

  Process study = start({.arguments = {"study", plan, "--out", at("study")}});
  ASSERT_TRUE(wait_until([&] { return !read(at("study/.lock")).empty(); }));
  study.send(SIGSTOP);
  const Ended ended =
      Process(VOUSSOIR_PROGRAM, {.arguments = {"slice", scene, "--out", at("study")}}, at("other")).wait();
  expect_one_line(ended, 3, fmt::format("process {} ", study.pid()), "while a study runs ");
}

// ---- a study, whose runs are processes of their own ---------------------------------------------------------------

// study.csv without the seconds, which come last in a row
std::string settings_of(const std::string& out) {
  std::istringstream stream(read(out + "/study.csv"));
  std::string text;
  for (std::string row; std::getline(stream, row);)
    text += row.substr(0, row.rfind(',')) + "\n";
  return text;
}

bool is_locked(const fs::path& lock) {
  const int file = ::open(lock.c_str(), O_RDONLY | O_CLOEXEC);
  if (file < 0) return false;
  const bool locked = ::flock(file, LOCK_SH | LOCK_NB) != 0;
  ::close(file);
  return locked;
}

TEST_F(Faults, AStoppedStudyStopsItsRunsAndContinues) {
  write("scene.toml", cubes_scene(2, 2, 3, 0.1, 3));
  const std::string plan = write("study.toml", R"(scene = "scene.toml"
quantity = "top_displacement_z"
sweep = [{ name = "stiffness", key = "joint_properties.rock.normal_stiffness", values = [1e9, 9e8] }]
)");
  ASSERT_EQ(run({.arguments = {"study", plan, "--out", at("whole")}}).code, 0);
  const auto runs_going_on = [](const std::string& out) {
    int count = 0;
    if (fs::exists(out + "/runs"))
      for (const auto& entry : fs::directory_iterator(out + "/runs"))
        count += is_locked(entry.path() / ".lock");
    return count;
  };

  for (const int signal : {SIGINT, SIGKILL}) {
    const std::string out = at(fmt::format("stopped_{}", signal));
    const Launch launch{.arguments = {"study", plan, "--out", out, "--jobs", "2"}};
    Process process = start(launch);
    ASSERT_TRUE(wait_until([&] { return runs_going_on(out) > 0; }));
    process.send(signal);
    const Ended ended = process.wait();
    // if interrupted, the study stops its runs before it ends; if killed, its runs end by themselves
    if (signal == SIGINT) {
      expect_one_line(ended, 128 + SIGINT, "the same command continues");
      EXPECT_EQ(runs_going_on(out), 0);
    }
    EXPECT_TRUE(wait_until([&] { return runs_going_on(out) == 0; }));
    const Ended again = run(launch);
    EXPECT_EQ(again.code, 0) << again.err << again.out;
    EXPECT_EQ(settings_of(out), settings_of(at("whole")));
  }
}

// ---- folders that refuse, or are no folders -----------------------------------------------------------------------

TEST_F(Faults, AFolderThatRefusesUsIsSevenBeforeAnythingIsComputed) {
  const std::string scene = write("scene.toml", small), out = at("closed");
  const std::string stopped = interrupted("stopped");
  const Contents before = contents_of(stopped);
  fs::create_directories(out);
  fs::permissions(out, fs::perms(0555));
  fs::permissions(stopped, fs::perms(0555));
  fs::permissions(stopped + "/.lock", fs::perms(0444));
  Launch launch{.arguments = run_arguments(scene, out, small_steps), .ordinary_user = true};
  const Ended ended = run(launch);
  if (ended.code == cannot_start) GTEST_SKIP() << "root that cannot become an ordinary user";
  expect_one_line(ended, 7, "cannot write '" + out + "'");
  EXPECT_TRUE(fs::is_empty(out));
  launch.arguments = resume_arguments(stopped);
  expect_one_line(run(launch), 7, "cannot write '" + stopped);
  launch.arguments = run_arguments(scene, out + "/deeper", small_steps);
  expect_one_line(run(launch), 7, "cannot write '" + out + "/deeper'");
  expect_equal(contents_of(stopped), before, "a folder that refuses");
  fs::permissions(out, fs::perms(0755));
  fs::permissions(stopped, fs::perms(0755));
}

TEST_F(Faults, AFileIsNoFolder) {
  const std::string scene = write("scene.toml", small), file = write("file", "");
  for (const std::string& out : {file, file + "/out", std::string("/dev/null/out")})
    expect_one_line(run({.arguments = run_arguments(scene, out, small_steps)}), 5, "cannot write '" + out + "'");
  expect_one_line(run({.arguments = resume_arguments(file)}), 2, "is not a folder");
}

// ---- resume -------------------------------------------------------------------------------------------------------

TEST_F(Faults, ResumeNamesWhatIsMissing) {
  expect_one_line(run({.arguments = resume_arguments(at("nowhere"))}), 2, "is not a folder");
  fs::create_directories(at("empty"));
  expect_one_line(run({.arguments = resume_arguments(at("empty"))}), 2, "contains no run: 'voussoir run' makes one");
  EXPECT_TRUE(fs::is_empty(at("empty")));
}

TEST_F(Faults, DamagedNotesOfARunAreRefused) {
  const std::string out = interrupted("stopped");
  const std::string whole = read(out + "/run.json");
  const std::pair<std::string, std::string> edits[] = {{"{", ""},
                                                       {"\"voussoir.run\"", "\"voussoir.ran\""},
                                                       {"\"threads\": 1", "\"threads\": 0"},
                                                       {"\"threads\": 1", "\"threads\": \"one\""},
                                                       {"\"threads\"", "\"thread\""},
                                                       {": 7", ": -7"}};
  for (const auto& [from, to] : edits) {
    std::string text = whole;
    ASSERT_NE(text.find(from), std::string::npos) << from;
    write("stopped/run.json", text.replace(text.find(from), from.size(), to));
    expect_one_line(run({.arguments = resume_arguments(out)}), 2, "run.json'", to);
    EXPECT_TRUE(fs::exists(out + "/checkpoint"));
  }
  write("stopped/run.json", "");
  expect_one_line(run({.arguments = resume_arguments(out)}), 2, "--overwrite");
}

TEST_F(Faults, AnotherSceneIsRefused) {
  const std::string out = interrupted("stopped");
  std::string text = read(out + "/scene.toml");
  text.replace(text.find("2500"), 4, "2600");
  write("stopped/scene.toml", text);
  const Contents before = contents_of(out);
  expect_one_line(run({.arguments = resume_arguments(out)}), 2, "is not the scene that was run there");
  expect_equal(contents_of(out), before, "another scene");
  fs::remove(out + "/checkpoint");
  fs::remove(out + "/checkpoint.previous");
  expect_one_line(run({.arguments = resume_arguments(out)}), 2, "is not the scene that was run there");
}

TEST_F(Faults, ADamagedCheckpointGivesWayToTheOneBefore) {
  const Contents& complete = undisturbed_large();
  const std::string out = interrupted("stopped");
  std::string bytes = read(out + "/checkpoint");
  bytes[bytes.size() / 2] ^= 1;
  write("stopped/checkpoint", bytes);
  const std::string good = read(out + "/checkpoint.previous");

  // both damaged: refused, and nothing is touched
  write("stopped/checkpoint.previous", bytes.substr(0, 1000));
  const Contents damaged = contents_of(out);
  expect_one_line(run({.arguments = resume_arguments(out)}), 2, "start again with 'voussoir run --overwrite'");
  expect_equal(contents_of(out), damaged, "both damaged");

  write("stopped/checkpoint.previous", good);
  expect_one_line(run({.arguments = resume_arguments(out)}), 0, "is damaged or cut short; the one before it is used");
  expect_equal(contents_of(out), complete, "the newest damaged");
}

TEST_F(Faults, ARunWithoutACheckpointStartsOver) {
  const Contents& complete = undisturbed_large();
  const std::string out = interrupted("stopped");
  fs::remove(out + "/checkpoint");
  fs::remove(out + "/checkpoint.previous");
  EXPECT_EQ(run({.arguments = resume_arguments(out)}).code, 0);
  expect_equal(contents_of(out), complete, "no checkpoint");
}

// frames are no part of the results
TEST_F(Faults, MissingFramesStopNoRun) {
  Contents wanted = undisturbed_large();
  const std::string out = interrupted("stopped");
  ASSERT_TRUE(fs::remove(out + "/frames/blocks_0000.vtp"));
  expect_one_line(run({.arguments = resume_arguments(out)}), 0, "frames/blocks_0000.vtp the first");
  Contents found = contents_of(out);
  EXPECT_EQ(found.at("blocks.pvd").find("blocks_0000"), std::string::npos);
  EXPECT_NE(found.at("contacts.pvd").find("contacts_0000"), std::string::npos);
  wanted.erase("frames/blocks_0000.vtp");
  found["blocks.pvd"] = wanted["blocks.pvd"];
  expect_equal(found, wanted, "a frame is gone");

  fs::remove_all(out);
  interrupted("stopped");
  fs::remove_all(out + "/frames");
  expect_one_line(run({.arguments = resume_arguments(out)}), 0, "the first");
  EXPECT_EQ(contents_of(out).at("results.json"), wanted.at("results.json"));
  EXPECT_TRUE(fs::exists(out + "/frames/blocks_0009.vtp")) << "the later ones are there";
}

TEST_F(Faults, AnInterruptedRunIsNotOverwrittenUnasked) {
  const std::string scene = write("scene.toml", small);
  const Contents complete = undisturbed(scene, small_steps);
  const std::string out = interrupted("stopped");
  const Contents before = contents_of(out);
  Launch launch{.arguments = run_arguments(scene, out, small_steps)};
  expect_one_line(run(launch), 2, "'voussoir resume " + out + "'");
  expect_equal(contents_of(out), before, "refused");
  launch.arguments.push_back("--overwrite");
  EXPECT_EQ(run(launch).code, 0);
  expect_equal(contents_of(out), complete, "begun again");
}

TEST_F(Faults, ACompleteRunIsLeftAsItIs) {
  const std::string scene = write("scene.toml", small), out = at("undisturbed");
  const Contents complete = undisturbed(scene, small_steps);
  const std::string results = read(out + "/results.json"), lock = read(out + "/.lock");
  const Ended ended = run({.arguments = {"resume", out}});
  EXPECT_EQ(ended.code, 0) << ended.err;
  EXPECT_NE(ended.out.find("is complete"), std::string::npos);
  EXPECT_EQ(read(out + "/results.json"), results);
  EXPECT_EQ(read(out + "/.lock"), lock);

  // killed after its results, before it had tidied up
  write("undisturbed/checkpoint", "old");
  write("undisturbed/history.csv.voussoir-part123", "half");
  write("undisturbed/frames/blocks_0001.vtp.voussoir-part123", "half");
  write("undisturbed/thesis.part1", "mine");
  EXPECT_EQ(run({.arguments = {"resume", out}}).code, 0);
  EXPECT_EQ(read(out + "/thesis.part1"), "mine");
  fs::remove(out + "/thesis.part1");
  expect_equal(contents_of(out), complete, "tidied up");
}

}  // namespace
}  // namespace voussoir::fault_test
