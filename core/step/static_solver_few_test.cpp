// Few bodies that move while the others stand still: which they are, and that a rock mass that uses them rests where it
// would without, with the same bits for any threads and any interruption.
#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <utility>

#include "core/model/state_hash.hpp"
#include "core/step.hpp"
#include "core/step/bodies_of_step.hpp"
#include "core/testing/stacks.hpp"
#include "core/testing/whole_runs.hpp"

namespace voussoir::static_solver_few_test {
namespace {

TEST(BodiesOfStep, AreTheFewWithMostOfTheResidual) {
  const Model<2> model = shapes::column_of_squares(200);
  const Unknowns<2> unknowns(model);
  Eigen::VectorXd residual = Eigen::VectorXd::Ones(unknowns.free.size());
  EXPECT_TRUE(few_of_residual(unknowns, residual).empty()) << "all are alike";
  residual[3 * 120] = residual[3 * 7 + 1] = 30;
  EXPECT_EQ(few_of_residual(unknowns, residual), (std::vector<int>{7, 120}));
  residual[3 * 44] = 13;  // not needed for half of the square, but far above the rest
  EXPECT_EQ(few_of_residual(unknowns, residual), (std::vector<int>{7, 44, 120}));
  for (int body = 0; body < 20; ++body)
    residual[3 * body] = 30;
  EXPECT_TRUE(few_of_residual(unknowns, residual).empty()) << "one tenth of all is not few";

  const Model<2> low = shapes::column_of_squares(99);
  const Unknowns<2> of_low(low);
  Eigen::VectorXd loud = Eigen::VectorXd::Zero(of_low.free.size());
  loud[5] = 1;
  EXPECT_TRUE(few_of_residual(of_low, loud).empty()) << "in a small model all move";
}

TEST(BodiesOfStep, KeepTheOrderOfTheUnknowns) {
  const Model<2> model = shapes::column_of_squares(200);
  const Unknowns<2> unknowns(model);
  const BodiesOfStep<2> few(unknowns, {7, 44, 120}), all(unknowns, {});
  EXPECT_EQ(few.upwards, (std::vector<int>{0, 1, 2})) << "the lowest first";
  EXPECT_EQ(few.place[unknowns.bodies[44]], 1);
  EXPECT_EQ(few.place[unknowns.bodies[45]], -1);
  EXPECT_EQ(all.place, unknowns.place);
  EXPECT_EQ(all.upwards, unknowns.upwards);
  const Eigen::VectorXd x = Eigen::VectorXd::LinSpaced(unknowns.free.size(), 1, 2);
  EXPECT_EQ(all.among_all(all.of(x), unknowns.count()), x);
  const Eigen::VectorXd some = few.among_all(few.of(x), unknowns.count());
  EXPECT_EQ(some.segment<3>(3 * 44), x.segment<3>(3 * 44));
  EXPECT_EQ(few.of(some), few.of(x));
  EXPECT_EQ((some.array() != 0).count(), 9);
}

// a box of sliced rock between walls, some 150 blocks, on points or on whole faces
Prepared<3> rock_mass(const std::string& face) {
  return prepare<3>(read_scene(
      VOUSSOIR_SOURCE_DIR "/cases/slicing/rock_mass.toml",
      {"statics=newton", "domain.box.max=[5, 4, 2]", "equilibrium.unbalanced=1e-6", "contact.face=" + face}));
}

TEST(BodiesOfStep, ChangeNoBitByThreadsOrInterruptions) {
  for (const auto& [face, every] : {std::pair("point", 3LL), std::pair("integrated", 9LL)}) {
    Prepared<3> scene = rock_mass(face);
    const Progress<3> whole = whole_run(scene);
    ASSERT_GT(whole.state.counters.static_iterations_of_few, 3);
    EXPECT_EQ(whole.state.counters.static_fallbacks, 0);
    for (long long k = 2; k < whole.state.counters.steps; k += every)
      EXPECT_EQ(continued(scene, k).results.state_hash, whole.results.state_hash) << face << ", after step " << k;
    scene.settings.threads = 2;
    EXPECT_EQ(whole_run(scene).results.state_hash, whole.results.state_hash) << face;
  }
}

// Contacts of bodies that stand are not found again: their forces are those that they would have.
TEST(KeptContacts, HaveTheLoadsOfAllFoundAgain) {
  for (const char* face : {"point", "integrated"}) {
    const Prepared<3> scene = rock_mass(face);
    Progress<3> progress = initial_progress(scene);
    Watcher<3> watcher;
    watcher.pause = [](const Progress<3>& now) { return !now.state.contacts.kept.empty(); };
    ASSERT_FALSE(simulate(scene, progress, watcher)) << "no step of few bodies";
    const Settings settings = settings_of(scene.stages[0], scene.settings);
    State<3> kept = progress.state, all = progress.state;
    all.contacts.kept.clear();
    set_histories(all.increment.base.histories, all.contacts);
    const long long before = all.counters.contact_evaluations;
    find_forces(scene.model, settings, kept);
    find_forces(scene.model, settings, all);
    EXPECT_TRUE(kept.contacts.kept.empty()) << "for one step only";
    EXPECT_LT(10 * (kept.counters.contact_evaluations - before), all.counters.contact_evaluations - before);
    double largest = 0, apart = 0;
    for (std::size_t i = 0; i < all.contacts.list.size(); ++i) {
      EXPECT_EQ(all.contacts.list[i].touching(), kept.contacts.list[i].touching());
      largest = std::max(largest, all.contacts.list[i].force.norm());
      apart = std::max(apart, (all.contacts.list[i].force - kept.contacts.list[i].force).norm());
    }
    EXPECT_LT(apart, 1e-6 * largest) << face;
    for (std::size_t b = 0; b < all.loads.total.size(); ++b)
      EXPECT_LT((all.loads.total[b].force - kept.loads.total[b].force).norm(), 1e-6 * largest) << face;
  }
}

}  // namespace
}  // namespace voussoir::static_solver_few_test
