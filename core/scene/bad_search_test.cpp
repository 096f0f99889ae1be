// Mistakes in searches, in changes of friction by a stage, and in joint sets through a point.
#include "core/testing/bad_scenes.hpp"

namespace voussoir::bad_search_test {
namespace {

using namespace bad_scenes;

class BadSearch : public testing::TestWithParam<BadInput> {};

TEST_P(BadSearch, IsReportedInOneLine) {
  expect_reported(GetParam());
}

const std::string reduction = "from_deg = 40\nto_deg = 5\ntolerance_deg = 0.01";
const std::string factor = "search = \"factor\"\n";
const std::string range = "to_factor = 2\nfrom_factor = 0.5\n";

INSTANTIATE_TEST_SUITE_P(
    Factor, BadSearch,
    testing::Values(
        BadInput{"of_angle", reduction, factor + range + "tolerance_factor = 0.01\nto_deg = 5 #!",
                 "stage.reduce.to_deg = 5", "only if search = \"friction\", which here is \"factor\""},
        BadInput{"without_search", reduction, "to_deg = 5\nfrom_deg = 40\ntolerance_deg = 0.01\nto_factor = 2 #!",
                 "stage.reduce.to_factor = 2", "only if search = \"factor\", which here is \"friction\" (the default)"},
        BadInput{"tolerance_of_angle", reduction, factor + range + "tolerance_deg = 0.01 #!",
                 "stage.reduce.tolerance_deg = 0.01", "only if search = \"friction\""},
        BadInput{"tolerance_of_steps", reduction,
                 factor + range + "method = \"steps\"\nstep_factor = 0.1\ntolerance_factor = 0.01 #!",
                 "stage.reduce.tolerance_factor = 0.01", "only if method = \"bisection\", which here is \"steps\""},
        BadInput{"step_of_angle", reduction, factor + range + "method = \"steps\"\nstep_deg = 0.1 #!",
                 "stage.reduce.step_deg = 0.1", "only if search = \"friction\""},
        BadInput{"without_tolerance", "[[stage]]\nname = \"reduce\"\nkind = \"reduce\"\n" + reduction,
                 "[[stage]] #!\nname = \"reduce\"\nkind = \"reduce\"\n" + factor + range,
                 "stage.reduce.tolerance_factor is missing", "tolerance_factor = 0.001"},
        BadInput{"without_end", "[[stage]]\nname = \"reduce\"\nkind = \"reduce\"\n" + reduction,
                 "[[stage]] #!\nname = \"reduce\"\nkind = \"reduce\"\n" + factor + "from_factor = 0.5\n",
                 "stage.reduce.to_factor is missing", "to_factor = 3"},
        BadInput{"reversed", reduction, factor + "to_factor = 0.5\nfrom_factor = 2 #!\ntolerance_factor = 0.01",
                 "stage.reduce.from_factor = 2", "must be less than to_factor (0.5)"},
        BadInput{"of_nothing", reduction, factor + "to_factor = 2\nfrom_factor = 0 #!\ntolerance_factor = 0.01",
                 "stage.reduce.from_factor = 0", "must be greater than 0"},
        BadInput{"by_rate", reduction, factor + range + "method = \"rate\" #!\nrate_deg_per_s = 1",
                 "stage.reduce.method = \"rate\"", "write method = \"bisection\" or \"steps\""},
        BadInput{"by_two_rates", reduction,
                 factor + range + "method = \"two_rates\" #!\nrate_deg_per_s = 1\nslower_rate_deg_per_s = 0.1",
                 "stage.reduce.method = \"two_rates\"", "the delay of failure at a finite rate"},
        BadInput{"another_search", reduction, "search = \"cohesion\" #!\n" + reduction,
                 "stage.reduce.search = \"cohesion\"", "must be one of \"friction\", \"factor\""},
        BadInput{"of_nobody", reduction, factor + range + "tolerance_factor = 0.01\njoint_properties = [\"rok\"] #!",
                 "stage.reduce.joint_properties", "did you mean 'rock'?"}),
    by_name);

INSTANTIATE_TEST_SUITE_P(Failure, BadSearch,
                         testing::Values(BadInput{"fraction_above_one", reduction,
                                                  reduction + "\nfailure_fraction = 10 #!",
                                                  "stage.reduce.failure_fraction = 10", "must lie between 0 and 1"},
                                         BadInput{"fraction_of_a_settle", "name = \"settle\"\nkind",
                                                  "name = \"settle\"\nfailure_fraction = 0.1 #!\nkind",
                                                  "stage.settle.failure_fraction = 0.1", "only if kind = \"reduce\""}),
                         by_name);

const std::string settle = "name = \"settle\"\nkind = \"settle\"\n";

INSTANTIATE_TEST_SUITE_P(
    Friction, BadSearch,
    testing::Values(BadInput{"of_nobody", settle, settle + "friction = [{ friction_deg = 20, name = \"rok\" }] #!\n",
                             "stage.settle.friction.rok.name = \"rok\"", "did you mean 'rock'?"},
                    BadInput{"without_angle", settle, settle + "friction = [{ name = \"rock\" }] #!\n",
                             "stage.settle.friction.rock.friction_deg is missing", "friction_deg = 30"},
                    BadInput{"without_name", settle, settle + "friction = [{ friction_deg = 20 }] #!\n",
                             "stage.settle.friction.1.name is missing", "joint_properties"},
                    BadInput{"twice", settle,
                             settle + "[[stage.friction]]\nname = \"rock\"\nfriction_deg = 20\n[[stage.friction]]\n"
                                      "friction_deg = 30\nname = \"rock\" #!\n",
                             "stage.settle.friction.rock.name = \"rock\"", "must be unique in stage.settle.friction"},
                    BadInput{"a_number", settle, settle + "friction = 20 #!\n", "stage.settle.friction = 20",
                             "[[stage.settle.friction]]"},
                    BadInput{"right_angle", settle, settle + "friction = [{ name = \"rock\", friction_deg = 90 }] #!\n",
                             "stage.settle.friction.rock.friction_deg = 90", "less than 90 deg"},
                    BadInput{"slip_by_number", settle, settle + "zero_slip = 0 #!\n", "stage.settle.zero_slip = 0",
                             "must be true or false"}),
    by_name);

const std::string set = "[[joint_sets]]\nname = \"S\"\ndip = 0\nspacing = 1\n";

INSTANTIATE_TEST_SUITE_P(
    Point, BadSearch,
    testing::Values(
        BadInput{"of_poisson", "", set + "point = [0, 0, 0] #!", "joint_sets.S.point = [0, 0, 0]",
                 "only if arrangement = \"equal\", which here is \"poisson\" (the default)"},
        BadInput{"of_two_entries", "", set + "arrangement = \"equal\"\npoint = [0, 0] #!",
                 "joint_sets.S.point = [0, 0]", "a list of 3 numbers in m"},
        BadInput{"with_scatter", "",
                 set + "arrangement = \"equal\"\nscatter = \"fisher\"\nfisher_constant = 100\npoint = [0, 0, 0] #!",
                 "joint_sets.S.point = [0, 0, 0]", "is stated together with scatter"}),
    by_name);

}  // namespace
}  // namespace voussoir::bad_search_test
