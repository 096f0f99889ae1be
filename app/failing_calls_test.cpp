// Disks that fail or are full and failing allocations, call by call: the right exit code and one line, no file
// half-written, and a later run that ends in the same bits.
#include <sys/mount.h>

#include "app/testing/faults.hpp"

namespace voussoir::failing_calls_test {
namespace {

namespace fs = std::filesystem;

#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
constexpr bool sanitized = true;
#elif defined(__has_feature)
constexpr bool sanitized = __has_feature(address_sanitizer) || __has_feature(thread_sanitizer);
#else
constexpr bool sanitized = false;
#endif

// a dozen blocks, a few checkpoints, three frames
const std::string scene_text = cubes_scene(2, 2, 3, 0.004, 2);
constexpr int steps = 25;  // between checkpoints

class FailingCalls : public FaultTest {
 protected:
  void SetUp() override {
    if (sanitized) GTEST_SKIP() << "a sanitizer's own library must come first: no LD_PRELOAD";
    scene_ = write("scene.toml", scene_text);
    static const Contents complete = undisturbed(scene_, steps);  // once for all tests
    complete_ = complete;
  }

  // calls `first` to `last` fail, or every second of them
  Ended run_failing(std::vector<std::string> arguments, const std::string& call, const std::string& error, long first,
                    long last, int every = 1) const {
    fs::remove(at("failed"));
    return run({.arguments = std::move(arguments),
                .environment = {{"LD_PRELOAD", VOUSSOIR_FAILING_CALLS},
                                {"FAIL_CALL", call},
                                {"FAIL_FOLDER", at("out")},
                                {"FAIL_REPORT", at("failed")},
                                {"FAIL_AT", std::to_string(first)},
                                {"FAIL_LAST", std::to_string(last)},
                                {"FAIL_EVERY", std::to_string(every)},
                                {"FAIL_ERRNO", error}}});
  }
  bool failed() const { return fs::exists(at("failed")); }

  void expect_to_finish(const std::string& what) const {
    const Ended ended = finish(scene_, at("out"), steps);
    EXPECT_EQ(ended.code, 0) << what << ended.err;
    EXPECT_EQ(ended.err, "") << what;
    expect_equal(contents_of(at("out")), complete_, what);
  }

  // The first call fails, then the one `apart` after it, … until none is left to fail; returns the last one that
  // failed: there were as many at least.
  int sweep(const std::string& call, int error, int code, int apart) const {
    for (int k = 1;; k += apart) {
      const std::string what = fmt::format("{} {} fails with errno {}: ", call, k, error);
      fs::remove_all(at("out"));
      const Ended ended = run_failing(run_arguments(scene_, at("out"), steps), call, std::to_string(error), k, k);
      if (!failed()) {
        EXPECT_EQ(ended.code, 0) << ended.err;
        expect_equal(contents_of(at("out")), complete_, what);
        return k - apart;
      }
      expect_one_line(ended, code, "cannot write '" + at("out"), what);
      // a temporary file that cannot be removed is all that may be left
      if (call != "unlink" && fs::exists(at("out"))) expect_whole_files(at("out"), complete_, what);
      expect_to_finish(what);
      if (HasFailure()) return k;
    }
  }

  void keep_the_only_good_checkpoint(int apart) const;

  // `growth` of the distances between the calls that fail; `fewest` failures
  void refuse_memory(double growth, int fewest) const;

  std::string scene_;
  Contents complete_;
};

// every ninth of them in each build, every one in the Long test
constexpr int ninth = 9;
TEST_F(FailingCalls, WritesThatFail) {
  EXPECT_GT(sweep("write", EIO, 5, ninth), 15);
}
TEST_F(FailingCalls, WritesToAFullDisk) {
  EXPECT_GT(sweep("write", ENOSPC, 6, ninth), 15);
}
TEST_F(FailingCalls, FlushesThatFail) {
  EXPECT_GT(sweep("fsync", EIO, 5, ninth), 30);
}
TEST_F(FailingCalls, RenamesThatFail) {
  EXPECT_GT(sweep("rename", EIO, 5, ninth), 15);
}
TEST_F(FailingCalls, OpensThatFail) {
  EXPECT_GT(sweep("open", EACCES, 7, ninth), 30);
}
TEST_F(FailingCalls, EveryRemovalThatFails) {
  EXPECT_GT(sweep("unlink", EIO, 5, 1), 3);
}

using FailingCallsLong = FailingCalls;

TEST_F(FailingCallsLong, EveryCall) {
  EXPECT_GT(sweep("write", EIO, 5, 1), 15);
  EXPECT_GT(sweep("write", ENOSPC, 6, 1), 15);
  EXPECT_GT(sweep("fsync", EIO, 5, 1), 30);
  EXPECT_GT(sweep("rename", EIO, 5, 1), 15);
  EXPECT_GT(sweep("open", EACCES, 7, 1), 30);
}

TEST_F(FailingCalls, ShortWritesAndInterruptedCallsAreTriedAgain) {
  constexpr long all = 1'000'000;
  const std::string interrupted = std::to_string(EINTR);
  const std::tuple<const char*, std::string, int> trials[] = {
      {"write", "short", 1}, {"write", interrupted, 2}, {"fsync", interrupted, 2}};
  for (const auto& [call, error, every] : trials) {
    fs::remove_all(at("out"));
    const Ended ended = run_failing(run_arguments(scene_, at("out"), steps), call, error, 1, all, every);
    EXPECT_EQ(ended.code, 0) << call << " " << error << ": " << ended.err;
    EXPECT_TRUE(failed());
    expect_equal(contents_of(at("out")), complete_, call + (" " + error));
  }
}

// if the newest checkpoint is damaged, the one before it must survive any failure; renames that fail are `apart`
void FailingCalls::keep_the_only_good_checkpoint(int apart) const {
  // as a kill between two checkpoints leaves it
  run_failing(run_arguments(scene_, at("out"), steps), "rename", std::to_string(EIO), 19, 19);
  ASSERT_TRUE(failed());
  ASSERT_TRUE(fs::exists(at("out/checkpoint")) && fs::exists(at("out/checkpoint.previous")));
  std::string damaged = read(at("out/checkpoint"));
  damaged[damaged.size() / 2] ^= 1;
  write("out/checkpoint", damaged);
  fs::copy(at("out"), at("kept"), fs::copy_options::recursive);
  for (int k = 1;; k += apart) {
    fs::remove_all(at("out"));
    fs::copy(at("kept"), at("out"), fs::copy_options::recursive);
    const Ended ended = run_failing(resume_arguments(at("out")), "rename", std::to_string(EIO), k, k);
    if (!failed()) break;
    EXPECT_EQ(ended.code, 5) << ended.err;
    const Ended resumed = run({.arguments = resume_arguments(at("out"))});
    EXPECT_EQ(resumed.code, 0) << "rename " << k << ": " << resumed.err;
    expect_equal(contents_of(at("out")), complete_, fmt::format("rename {}", k));
    if (HasFailure()) break;
  }
}

TEST_F(FailingCalls, TheOnlyGoodCheckpointSurvivesFailures) {
  keep_the_only_good_checkpoint(3);
}

TEST_F(FailingCallsLong, TheOnlyGoodCheckpointSurvivesEveryFailure) {
  keep_the_only_good_checkpoint(1);
}

// ---- memory -------------------------------------------------------------------------------------------------------

// A failure at every call would take minutes: all of the first calls, then at distances that grow by a factor. An
// allocation with an alternative (sorting in place) leaves the results unchanged. If an allocation fails while the TOML
// reader parses a number, its stream reports that this is no number: bad input, exit code 2. A second thread whose
// allocation fails leaves its work to the first.
void FailingCalls::refuse_memory(double growth, int fewest) const {
  const char* const message = "not enough memory";
  for (const char* threads : {"1", "2"}) {
    for (const bool for_good : {false, true}) {
      int refused = 0;
      for (long k = 1;; k = std::max(k + 1, static_cast<long>(growth * k))) {
        const std::string what = fmt::format("malloc {}{}, {} threads: ", k, for_good ? " and all later" : "", threads);
        fs::remove_all(at("out"));
        std::vector<std::string> arguments = run_arguments(scene_, at("out"), steps);
        arguments.insert(arguments.end(), {"--threads", threads});
        const Ended ended = run_failing(arguments, "malloc", std::to_string(ENOMEM), k, for_good ? 1'000'000'000 : k);
        if (!failed()) break;
        EXPECT_EQ(ended.signal, 0) << what << ended.err;
        if (ended.code != 0) {
          const bool misread = ended.code == 2 && ended.err.find("could not be interpreted") != std::string::npos;
          if (!misread) expect_one_line(ended, 8, message, what);
          ++refused;
          if (fs::exists(at("out")) && threads[0] == '1') expect_whole_files(at("out"), complete_, what);
        }
        finish(scene_, at("out"), steps);
        Contents found = contents_of(at("out"));
        found["run.json"] = complete_.at("run.json");
        expect_equal(found, complete_, what);
        if (HasFailure()) return;
      }
      EXPECT_GT(refused, fewest) << threads << " threads";
    }
  }
}

TEST_F(FailingCalls, MemoryThatIsRefusedIsEight) {
  refuse_memory(4, 6);
}

TEST_F(FailingCallsLong, MemoryThatIsRefusedIsEight) {
  refuse_memory(1.2, 30);
}

// ---- full disks ---------------------------------------------------------------------------------------------------

class FullDisk : public FaultTest {
 protected:
  const std::string scene_ = write("scene.toml", cubes_scene(3, 3, 3, 0.008, 10));
};

TEST_F(FullDisk, AFullFileSystemIsSix) {
  const Contents complete = undisturbed(scene_, 10);
  fs::create_directories(at("disk"));
  if (::mount("tmpfs", at("disk").c_str(), "tmpfs", 0, "size=300k") != 0)
    GTEST_SKIP() << "only root can mount a small file system here";
  const std::string out = at("disk/out");
  expect_one_line(run({.arguments = run_arguments(scene_, out, 10)}), 6, "cannot write '" + out);
  EXPECT_TRUE(fs::exists(out + "/checkpoint"));
  expect_whole_files(out, complete, "full disk: ");

  // still full, then with room
  expect_one_line(run({.arguments = resume_arguments(out)}), 6, "cannot write '" + out);
  expect_whole_files(out, complete, "full disk again: ");
  EXPECT_EQ(::mount("tmpfs", at("disk").c_str(), "tmpfs", MS_REMOUNT, "size=20m"), 0);
  const Ended ended = run({.arguments = resume_arguments(out)});
  EXPECT_EQ(ended.code, 0) << ended.err;
  expect_equal(contents_of(out), complete, "after room was made");
  ::umount(at("disk").c_str());
}

TEST_F(FullDisk, ALimitOnTheSizeOfFilesIsSix) {
  const Contents complete = undisturbed(scene_, 10);
  const std::string out = at("out");
  // no file can be written, hence no message either
  EXPECT_EQ(run({.arguments = run_arguments(scene_, out, 10), .largest_file = 0}).code, 6);
  expect_whole_files(out, complete, "limit 0: ");
  // the notes of a run, but no frame or checkpoint; then those, but not the later ones, which hold more contacts
  for (const rlim_t limit : {4'000, 12'000}) {
    Launch launch{.arguments = run_arguments(scene_, out, 10), .largest_file = limit};
    if (fs::exists(out + "/run.json")) launch.arguments = resume_arguments(out);
    expect_one_line(run(launch), 6, "cannot write '" + out, fmt::format("limit {}: ", limit));
    expect_whole_files(out, complete, fmt::format("limit {}: ", limit));
  }
  EXPECT_EQ(finish(scene_, out, 10).code, 0);
  expect_equal(contents_of(out), complete, "without the limit");
}

TEST_F(FullDisk, AFullStandardOutputIsSixAndTheResultsAreThere) {
  const std::string scene = write("gentle.toml", cubes_scene(1, 1, 3, 0.04, 10));  // nothing to warn of
  const Contents complete = undisturbed(scene, 10);
  std::vector<std::string> arguments = run_arguments(scene, at("out"), 10);
  std::erase(arguments, "--quiet");
  expect_one_line(run({.arguments = arguments, .out = "/dev/full"}), 6, "standard output");
  expect_equal(contents_of(at("out")), complete, "stdout on a full device");
  for (const char* other : {"docs", "--help", "--version"})
    expect_one_line(run({.arguments = {other}, .out = "/dev/full"}), 6, "standard output", other);
}

}  // namespace
}  // namespace voussoir::failing_calls_test
