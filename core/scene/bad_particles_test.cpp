// Mistakes in the keys of potential particles.
#include "core/testing/bad_scenes.hpp"

namespace voussoir::bad_particles_test {
namespace {

using namespace bad_scenes;

class BadParticles : public testing::TestWithParam<BadInput> {};

TEST_P(BadParticles, IsReportedInOneLine) {
  expect_reported(GetParam());
}

const std::string ball = "[[blocks]]\nname = \"ball\"\nshape = \"potential\"\n";
const std::string planes = "box = { min = [20, -1, -1], max = [22, 1, 1] }\n";
const std::string cube = ball + planes + "sphericity = 0.02\n";
const std::string sphere = ball + "sphericity = 1\nsphere_radius = 1\ncentre = [20, 0, 0]\n";

INSTANTIATE_TEST_SUITE_P(
    Shapes, BadParticles,
    testing::Values(
        BadInput{"no_shape_of_this_name", "", "[[blocks]]\nname = \"ball\"\nshape = \"potencial\" #!\n",
                 "blocks.ball.shape = \"potencial\"", "did you mean \"potential\"?"},
        BadInput{"radius_of_zero", "", cube + "corner_radius = 0 #!", "blocks.ball.corner_radius = 0",
                 "must be greater than 0"},
        BadInput{"negative_radius", "", cube + "corner_radius = -0.1 #!", "blocks.ball.corner_radius = -0.1",
                 "the radius of edges"},
        BadInput{"no_radius", "", cube, "blocks.ball.corner_radius is missing", "corner_radius = 0.05"},
        BadInput{"radius_that_is_no_number", "", cube + "corner_radius = nan #!", "blocks.ball.corner_radius",
                 "must be a finite number"},
        BadInput{"sphericity_below_zero", "", ball + planes + "corner_radius = 0.1\nsphericity = -0.1 #!",
                 "blocks.ball.sphericity = -0.1", "must lie between 0 and 1"},
        BadInput{"sphericity_above_one", "", ball + planes + "corner_radius = 0.1\nsphericity = 1.1 #!",
                 "blocks.ball.sphericity = 1.1", "must lie between 0 and 1"},
        BadInput{"no_sphericity", "", ball + planes + "corner_radius = 0.1", "blocks.ball.sphericity is missing",
                 "sphericity = 0.02"},
        BadInput{"sphere_of_zero", "", cube + "corner_radius = 0.1\nsphere_radius = 0 #!",
                 "blocks.ball.sphere_radius = 0", "must be greater than 0"},
        BadInput{"sphere_that_does_not_enclose", "", cube + "corner_radius = 0.1\nsphere_radius = 1.5 #!",
                 "blocks.ball.sphere_radius = 1.5",
                 "does not enclose the potential particle: its planes and r need 1.83"},
        BadInput{"no_planes", "", ball + "corner_radius = 0.1\nsphericity = 0.5\ncentre = [20, 0, 0]",
                 "blocks.ball.planes is missing", "sphericity = 0.5 needs planes"},
        BadInput{"open", "",
                 ball + "corner_radius = 0.1\nsphericity = 0.5\nplanes = [{ normal = [1, 0, 0], offset = 21 }] #!",
                 "blocks.ball.planes", "do not close a region"},
        BadInput{"no_inside", "",
                 ball + "corner_radius = 0.1\nsphericity = 0.02\nbox = { min = [20, -1, -1], max = [22, 1, 1] }\n" +
                     "centre = [21, 0, 4] #!",
                 "blocks.ball.centre = [21, 0, 4]", "lies outside the potential particle"},
        BadInput{"crossed_planes", "",
                 ball + "corner_radius = 0.1\nsphericity = 0.02\nplanes = [ #!\n{ normal = [1, 0, 0], offset = 20 }, "
                        "{ normal = [-1, 0, 0], offset = -21 }, { normal = [0, 1, 0], offset = 1 }, { normal = [0, -1, "
                        "0], offset = 1 }, { normal = [0, 0, 1], offset = 1 }, { normal = [0, 0, -1], offset = 1 }]",
                 "blocks.ball.planes", "no point lies inside the potential particle"},
        BadInput{"sphere_without_radius", "", ball + "sphericity = 1\ncentre = [20, 0, 0]",
                 "blocks.ball.sphere_radius is missing", "a sphere needs its radius"},
        BadInput{"sphere_without_centre", "", ball + "sphericity = 1\nsphere_radius = 1",
                 "blocks.ball.centre is missing", "needs its centre"},
        BadInput{"corners", "",
                 ball + "sphericity = 0.02\ncorner_radius = 0.1\nvertices = [[20, 0, 0], [21, 0, 0], [20, 1, 0], [20, "
                        "0, 1]] #!",
                 "blocks.ball.vertices", "cannot define a potential particle"},
        BadInput{"radius_of_a_block", "[[blocks]]\nname = \"far\"",
                 "[[blocks]]\nname = \"far\"\ncorner_radius = 0.1 #!", "blocks.far.corner_radius = 0.1",
                 "applies only if shape = \"potential\""}),
    by_name);

// keys that cannot be combined with particles
const std::string friction = "friction_deg = 40\n";
const std::string constant = friction + "constant_stiffness = true\n";
const std::string settle = "[[stage]]\nname = \"settle\"\nkind = \"settle\"\n";
const std::string standard =
    "[[joint_properties]]\nname = \"default\"\nnormal_stiffness = 1e7\nshear_stiffness = 1e7\nfriction_deg = 30\n"
    "constant_stiffness = true\n";

INSTANTIATE_TEST_SUITE_P(
    Beside, BadParticles,
    testing::Values(BadInput{"stiffness_per_area", "", sphere, "joint_properties.rock.constant_stiffness is missing",
                             "points without area"},
                    BadInput{"sub_contacts", friction, constant + "sub_contacts = 2 #!\n" + sphere,
                             "joint_properties.rock.sub_contacts = 2", "touch at one point"},
                    BadInput{"water", friction, constant + sphere + "[[water]]\nname = \"lake\" #!\nlevel = 1\n",
                             "water.lake.name", "cannot act on potential particles"},
                    BadInput{"bolts", settle,
                             sphere + standard +
                                 "[[bolts]]\nname = \"pin\" #!\nfrom = [0, 0, 1]\nto = [0, 0, -1]\nstiffness = 1e8\n" +
                                 settle + "install = [\"pin\"]\n",
                             "bolts.pin.name", "cannot act on potential particles"},
                    BadInput{"tolerance", friction, constant + sphere + "[contact]\ntolerance = 1e-12 #!\n",
                             "contact.tolerance = 1e-12", "a tolerance of half-spaces"},
                    BadInput{"boundary_stress", settle,
                             sphere + standard + settle +
                                 "boundary = [{ bodies = [\"ball\"], stress = [1, 1, 1, 0, 0, 0] }] #!\n",
                             "stage.settle.boundary", "stresses block 'ball', a potential particle"}),
    by_name);

}  // namespace
}  // namespace voussoir::bad_particles_test
