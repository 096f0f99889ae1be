// Every mistake in a scene is reported in one line: file, line, key, value found, allowed values, repair.
#include <gtest/gtest.h>

#include <fstream>

#include "core/testing/bad_scenes.hpp"

namespace voussoir::bad_input_test {
namespace {

using namespace bad_scenes;

class Bad : public testing::TestWithParam<BadInput> {};

TEST_P(Bad, IsReportedInOneLine) {
  expect_reported(GetParam());
}

INSTANTIATE_TEST_SUITE_P(
    Syntax, Bad,
    testing::Values(BadInput{"brackets", "", "[[[[[[ #!", "not valid TOML", "correct the TOML"},
                    BadInput{"duplicate_key", "density = 2600", "density = 2600\ndensity = 2700 #!", "'density'",
                             "may appear once"},
                    BadInput{"table_for_list", "", "[joints] #!", "'joints'", "[[name]]"},
                    BadInput{"degree_sign", "dip = 30", "dip = 30° #!", "not valid TOML", "correct the TOML"},
                    BadInput{"accent", "dip = 30", "é = 30 #!", "not valid TOML", "correct the TOML"},
                    BadInput{"overflow", "dip = 30", "dip = 1e400 #!", "1e400", "correct the TOML"},
                    BadInput{"underflow", "dip = 30", "dip = 1e-400 #!", "too small for double precision", "write 0"},
                    BadInput{"no_value", "dip = 30", "dip = #!", "not valid TOML", "correct the TOML"},
                    BadInput{"open_text", "name = \"A\"", "name = \"A #!", "not valid TOML", "double quotes"},
                    BadInput{"dangling", "dip = 30", "dip = 30 30 #!", "not valid TOML", "correct the TOML"},
                    BadInput{"deep_list", "dip = 30", "dip = [[[[[[[[[[[[[[[[[[[[1]]]]]]]]]]]]]]]]]]]] #!",
                             "not valid TOML", "depth"},
                    BadInput{"deep_key", "",
                             [] {
                               std::string k = "a";
                               for (int i = 0; i < 100000; ++i)
                                 k += ".a";
                               return k + " = 1";
                             }(),
                             "100 dots", "three levels"},
                    BadInput{"not_utf8", "name = \"A\"", "name = \"\xff\" #!", "utf-8", "correct the TOML"}),
    by_name);

INSTANTIATE_TEST_SUITE_P(
    Keys, Bad,
    testing::Values(
        BadInput{"unknown_key", "dip = 30", "dipp = 30 #!", "joints.A.dipp = 30", "did you mean 'dip'?"},
        BadInput{"unknown_table", "[damping]", "[dampng] #!", "dampng = {", "did you mean 'damping'?"},
        BadInput{"cut_short", "friction_deg", "friction = 40 #!\nfriction_deg", "joint_properties.rock.friction = 40",
                 "did you mean 'friction_deg'?"},
        BadInput{"wrong_table", "local = 0.7", "local = 0.7\nskin = 0.1 #!", "damping.skin = 0.1",
                 "it belongs to a table of 'contact'"},
        BadInput{"key_by_number", "from_deg = 40",
                 "from_deg = 40\n[[stage.fix]]\nabov = [\"A\"] #!\n[[stage]]\nname = \"x\"\nkind=\"settle\"\n",
                 "stage.reduce.fix.1.abov", "did you mean 'above'?"},
        BadInput{"missing_dimension", "title = \"Two blocks on an incline\"\ndimension = 3", "title = \"x\" #!",
                 "dimension is missing", "write dimension = 2 or dimension = 3"},
        BadInput{"missing_dip", "[[joints]]\nname = \"A\"\ndip = 30", "[[joints]] #!\nname = \"A\"",
                 "joints.A.dip is missing", "for example dip = 40"},
        BadInput{"missing_direction", "[[joints]]\nname = \"A\"\ndip = 30\ndip_direction = 90",
                 "[[joints]] #!\nname = \"A\"\ndip = 30", "joints.A.dip_direction is missing",
                 "for example dip_direction = 130"},
        BadInput{"missing_name", "[[joints]]\nname = \"A\"", "[[joints]] #!", "joints.1.name is missing",
                 "name = \"A\""},
        BadInput{"missing_stiffness", "[[joint_properties]]\nname = \"rock\"\nnormal_stiffness = 1e9",
                 "[[joint_properties]] #!\nname = \"rock\"", "joint_properties.rock.normal_stiffness is missing",
                 "normal_stiffness = 10e9"},
        BadInput{"missing_to", "[[stage]]\nname = \"reduce\"\nkind = \"reduce\"\nfrom_deg = 40\nto_deg = 5",
                 "[[stage]] #!\nname = \"reduce\"\nkind = \"reduce\"\nfrom_deg = 40", "stage.reduce.to_deg is missing",
                 "to_deg = 5"},
        BadInput{"missing_tolerance",
                 "[[stage]]\nname = \"reduce\"\nkind = \"reduce\"\nfrom_deg = 40\nto_deg = 5\ntolerance_deg = 0.01",
                 "[[stage]] #!\nname = \"reduce\"\nkind = \"reduce\"\nfrom_deg = 40\nto_deg = 5",
                 "stage.reduce.tolerance_deg is missing", "tolerance_deg = 0.01"},
        BadInput{"missing_duration", "", "[[stage]] #!\nname = \"go\"\nkind = \"run\"",
                 "stage.go.duration_s is missing", "duration_s = 2"},
        BadInput{"wrong_kind", "name = \"settle\"\nkind = \"settle\"",
                 "name = \"settle\"\nkind = \"settle\"\nduration_s = 2 #!", "stage.settle.duration_s = 2",
                 "only if kind = \"run\""},
        BadInput{"wrong_method", "from_deg = 40", "step_deg = 1 #!\nfrom_deg = 40", "stage.reduce.step_deg = 1",
                 "only if method = \"steps\", which here is \"bisection\""},
        BadInput{"name_twice", "name = \"B\"", "name = \"A\" #!", "joints.A.name = \"A\"", "must be unique in joints"},
        BadInput{"dot_in_name", "name = \"B\"", "name = \"B.1\" #!", "\"B.1\"", "write '-' or a space instead"},
        BadInput{"empty_name", "name = \"B\"", "name = \"\" #!", "joints.2.name = \"\"", "must not be empty"}),
    by_name);

INSTANTIATE_TEST_SUITE_P(
    Types, Bad,
    testing::Values(
        BadInput{"text_for_number", "dip = 30", "dip = \"steep\" #!", "joints.A.dip = \"steep\"",
                 "must be a number in deg, without quotes"},
        BadInput{"number_for_text", "title = \"Two blocks on an incline\"", "title = 5 #!", "title = 5",
                 "in double quotes"},
        BadInput{"number_for_table", "density = 2600", "density = 2600\nslicing = 3 #!", "slicing = 3",
                 "must be a table; write [slicing]"},
        BadInput{"table_for_tables", "[[fix]]\nbelow = [\"A\"]", "[fix] #!\nbelow = [\"A\"]", "fix = {",
                 "[[fix]] with two brackets"},
        BadInput{"numbers_for_tables", "density = 2600", "density = 2600\nrestrain = [1, 2] #!", "restrain = [1, 2]",
                 "[[restrain]] with two brackets"},
        BadInput{"date", "dip = 30", "dip = 1979-05-27 #!", "joints.A.dip = a date", "must be a number"},
        BadInput{"nan", "dip = 30", "dip = nan #!", "joints.A.dip = nan", "must be a finite number"},
        BadInput{"inf", "gravity = [0, 0, -9.81]", "gravity = [0, 0, -inf] #!", "gravity = -inf",
                 "must be a finite number"},
        BadInput{"hexadecimal", "density = 2600", "density = 0xA28 #!", "density = 2600", "as a decimal number"},
        BadInput{"short_vector", "gravity = [0, 0, -9.81]", "gravity = [0, -9.81] #!", "gravity = [0, -9.81]",
                 "a list of 3 numbers in m/s² (x, y, z) because dimension = 3"},
        BadInput{"mixed_vector", "point = [0, 0, 0]", "point = [0, \"0\", 0] #!", "joints.A.point = \"0\"",
                 "a list of 3 numbers"},
        BadInput{"fraction_for_count", "name = \"settle\"\nkind", "name = \"settle\"\nstep_limit = 10.5 #!\nkind",
                 "step_limit = 10.5", "whole number"},
        BadInput{"number_for_list", "below = [\"A\"]", "below = 5 #!", "fix.1.below = 5", "a name or a list of names"},
        BadInput{"wrong_choice", "kind = \"settle\"", "kind = \"setle\" #!", "stage.settle.kind = \"setle\"",
                 "did you mean \"settle\"?"},
        BadInput{"wrong_quantity", "[\"displacement\"]", "[\"displacements\"] #!", "\"displacements\"",
                 "did you mean \"displacement\"?"},
        BadInput{"quantity_twice", "[\"displacement\"]", "[\"displacement\", \"displacement\"] #!", "\"displacement\"",
                 "remove one"},
        BadInput{"wrong_axis", "[damping]", "[[restrain]]\nabove = [\"A\"]\ntranslation = [\"w\"] #!\n[damping]",
                 "restrain.1.translation = \"w\"", "\"x\", \"y\", \"z\""}),
    by_name);

INSTANTIATE_TEST_SUITE_P(
    Ranges, Bad,
    testing::Values(BadInput{"steep", "dip = 30", "dip = 95 #!", "joints.A.dip = 95",
                             "must lie between 0 and 90 deg; measure the dip downwards from the horizontal"},
                    BadInput{"direction", "dip_direction = 90", "dip_direction = -10 #!",
                             "joints.A.dip_direction = -10", "between 0 and 360 deg; clockwise from north"},
                    BadInput{"negative_density", "density = 2600", "density = -2600 #!", "density = -2600",
                             "must be greater than 0"},
                    BadInput{"no_stiffness", "normal_stiffness = 1e9", "normal_stiffness = 0 #!",
                             "normal_stiffness = 0", "must be greater than 0"},
                    BadInput{"friction", "friction_deg = 40", "friction_deg = 90 #!", "friction_deg = 90",
                             "less than 90 deg; give the angle"},
                    BadInput{"damping", "local = 0.7", "local = 1 #!", "damping.local = 1", "0.7 to reach equilibrium"},
                    BadInput{"dimension", "dimension = 3", "dimension = 4 #!", "dimension = 4",
                             "write dimension = 2 or dimension = 3"},
                    BadInput{"huge", "point = [0, 0, 0]", "point = [0, 0, 1e300] #!", "joints.A.point = 1e+300",
                             "must lie between"},
                    BadInput{"reversed", "from_deg = 40", "from_deg = 4 #!", "stage.reduce.from_deg = 4",
                             "must be greater than to_deg (5)"},
                    BadInput{"endless_ramp", "name = \"settle\"\nkind",
                             "name = \"settle\"\ngravity_ramp_s = 1e9 #!\nkind", "stage.settle.gravity_ramp_s = 1e+09",
                             "less than time_limit_s (by default 1e9)"},
                    BadInput{"denormal", "dip = 30", "dip = 1e-310 #!", "joints.A.dip = 1e-310", "write 0"},
                    BadInput{"box_reversed", "box = { min = [-2, -2, -2], max = [2, 2, 2] }",
                             "box = { min = [-2, -2, 2], max = [2, 2, -2] } #!", "domain.box.max",
                             "must exceed min along z"}),
    by_name);

INSTANTIATE_TEST_SUITE_P(
    Meaning, Bad,
    testing::Values(
        BadInput{"empty_domain_table", "box = { min = [-2, -2, -2], max = [2, 2, 2] }", "", "domain.box is missing",
                 "a box, planes or both"},
        BadInput{"rate_by_newton", "to_deg = 5\ntolerance_deg = 0.01",
                 "to_deg = 5\nmethod = \"rate\" #!\nrate_deg_per_s = 1\nstatics = \"newton\"",
                 "stage.reduce.method = \"rate\"", "method = \"bisection\""},
        BadInput{"open_domain", "[domain]\nbox = { min = [-2, -2, -2], max = [2, 2, 2] }",
                 "[domain] #!\nplanes = [{ dip = 0, point = [0, 0, 0], keep = \"below\" }]", "domain = {",
                 "do not close a region"},
        BadInput{"empty_domain", "[domain]\nbox",
                 "[domain] #!\nplanes = [{ dip = 0, point = [0, 0, 5], keep = \"above\" }]\nbox", "domain = {",
                 "no point is inside all planes"},
        BadInput{"open_block", "box = { min = [10, 0, 0], max = [11, 1, 1] }",
                 "planes = [{ normal = [0, 0, 1], offset = 1 }] #!", "blocks.far.planes",
                 "the block is open; add the missing planes"},
        BadInput{"empty_block", "box = { min = [10, 0, 0], max = [11, 1, 1] }",
                 "planes = [{ normal = [0, 0, 1], offset = 1 }, { normal = [0, 0, -1], offset = -2 }, { normal = [1, "
                 "0, 0], offset = 1 }, { normal = [-1, 0, 0], offset = 1 }, { normal = [0, 1, 0], offset = 1 }, { "
                 "normal = [0, -1, 0], offset = 1 }] #!",
                 "blocks.far.planes", "the block is empty"},
        BadInput{"flat_block", "box = { min = [10, 0, 0], max = [11, 1, 1] }",
                 "vertices = [[10, 0, 0], [11, 0, 0], [11, 1, 0], [10, 1, 0]] #!", "blocks.far.vertices",
                 "are not in one plane"},
        BadInput{"few_points", "box = { min = [10, 0, 0], max = [11, 1, 1] }", "vertices = [[10, 0, 0], [11, 0, 0]] #!",
                 "blocks.far.vertices", "at least 4 points"},
        BadInput{"inner_vertex", "box = { min = [10, 0, 0], max = [11, 1, 1] }",
                 "vertices = [[10, 0, 0], [14, 0, 0], [10, 4, 0],\n[11, 1, 1], #!\n[10, 0, 4]]",
                 "blocks.far.vertices.4 = [11, 1, 1]", "every vertex must be a corner"},
        BadInput{"no_shape", "[[blocks]]\nname = \"far\"\nbox = { min = [10, 0, 0], max = [11, 1, 1] }",
                 "[[blocks]] #!\nname = \"far\"", "blocks.far.vertices is missing", "one of vertices, planes or box"},
        BadInput{"two_shapes", "name = \"far\"", "name = \"far\"\nvertices = [[0, 0, 0]] #!", "blocks.far.vertices",
                 "only one of vertices, planes and box"},
        BadInput{"zero_normal", "box = { min = [10, 0, 0], max = [11, 1, 1] }",
                 "planes = [{ normal = [0, 0, 0], offset = 1 }] #!", "blocks.far.planes.1.normal = [0, 0, 0]",
                 "must not be zero"},
        BadInput{"no_block", good_scene.substr(0, good_scene.find("[[monitors]]")),
                 "dimension = 3 #!\n[[joint_properties]]\nname = \"rock\"\nnormal_stiffness = 1\nshear_stiffness = "
                 "1\nfriction_deg = 1\n[[stage]]\nname = \"s\"\nkind = \"settle\"\n",
                 "domain is missing", "the scene has no block"},
        BadInput{"no_free_block", "[[fix]]\nbelow = [\"A\"]", "[[fix]] #!\nall = true", "fix.1 = { all = true }",
                 "no block is free to move"},
        BadInput{"fixes_nothing", "[[fix]]\nbelow = [\"A\"]", "[[fix]] #!\ninside = [50, 0, 0]",
                 "fix.1 = { inside = [50, 0, 0] }", "chooses no block"},
        BadInput{"chooses_nothing", "[[fix]]\nbelow = [\"A\"]", "[[fix]] #!\nname = \"base\"",
                 "fix.base.below is missing", "no block is chosen"},
        BadInput{"no_density",
                 "title = \"Two blocks on an incline\"\ndimension = 3\ngravity = [0, 0, -9.81]\ndensity = 2600",
                 "dimension = 3 #!", "density is missing", "density = 2600"},
        BadInput{
            "no_properties",
            "[[joint_properties]]\nname = \"rock\"\nnormal_stiffness = 1e9\nshear_stiffness = 1e8\nfriction_deg = 40",
            "", "joints.A.properties is missing", "add [[joint_properties]]"},
        BadInput{"unknown_properties", "properties = \"rock\"", "properties = \"rok\" #!",
                 "joints.B.properties = \"rok\"", "did you mean 'rock'?"},
        BadInput{"several_properties", "[[joint_properties]]",
                 "[[joint_properties]]\nname = \"soil\"\nnormal_stiffness = 1e9\nshear_stiffness = 1e8\nfriction_deg = "
                 "40\n[[joint_properties]]",
                 "joints.A.properties is missing", "there are: soil, rock"},
        BadInput{"unknown_joint", "below = [\"A\"]", "below = [\"AA\"] #!", "fix.1.below = [\"AA\"]",
                 "no joint is named 'AA'; did you mean 'A'?"},
        BadInput{"unknown_block", "below = [\"A\"]", "bodies = [\"fra\"] #!", "fix.1.bodies = [\"fra\"]",
                 "did you mean 'far'?"},
        BadInput{"no_stage", good_scene.substr(good_scene.find("[[stage]]")), "", "stage is missing",
                 "kind = \"settle\""},
        BadInput{"unknown_reduced", "from_deg = 40", "joint_properties = [\"rok\"] #!\nfrom_deg = 40",
                 "stage.reduce.joint_properties", "did you mean 'rock'?"},
        BadInput{"stage_removes_nothing", "",
                 "[[stage]]\nname = \"dig\"\nkind = \"settle\"\n[[stage.remove]] #!\ninside = [50, 0, 0]",
                 "stage.dig.remove.1", "chooses no block"},
        BadInput{"fixed_and_moving", "name = \"far\"", "name = \"far\"\nfixed = true\nvelocity = [1, 0, 0] #!",
                 "blocks.far.velocity = [1, 0, 0]", "the block is fixed"},
        BadInput{"restrains_nothing", "[damping]", "[[restrain]] #!\nall = true\n[damping]",
                 "restrain.1.rotation is missing", "nothing is restrained"}),
    by_name);

INSTANTIATE_TEST_SUITE_P(
    Monitors, Bad,
    testing::Values(BadInput{"monitor_of_none",
                             "[[monitors]]\nname = \"slider\"\nquantities = [\"displacement\"]\nabove = [\"A\", \"B\"]",
                             "[[monitors]] #!\nname = \"slider\"\nquantities = [\"displacement\"]\ninside = [50, 0, 0]",
                             "monitors.slider = {", "chooses no block"},
                    BadInput{"monitor_of_several",
                             "[[monitors]]\nname = \"slider\"\nquantities = [\"displacement\"]\nabove = [\"A\", \"B\"]",
                             "[[monitors]] #!\nname = \"slider\"\nquantities = [\"displacement\"]\nabove = [\"A\"]",
                             "monitors.slider = {", "chooses 3 blocks but must choose exactly one"},
                    BadInput{"monitor_without_choice",
                             "[[monitors]]\nname = \"slider\"\nquantities = [\"displacement\"]\nabove = [\"A\", \"B\"]",
                             "[[monitors]] #!\nname = \"slider\"\nquantities = [\"displacement\"]",
                             "monitors.slider.above is missing", "must choose one block"},
                    BadInput{"monitor_unknown_joint", "joint = \"A\"", "joint = \"C\" #!",
                             "monitors.on A.joint = \"C\"", "no joint of this name; there are: A, B"},
                    BadInput{"monitor_outside", "point = [0, 0.5, 0]", "point = [0, 50, 0] # outside", "monitors",
                             "chooses"},
                    BadInput{"force_without_joint", "[\"displacement\"]", "[\"contact_force\"]",
                             "monitors.slider.joint is missing", "write for example joint = \"A\""},
                    BadInput{"joint_displacement", "[\"contact_force\"]", "[\"displacement\"] #!",
                             "monitors.on A.quantities", "has contact_force and whole_bonds only"}),
    by_name);

INSTANTIATE_TEST_SUITE_P(
    Plane, Bad,
    testing::Values(BadInput{"direction_2d", good_scene,
                             "dimension = 2\n[[joints]]\nname = \"A\"\ndip = 30\ndip_direction = 45 #!\npoint = [0, 0]",
                             "joints.A.dip_direction = 45", "90 (dips to the right) or 270 (to the left)"},
                    BadInput{"three_entries_2d", good_scene, "dimension = 2\ngravity = [0, 0, -9.81] #!",
                             "gravity = [0, 0, -9.81]", "a list of 2 numbers in m/s² (x, y)"},
                    BadInput{"spin_2d", good_scene,
                             "dimension = 2\n[[blocks]]\nname = \"a\"\nbox = { min = [0, 0], max = [1, 1] "
                             "}\nangular_velocity = [0, 0, 1] #!",
                             "blocks.a.angular_velocity", "one number in rad/s because dimension = 2"},
                    BadInput{"rotation_2d", good_scene,
                             "dimension = 2\n[[restrain]]\nall = true\nrotation = [\"z\"] #!", "restrain.1.rotation",
                             "write rotation = true"},
                    BadInput{"flat_2d", good_scene,
                             "dimension = 2\ndensity = 1\n[[blocks]]\nname = \"a\"\nvertices = [[0, 0], [1, 1], [2, "
                             "2]] #!\n[[stage]]\nname = \"s\"\nkind = \"settle\"",
                             "blocks.a.vertices", "are not on one line"}),
    by_name);

INSTANTIATE_TEST_SUITE_P(
    Laws, Bad,
    testing::Values(
        BadInput{"law_on_springs", "friction_deg = 40",
                 "friction_deg = 40\ncohesion = 1e6\nconstant_stiffness = true #!",
                 "joint_properties.rock.constant_stiffness", "give the stiffness per area"},
        BadInput{"tension_of_a_power", "friction_deg = 40",
                 "friction_deg = 40\nnormal_law = \"power\"\nnormal_exponent = 0.5\ntension = 1e5 #!",
                 "joint_properties.rock.tension = 1e+05", "no stiffness without stress"},
        BadInput{"softer_than_nothing", "friction_deg = 40",
                 "friction_deg = 40\nfriction_law = \"softening\"\nsoftening_slip_m = 0.1\nsoftening_drop = 0.9 #!",
                 "joint_properties.rock.softening_drop = 0.9", "0.8391"},
        BadInput{"tension_of_a_hyperbola", "friction_deg = 40",
                 "friction_deg = 40\nnormal_law = \"hyperbolic\"\nmaximum_closure_m = 2e-4\ntension = 1e5 #!",
                 "joint_properties.rock.tension = 1e+05", "has no tension"},
        BadInput{"dilates_more_than_it_rubs", "friction_deg = 40",
                 "friction_deg = 40\ndilation_law = \"falling\"\ndilation_decay_m = 0.01\ndilation_deg = 41 #!",
                 "joint_properties.rock.dilation_deg = 41", "the friction angle, 40 degrees"},
        BadInput{"dilates_more_than_softening_leaves", "friction_deg = 40",
                 "friction_deg = 40\nfriction_law = \"softening\"\nsoftening_slip_m = 0.1\nsoftening_drop = 0.7\n"
                 "dilation_law = \"falling\"\ndilation_decay_m = 0.01\ndilation_deg = 10 #!",
                 "joint_properties.rock.dilation_deg = 10", "that softening leaves, 7.919 degrees"},
        BadInput{"dilates_before_it_rubs", "friction_deg = 40",
                 "friction_deg = 40\nfriction_law = \"hardening\"\nhardening_slip_m = 1e-6\ndilation_deg = 8\n"
                 "dilation_decay_m = 0.01\ndilation_law = \"falling\" #!",
                 "joint_properties.rock.dilation_law", "zero before any slip"},
        BadInput{"rough_and_steep", "friction_deg = 40",
                 "friction_law = \"barton_bandis\"\njrc = 10\njcs = 30e6\nfriction_deg = 70 #!",
                 "joint_properties.rock.friction_deg = 70", "must be below 70 degrees"},
        BadInput{"rough_without_strength", "friction_deg = 40",
                 "friction_deg = 40\njrc = 10\nfriction_law = \"barton_bandis\"", "joint_properties.rock.jcs",
                 "is missing"},
        BadInput{"mobilised_without_blocks", "friction_deg = 40",
                 "friction_deg = 40\nfriction_law = \"barton_bandis\"\njrc = 10\njcs = 30e6\nmobilisation = \"table\"",
                 "joint_properties.rock.block_length_m", "write mobilisation = \"none\""},
        BadInput{"sample_without_blocks", "friction_deg = 40",
                 "friction_deg = 40\nfriction_law = \"barton_bandis\"\njrc = 10\njcs = 30e6\nsample_length_m = 0.1 #!",
                 "joint_properties.rock.sample_length_m = 0.1", "state both or neither"},
        BadInput{"sample_of_several_blocks", "friction_deg = 40",
                 "friction_deg = 40\nfriction_law = \"barton_bandis\"\njrc = 10\njcs = 30e6\nblock_length_m = 0.1\n"
                 "sample_length_m = 0.2 #!",
                 "joint_properties.rock.sample_length_m = 0.2", "exceeds block_length_m = 0.1"},
        BadInput{"two_dilations", "friction_deg = 40",
                 "friction_deg = 40\nfriction_law = \"barton_bandis\"\njrc = 10\njcs = 30e6\ndilation_decay_m = 0.01\n"
                 "dilation_deg = 8\ndilation_law = \"falling\" #!",
                 "joint_properties.rock.dilation_law", "dilates by dilation_share"},
        BadInput{"smooth_with_roughness", "friction_deg = 40", "friction_deg = 40\njrc = 10 #!",
                 "joint_properties.rock.jrc", "applies only if friction_law"}),
    by_name);

struct BadOverride {
  const char *text, *key, *phrase;
};

TEST(BadOverrides, AreReportedWithTheirText) {
  const BadOverride all[] = {{"joints.A.dip=95", "joints.A.dip = 95", "must lie between 0 and 90"},
                             {"joints.C.dip=65", "joints.C", "there are: A, B"},
                             {"joints.A.dp=65", "joints.A.dp", "did you mean 'dip'?"},
                             {"joint.A.dip=65", "joint", "did you mean 'joints'?"},
                             {"joints.A=65", "joints.A", "name one of its keys: name, dip"},
                             {"joints.A.dip.x=65", "joints.A.dip", "a value and has no keys"},
                             {"restrain.1.rotation=true", "restrain", "write [[restrain]] in the file"},
                             {"fix.2.all=true", "fix.2", "there are: 1"},
                             {"joints.A.dip", "joints.A.dip", "has no '='"},
                             {"=3", "", "no such key"},
                             {"contact.centre=ipopt", "contact.centre", "has left the program together with Ipopt"},
                             {"contact.lp=glpk", "contact.lp", "has left the program together with GLPK"},
                             {"joints.A.dip=", "joints.A.dip", "not valid TOML"},
                             {"joints.A.dip=65deg", "joints.A.dip=65deg", "not valid TOML"},
                             {"joints.A.dip=nan", "joints.A.dip = nan", "must be a finite number"},
                             {"contact={normal='multipliers',overlap='bracketing'}", "contact.overlap", "leave it out"},
                             {"joints.A.dip=65\ndensity=3", "joints.A.dip", "not valid TOML"},
                             {"gravity=[0,0", "gravity", "not valid TOML"},
                             {"gravity=[0,0,1e-400]", "gravity", "not valid TOML"},
                             {"base=scene.toml", "base", "cannot be set"},
                             {"stage.settle.damping.local=2", "stage.settle.damping.local = 2", "less than 1"},
                             {"dimension=2", "gravity", "a list of 2 numbers"}};
  for (const BadOverride& bad : all) {
    const std::string message = complaint_about(good_scene, {bad.text});
    EXPECT_EQ(message.find_first_of("\n\r"), std::string::npos) << message;
    EXPECT_TRUE(message.starts_with("scene.toml")) << bad.text << ": " << message;
    if (std::string_view(bad.text) != "dimension=2") {
      EXPECT_NE(message.find("--set "), std::string::npos) << message;
    }
    EXPECT_NE(message.find(bad.key), std::string::npos) << message;
    EXPECT_NE(message.find(bad.phrase), std::string::npos) << message;
  }
}

TEST(BadFiles, AreReportedWithTheirPath) {
  const auto complaint = [](const std::filesystem::path& path) -> std::string {
    try {
      read_scene(path);
    } catch (const SceneError& error) {
      return error.what();
    }
    return "";
  };
  const std::filesystem::path folder = testing::TempDir();
  EXPECT_NE(complaint(folder / "no_such_scene.toml").find("no_such_scene.toml: no such file"), std::string::npos);
  EXPECT_NE(complaint(folder).find("not a file"), std::string::npos);
  const std::filesystem::path empty = folder / "voussoir_empty_scene.toml";
  std::ofstream(empty).close();
  EXPECT_NE(complaint(empty).find("dimension is missing"), std::string::npos);
  std::filesystem::resize_file(empty, (16u << 20) + 1);
  EXPECT_NE(complaint(empty).find("larger than 16 MB"), std::string::npos);
  std::filesystem::remove(empty);
}

TEST(GoodScene, IsAccepted) {
  EXPECT_EQ(complaint_about(good_scene), "");
}

// any text is either accepted or refused with a message, and never causes a crash: the good scene truncated, and with
// each character replaced
TEST(Damaged, NeverCrashes) {
  for (std::size_t i = 0; i < good_scene.size(); ++i) {
    for (const char c : {'[', '=', '"', '-'}) {
      std::string text = good_scene.substr(0, i) + c;
      EXPECT_EQ(complaint_about(text).find('\n'), std::string::npos);
      text += good_scene.substr(i + 1);
      try {
        parse_scene(text, "scene.toml");
      } catch (const SceneError&) {
      }
    }
  }
}

}  // namespace
}  // namespace voussoir::bad_input_test
