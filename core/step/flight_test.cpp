// By how much a pair whose joint has risen is drawn together.
#include "core/step/flight.hpp"

#include <gtest/gtest.h>

#include <vector>

#include "core/step.hpp"
#include "core/testing/models.hpp"
#include "text/angle.hpp"

namespace voussoir::flight_test {
namespace {

// A pair that does not move, or is looked at without a step as when bonds are made, is drawn by the rise all the same.
TEST(Flight, APairIsDrawnByItsRiseWithoutAStep) {
  Model<3> model = shapes::model_of<3>(shapes::jointed_box());
  model.properties.front().laws.dilation = DilationLaw::constant;
  model.properties.front().dilation = 8 * degree;
  model.properties.front().dilation_until = 0.1;
  State<3> state = initial_state(model);
  step(model, Settings{}, state);
  ASSERT_FALSE(state.contacts.list.empty());
  const Contact<3>& contact = state.contacts.list.front();
  const auto drawn = [&](const std::vector<JointRise<3>>& rises, double seconds) {
    return drawn_by<3>(model, state.bodies, contact, rises, climb_over(model, seconds));
  };
  std::vector<JointRise<3>> rises(2);
  EXPECT_EQ(drawn(rises, 0), 0) << "it has never touched";
  rises[1].normal = {0, 0, 1};
  rises[1].rise = 0.01;
  EXPECT_EQ(drawn(rises, 0), 0.01);
  EXPECT_GE(drawn(rises, 1e-3), 0.01);
  EXPECT_DOUBLE_EQ(closure_of<3>(0.012, drawn(rises, 0), rises[1]), 0.012);
}

}  // namespace
}  // namespace voussoir::flight_test
