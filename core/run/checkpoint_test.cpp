// Checkpoints: a run that is stopped anywhere and continues from its bytes ends in the same bits; incomplete bytes are
// refused.
#include "core/run/checkpoint.hpp"

#include <gtest/gtest.h>

#include "core/testing/end_bytes.hpp"
#include "core/testing/models.hpp"
#include "core/testing/whole_runs.hpp"

namespace voussoir::checkpoint_test {
namespace {

using shapes::block_on_plate;
using shapes::jointed_box;
using shapes::model_of;

const std::string scene_hash = "fnv1a64:0123456789abcdef";

template <int Dim>
Prepared<Dim> scene_of(const Model<Dim>& model, const std::vector<StagePlan>& stages) {
  Prepared<Dim> scene;
  scene.model = model;
  scene.state = initial_state(model);
  scene.stages = stages;
  scene.output.frame_interval = 1e-4;
  scene.monitors = {{"block", {"displacement", Quantity::displacement}, static_cast<int>(model.bodies.size()) - 1}};
  return scene;
}

StagePlan stage(const std::string& name, std::variant<SettlePlan, RunPlan, ReducePlan> plan) {
  StagePlan s;
  s.name = name;
  s.plan = std::move(plan);
  return s;
}

// the complete final state, except the clock
template <int Dim>
Progress<Dim> through_bytes(const Progress<Dim>& progress) {
  return read_checkpoint<Dim>(checkpoint_bytes(progress, scene_hash), scene_hash);
}

// continues until `count` steps were done in total; true: the scene ended before
template <int Dim>
bool run_until(const Prepared<Dim>& scene, long long count, Progress<Dim>& progress) {
  Watcher<Dim> watcher;
  watcher.pause = [count](const Progress<Dim>& p) { return p.state.counters.steps >= count; };
  return simulate(scene, progress, watcher);
}

TEST(Checkpoint, MayBeTakenAfterEveryStep) {
  // two stages, so that one of the interruptions falls between them
  StagePlan slide = stage("slide", RunPlan{.duration = 2e-3});
  slide.change.friction = 5 * degree;
  Prepared<3> scene = scene_of<3>(model_of<3>(jointed_box({0.05})),
                                  {stage("load", RunPlan{.duration = 2.2e-3, .gravity = {.ramp = 1e-3}}), slide});
  scene.settings.time.step = 2e-5;
  const Progress<3> whole = simulated(scene);
  const long long steps = whole.state.counters.steps;
  ASSERT_GE(steps, 200);
  const std::string expected = end_of(whole);
  for (long long k = 0; k <= 200; ++k) {
    Progress<3> first = initial_progress(scene);
    ASSERT_FALSE(run_until(scene, k, first));
    Progress<3> second = through_bytes(first);
    ASSERT_TRUE(simulate(scene, second, {}));
    ASSERT_TRUE(end_of(second) == expected) << "interrupted after step " << k;
  }
}

template <int Dim>
void expect_search_survives(const ReducePlan& plan) {
  const Model<Dim> model = block_on_plate<Dim>(30 * degree, 40 * degree);
  const Prepared<Dim> scene = scene_of<Dim>(model, {stage("settle", SettlePlan{}), stage("reduce", plan)});
  const Progress<Dim> whole = simulated(scene);
  EXPECT_TRUE(whole.results.find(plan.searched == Searched::factor ? "factor_of_safety" : "critical_friction"));

  // repeatedly, at arbitrary intervals
  Progress<Dim> progress = initial_progress(scene);
  int interruptions = 0;
  for (long long k = 97; !run_until(scene, k, progress); k += 97) {
    progress = through_bytes(progress);
    ++interruptions;
  }
  EXPECT_GT(interruptions, 20);
  EXPECT_TRUE(end_of(progress) == end_of(whole));
}

TEST(Checkpoint, ASearchForTheCriticalFrictionContinues) {
  ReducePlan plan;
  plan.from = 35 * degree;
  plan.to = 27 * degree;
  plan.tolerance = 0.5 * degree;
  plan.step = 1 * degree;
  plan.rate = 4 * degree;
  plan.slower_rate = 1 * degree;
  plan.failure_displacement = 0.003;
  for (const ReductionMethod method :
       {ReductionMethod::bisection, ReductionMethod::steps, ReductionMethod::rate, ReductionMethod::two_rates}) {
    plan.method = method;
    expect_search_survives<2>(plan);
  }
  plan.method = ReductionMethod::bisection;
  plan.failure_displacement = 0;
  plan.criterion = FailureCriterion::required_strength;
  expect_search_survives<2>(plan);
  plan.searched = Searched::factor;
  plan.factor = {.from = 0.8, .to = 2, .tolerance = 0.02, .step = 0.1};
  plan.failure_fraction = 0.5;
  for (const ReductionMethod method : {ReductionMethod::bisection, ReductionMethod::steps}) {
    plan.method = method;
    expect_search_survives<2>(plan);
  }
}

Progress<2> small_progress(const Prepared<2>& scene) {
  Progress<2> progress = initial_progress(scene);
  EXPECT_FALSE(run_until(scene, 50, progress));
  return progress;
}

Prepared<2> small_scene() {
  return scene_of<2>(block_on_plate<2>(30 * degree, 20 * degree), {stage("slide", RunPlan{.duration = 1})});
}

TEST(Checkpoint, EveryFlippedByteAndEveryTruncationIsRefused) {
  const std::string bytes = checkpoint_bytes(small_progress(small_scene()), scene_hash);
  ASSERT_NO_THROW(read_checkpoint<2>(bytes, scene_hash));
  EXPECT_LT(bytes.size(), 20'000u);
  for (std::size_t i = 0; i < bytes.size(); ++i) {
    for (const int flip : {0x01, 0x80, 0xff}) {
      std::string damaged = bytes;
      damaged[i] = static_cast<char>(damaged[i] ^ flip);
      EXPECT_THROW(read_checkpoint<2>(damaged, scene_hash), CheckpointError) << "byte " << i;
    }
    EXPECT_THROW(read_checkpoint<2>(bytes.substr(0, i), scene_hash), CheckpointError) << i << " bytes";
  }
  EXPECT_THROW(read_checkpoint<2>(bytes + "x", scene_hash), CheckpointError);
}

std::string refusal(const std::string& bytes, const std::string& hash) {
  try {
    read_checkpoint<2>(bytes, hash);
  } catch (const CheckpointError& error) {
    return error.what();
  }
  return "taken";
}

TEST(Checkpoint, ReportsItsError) {
  const std::string bytes = checkpoint_bytes(small_progress(small_scene()), scene_hash);
  EXPECT_EQ(refusal(bytes, scene_hash), "taken");
  EXPECT_NE(refusal(bytes, "fnv1a64:0000000000000000").find("another scene"), std::string::npos);
  EXPECT_NE(refusal("", scene_hash).find("not a checkpoint"), std::string::npos);
  EXPECT_NE(refusal("{}", scene_hash).find("not a checkpoint"), std::string::npos);
  EXPECT_NE(refusal(bytes.substr(0, bytes.size() / 2), scene_hash).find("cut short"), std::string::npos);
  EXPECT_THROW(read_checkpoint<3>(bytes, scene_hash), CheckpointError);
  std::string turned = bytes;
  std::reverse(turned.begin() + 20, turned.begin() + 24);
  EXPECT_NE(refusal(turned, scene_hash).find("byte order"), std::string::npos);
}

TEST(Checkpoint, ItsFirstBytesContainItsSize) {
  const std::string bytes = checkpoint_bytes(small_progress(small_scene()), scene_hash);
  ASSERT_GT(bytes.size(), 4096u);
  EXPECT_EQ(checkpoint_size(bytes.substr(0, 4096)), bytes.size());
  EXPECT_THROW(checkpoint_size(std::string(4096, '\0')), CheckpointError);
  EXPECT_THROW(checkpoint_size(""), CheckpointError);
  for (std::size_t i = 0; i < 120; ++i)
    EXPECT_THROW(checkpoint_size(bytes.substr(0, i)), CheckpointError) << i;
  // for a damaged one nothing is allocated, whatever it states
  for (std::size_t i = 0; i < 200; ++i) {
    std::string damaged = bytes.substr(0, 4096);
    damaged[i] = static_cast<char>(damaged[i] ^ 0xff);
    try {
      checkpoint_size(damaged);
    } catch (const CheckpointError&) {
    }
  }
}

TEST(Checkpoint, HasARecordThatIsReadFirst) {
  const CheckpointRecord record = checkpoint_record(checkpoint_bytes(small_progress(small_scene()), scene_hash));
  EXPECT_EQ(record.scene_hash, scene_hash);
  EXPECT_EQ(record.dimension, 2);
  EXPECT_EQ(record.step, 50);
  EXPECT_EQ(record.build, build_name());
}

}  // namespace
}  // namespace voussoir::checkpoint_test
