// Mistakes in the loads of a stage: stress on faces, forces, prescribed motions.
#include "core/testing/bad_scenes.hpp"

namespace voussoir::bad_stage_loads_test {
namespace {

using namespace bad_scenes;

class BadLoad : public testing::TestWithParam<BadInput> {};

TEST_P(BadLoad, IsReportedInOneLine) {
  expect_reported(GetParam());
}

const std::string moving = "[[stage]]\nname = \"push\"\nkind = \"run\"\nduration_s = 1\n[[stage.move]]\n";

const std::string pressing = "[[stage]]\nname = \"press\"\nkind = \"settle\"\n[[stage.boundary]]\n";

INSTANTIATE_TEST_SUITE_P(
    Boundary, BadLoad,
    testing::Values(BadInput{"stress_of_a_plane", "", pressing + "all = true\nstress = [1, 1, 0] #!",
                             "stage.press.boundary.1.stress = [1, 1, 0]", "must have 6 entries because dimension = 3"},
                    BadInput{"in_situ_without_weight", "density = 2600",
                             "[[joint_properties]]\nname = \"other\"\nnormal_stiffness = 1e9\nshear_stiffness = "
                             "1e8\nfriction_deg = 40\n" +
                                 pressing + "all = true\nin_situ = { surface = 2, k0 = 1 } ",
                             "stage.press.boundary.1.in_situ.unit_weight is missing", "no density"},
                    BadInput{"in_situ_without_k0", "", pressing + "all = true\nin_situ = { surface = 2 } ",
                             "stage.press.boundary.1.in_situ.k0 is missing", "horizontal over vertical"},
                    BadInput{"side_of_a_plane", "", pressing + "side = [\"left\"] #!\nstress = [1, 1, 0, 0, 0, 0]",
                             "stage.press.boundary.1.side = [\"left\"]", "side of the model"},
                    BadInput{
                        "empty_box", "",
                        "[[stage]]\nname = \"press\"\nkind = \"settle\"\n[[stage.boundary]] #!\nbox = { min = [50, "
                        "0, 0], max = [51, 1, 1] }\nstress = [1, 1, 0, 0, 0, 0]",
                        "stage.press.boundary.1", "chooses no block"},
                    BadInput{"no_stress", "", pressing + "all = true ", "stage.press.boundary.1.stress is missing",
                             "compression positive"},
                    BadInput{"no_block", "", pressing + "stress = [1, 1, 0, 0, 0, 0] ",
                             "stage.press.boundary.1.below is missing", "no block is chosen"}),
    by_name);

INSTANTIATE_TEST_SUITE_P(
    Moves, BadLoad,
    testing::Values(
        BadInput{"no_velocity", "", moving + "bodies = [\"far\"] ", "stage.push.move.1.velocity is missing",
                 "nothing moves"},
        BadInput{"no_block", "", moving + "velocity = [1, 0, 0] ", "stage.push.move.1.below is missing",
                 "no block is chosen"},
        BadInput{"axis_not_named", "", moving + "bodies = [\"far\"]\ntranslation = [\"z\"]\nvelocity = [1, 0, 0] #!",
                 "stage.push.move.1.velocity = [1, 0, 0]", "component along x"},
        BadInput{"only_axes", "", moving + "bodies = [\"far\"]\nangular_velocity = [1, 0, 0]\ntranslation = [\"z\"] #!",
                 "stage.push.move.1.translation", "without a velocity"},
        BadInput{"times_without_factors", "", moving + "bodies = [\"far\"]\nvelocity = [1, 0, 0]\ntimes_s = [0, 1]",
                 "stage.push.move.1.factors is missing", "the same number of entries"},
        BadInput{"times_fall", "",
                 moving + "bodies = [\"far\"]\nvelocity = [1, 0, 0]\nfactors = [0, 1]\ntimes_s = [1, 1] #!",
                 "stage.push.move.1.times_s = [1, 1]", "must be ascending"},
        BadInput{"times_of_words", "",
                 moving + "bodies = [\"far\"]\nvelocity = [1, 0, 0]\nfactors = [0]\ntimes_s = [\"a\"] #!",
                 "stage.push.move.1.times_s.1 = \"a\"", "must be a number"},
        BadInput{"phase_alone", "", moving + "bodies = [\"far\"]\nvelocity = [1, 0, 0]\nphase_deg = 90 #!",
                 "stage.push.move.1.phase_deg = 90", "without frequency_hz"},
        BadInput{
            "moved_twice", "",
            moving + "bodies = [\"far\"]\nvelocity = [1, 0, 0]\n[[stage.move]] #!\nall = true\nvelocity = [1, 0, 0]",
            "stage.push.move.2", "already moves"},
        BadInput{"at_rest", "kind = \"settle\"",
                 "kind = \"settle\"\n[[stage.move]] #!\nbodies = [\"far\"]\nvelocity = [1, 0, 0]", "stage.settle.move",
                 "applies only if kind"}),
    by_name);

const std::string digging =
    "[[excavations]]\nname = \"pit\"\nbox = { min = [-1, -1, 1], max = [1, 1, 3] }\noutline = true\n[[stage]]\nname = "
    "\"dig\"\nkind = \"settle\"\n";

INSTANTIATE_TEST_SUITE_P(
    Excavations, BadLoad,
    testing::Values(
        BadInput{"unknown", "", digging + "excavate = [\"pti\"] #!", "stage.dig.excavate = [\"pti\"]",
                 "did you mean 'pit'?"},
        BadInput{"none_there", "kind = \"settle\"", "kind = \"settle\"\nexcavate = [\"pit\"] #!",
                 "stage.settle.excavate = [\"pit\"]", "add [[excavations]]"},
        BadInput{"twice", "",
                 digging + "excavate = [\"pit\"]\n[[stage]]\nname = \"again\"\nkind = \"settle\"\nexcavate = "
                           "[\"pit\"] #!",
                 "stage.again.excavate", "again; name"},
        BadInput{"by_a_word", "", digging + "excavate = 3 #!", "stage.dig.excavate = 3", "names"},
        BadInput{"no_excavation_forces", "", digging + "excavation_forces = { remaining = 0, duration_s = 1 } #!",
                 "stage.dig.excavation_forces", "no such forces"},
        BadInput{"no_remaining", "", digging + "excavate = [\"pit\"]\nexcavation_forces = { duration_s = 1 } ",
                 "stage.dig.excavation_forces.remaining is missing", "still acts"},
        BadInput{"remaining_in_percent", "",
                 digging + "excavate = [\"pit\"]\nexcavation_forces = { remaining = 40, duration_s = 1 } #!",
                 "stage.dig.excavation_forces.remaining = 40", "must lie between"},
        BadInput{"no_duration", "", digging + "excavate = [\"pit\"]\nexcavation_forces = { remaining = 0.4 } ",
                 "stage.dig.excavation_forces.duration_s is missing", "kind settle"},
        BadInput{
            "longer_than_the_limit", "",
            digging +
                "time_limit_s = 2\nexcavate = [\"pit\"]\nexcavation_forces = { remaining = 0.4, duration_s = 3 } #!",
            "stage.dig.excavation_forces.duration_s = 3", "time_limit_s (2)"},
        BadInput{"longer_than_the_stage", "",
                 "[[stage]]\nname = \"dig\"\nkind = \"run\"\nduration_s = 1\nexcavation_forces = { remaining = 0, "
                 "duration_s = 3 } #!",
                 "stage.dig.excavation_forces.duration_s = 3", "at most the stage's duration_s (1)"},
        BadInput{"in_a_search", "to_deg = 5", "to_deg = 5\nexcavation_forces = { remaining = 0, duration_s = 3 } #!",
                 "stage.reduce.excavation_forces", "applies only if kind"}),
    by_name);

const std::string forcing = "[[stage]]\nname = \"press\"\nkind = \"settle\"\n[[stage.force]]\nname = \"jack\"\n";
const std::string forcing_in_time =
    "[[stage]]\nname = \"press\"\nkind = \"run\"\nduration_s = 1\n[[stage.force]]\nname = \"jack\"\n";
const std::string on_far = "bodies = [\"far\"]\nforce = [1, 0, 0]\n";

INSTANTIATE_TEST_SUITE_P(
    Forces, BadLoad,
    testing::Values(BadInput{"no_force", "", forcing + "bodies = [\"far\"] ", "stage.press.force.jack.force is missing",
                             "world axes"},
                    BadInput{"no_name", "",
                             "[[stage]]\nname = \"press\"\nkind = \"settle\"\n[[stage.force]]\n" + on_far,
                             "stage.press.force.1.name is missing", "replaces it"},
                    BadInput{"no_block", "", forcing + "force = [1, 0, 0] ", "stage.press.force.jack.below is missing",
                             "no block is chosen"},
                    BadInput{"of_no_block", "",
                             "[[stage]]\nname = \"press\"\nkind = \"settle\"\n[[stage.force]] #!\nname = "
                             "\"jack\"\nforce = [1, 0, 0]\ninside = [50, 0, 0]",
                             "stage.press.force.jack = {", "chooses no block"},
                    BadInput{"unknown_block", "", forcing + "bodies = [\"fra\"] #!\nforce = [1, 0, 0]",
                             "stage.press.force.jack.bodies = [\"fra\"]", "did you mean 'far'?"},
                    BadInput{"two_entries", "", forcing + "bodies = [\"far\"]\nforce = [1, 0] #!",
                             "stage.press.force.jack.force = [1, 0]", "a list of 3 numbers in N"},
                    BadInput{"point_of_two", "", forcing + on_far + "point = [10, 0] #!",
                             "stage.press.force.jack.point = [10, 0]", "a list of 3 numbers in m"},
                    BadInput{"outside", "", forcing + on_far + "point = [10.5, 0.5, 1.25] #!",
                             "stage.press.force.jack.point = [10.5, 0.5, 1.25]", "0.25 m outside of block 'far'"},
                    BadInput{"outside_of_one", "",
                             forcing + "all = true\nforce = [1, 0, 0]\npoint = [10.5, 0.5, 0.5] #!",
                             "stage.press.force.jack.point", "choose the block that contains it"},
                    BadInput{"twice", "", forcing + on_far + "[[stage.force]]\n" + on_far + "name = \"jack\" #!",
                             "stage.press.force.jack.name = \"jack\"", "must be unique in stage.press.force"},
                    BadInput{"times_at_rest", "", forcing + on_far + "factors = [0, 1]\ntimes_s = [0, 1] #!",
                             "stage.press.force.jack.times_s = [0, 1]", "needs a stage of kind run"},
                    BadInput{"sine_at_rest", "", forcing + on_far + "frequency_hz = 2 #!",
                             "stage.press.force.jack.frequency_hz = 2", "needs a stage of kind run"},
                    BadInput{"factors_alone", "", forcing + on_far + "factors = [0, 1] ",
                             "stage.press.force.jack.times_s is missing", "the same number of entries"},
                    BadInput{"times_fall", "", forcing_in_time + on_far + "factors = [0, 1]\ntimes_s = [1, 1] #!",
                             "stage.press.force.jack.times_s = [1, 1]", "must be ascending"},
                    BadInput{"phase_alone", "", forcing_in_time + on_far + "phase_deg = 90 #!",
                             "stage.press.force.jack.phase_deg = 90", "without frequency_hz"},
                    BadInput{"unknown_key", "", forcing + on_far + "turn_with_body = true #!",
                             "stage.press.force.jack.turn_with_body", "did you mean 'turns_with_body'?"},
                    BadInput{"turns_by_word", "", forcing + on_far + "turns_with_body = \"yes\" #!",
                             "stage.press.force.jack.turns_with_body = \"yes\"", "true or false"},
                    BadInput{"not_a_number", "", forcing + "bodies = [\"far\"]\nforce = [nan, 0, 0] #!",
                             "stage.press.force.jack.force = nan", "must be a finite number"},
                    BadInput{"huge", "", forcing + "bodies = [\"far\"]\nforce = [0, 1e300, 0] #!",
                             "stage.press.force.jack.force = 1e+300", "must lie between"},
                    BadInput{"huge_factor", "", forcing_in_time + on_far + "times_s = [0]\nfactors = [-1e300] #!",
                             "stage.press.force.jack.factors.1 = -1e+300", "must lie between"}),
    by_name);

}  // namespace
}  // namespace voussoir::bad_stage_loads_test
