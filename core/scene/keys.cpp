#include "core/scene/keys.hpp"

namespace voussoir {
namespace {

using enum KeyType;

// lengths and the like: far beyond any rock mass, and squares of them still are numbers
constexpr Range sane{-1e12, 1e12};
constexpr Range positive{0, 1e12, true};
constexpr Range not_negative{0, 1e12};
constexpr Range share{0, 1, false, true};
constexpr Range stiffness{0, 1e20, true};
constexpr Range dip_range{0, 90};
constexpr Range direction_range{0, 360};
constexpr Range friction_range{0, 90, false, true};
constexpr Range count{1, 1e15};

// what rock and its models usually are: a value outside is told before a run
constexpr Range usual_density{500, 8000};
constexpr Range usual_stiffness{1e6, 1e12};
constexpr Range usual_dip{.low = 1.6, .high = 90, .or_zero = true};         // 90 degrees are 1.57 radians
constexpr Range usual_direction{.low = 6.3, .high = 360, .or_zero = true};  // 360 degrees are 6.28 radians
constexpr Range usual_friction{1.6, 85};
constexpr Range usual_speed{.low = 1e-3, .high = 100, .above_low = true, .or_zero = true};
constexpr Range usual_factor{.low = 0.01, .high = 200, .or_zero = true};  // a centrifuge
constexpr Range usual_ramp{.low = 0.01, .high = 100, .or_zero = true};

constexpr std::string_view dip_repair =
    "measure the dip downwards from the horizontal; dip_direction tells to which side";
constexpr std::string_view direction_repair = "clockwise from north (y): 0 north, 90 east, 180 south, 270 west";
constexpr std::string_view dip_direction_meaning =
    "direction in which the plane dips, clockwise from north (y); in 2-D 90 (to the right) or 270 (to the left); "
    "may be left out where dip = 0";

constexpr std::string_view density_slip = "was it given in g/cm³ or t/m³?";
constexpr std::string_view stiffness_slip = "was it given in MPa/m or GPa/m?";
constexpr std::string_view angle_slip = "was it given in radians?";
constexpr std::string_view friction_slip = "was it given in radians, or as its tangent?";

// a row is a paragraph: what the key is, then what it means
// clang-format off
const KeyRow rows[] = {
    // ---- the top of the file
    {.table = "", .key = "title", .type = text, .example = "\"Sliding wedge\"",
     .meaning = "one line for reports"},
    {.table = "", .key = "base", .type = text, .example = "\"scene.toml\"",
     .meaning = "another scene in the same folder, of which this one states only the differences: tables are merged key by "
         "key, tables of a list by their name; a stage that states another kind or method replaces the "
         "base's"},
    {.table = "", .key = "dimension", .type = integer, .range = {2, 3}, .example = "3", .required = true,
     .meaning = "2: plane scene, x to the right, y up, unit thickness; 3: x east, y north, z up",
     .repair = "write dimension = 2 or dimension = 3"},
    {.table = "", .key = "gravity", .type = vector, .unit = "m/s²", .range = sane, .usual = {1, 30},
     .example = "[0, 0, -9.81]",
     .meaning = "acceleration of gravity; without it there is none", .breaks = "a wrong sign lifts the blocks off",
     .slip = "on earth it is 9.81; was it given in another unit?"},
    {.table = "", .key = "density", .unit = "kg/m³", .range = positive, .usual = usual_density, .example = "2600",
     .meaning = "density of every block that does not state its own", .repair = "rock has 2000 to 3000 kg/m³",
     .slip = density_slip},
    {.table = "", .key = "domain", .type = table, .holds = {"domain"},
     .meaning = "a convex region that the joints cut into blocks"},
    {.table = "", .key = "joints", .type = tables, .holds = {"joints"},
     .meaning = "persistent joints, in slicing order"},
    {.table = "", .key = "joint_properties", .type = tables, .holds = {"joint_properties"},
     .meaning = "stiffness and strength of joints, by name; `default`, or else the first table, also serves contacts "
         "between faces that no joint made"},
    {.table = "", .key = "blocks", .type = tables, .holds = {"blocks"},
     .meaning = "blocks given directly, by exactly one of vertices, planes or box"},
    {.table = "", .key = "fix", .type = tables, .holds = {"label", "selector"},
     .meaning = "blocks that never move"},
    {.table = "", .key = "restrain", .type = tables, .holds = {"label", "restrain", "selector"},
     .meaning = "blocks that cannot move in some directions (world axes)"},
    {.table = "", .key = "initial_velocity", .type = tables, .holds = {"label", "motion", "selector"},
     .meaning = "blocks that move when the first stage begins"},
    {.table = "", .key = "accuracy", .type = table, .holds = {"accuracy"},
     .meaning = "numerical settings by the accuracy that is wanted"},
    {.table = "", .key = "contact", .type = table, .holds = {"contact"},
     .meaning = "how contacts between blocks are found"},
    {.table = "", .key = "damping", .type = table, .holds = {"damping"},
     .meaning = "damping of every stage that does not state its own"},
    {.table = "", .key = "time", .type = table, .holds = {"time"},
     .meaning = "the time step"},
    {.table = "", .key = "equilibrium", .type = table, .holds = {"equilibrium"},
     .meaning = "when a scene counts as at rest"},
    {.table = "", .key = "slicing", .type = table, .holds = {"slicing"},
     .meaning = "limits of cutting"},
    {.table = "", .key = "stage", .type = tables, .holds = {"stage"},
     .meaning = "what happens, in this order; at least one"},
    {.table = "", .key = "monitors", .type = tables, .holds = {"monitors", "selector"},
     .meaning = "quantities followed in history.csv: of one block that a selector chooses, or of a joint's contacts"},
    {.table = "", .key = "output", .type = table, .holds = {"output"},
     .meaning = "how often results are written"},

    // ---- geometry
    {.table = "domain", .key = "box", .type = table, .holds = {"box"},
     .meaning = "a box along the axes"},
    {.table = "domain", .key = "planes", .type = tables, .holds = {"label", "domain.planes"},
     .meaning = "planes that bound the domain, with the box or without it"},
    {.table = "box", .key = "min", .type = vector, .unit = "m", .range = sane, .example = "[-4, -4, -4]",
     .required = true, .meaning = "lowest corner"},
    {.table = "box", .key = "max", .type = vector, .unit = "m", .range = sane, .example = "[4, 4, 0]", .required = true,
     .meaning = "highest corner"},
    {.table = "domain.planes", .key = "dip", .unit = "deg", .range = dip_range, .usual = usual_dip, .example = "70",
     .required = true,
     .meaning = "angle below the horizontal", .repair = dip_repair, .slip = angle_slip},
    {.table = "domain.planes", .key = "dip_direction", .unit = "deg", .range = direction_range,
     .usual = usual_direction, .example = "155",
     .meaning = dip_direction_meaning, .repair = direction_repair, .slip = angle_slip},
    {.table = "domain.planes", .key = "point", .type = vector, .unit = "m", .range = sane, .example = "[0, 0, 0]",
     .required = true, .meaning = "any point of the plane"},
    {.table = "domain.planes", .key = "keep", .type = choice, .example = "\"below\"", .required = true,
     .choices = {"below", "above"}, .meaning = "the side of the plane that belongs to the domain"},
    {.table = "joints", .key = "name", .type = name, .example = "\"A\"", .required = true,
     .meaning = "unique among the joints"},
    {.table = "joints", .key = "dip", .unit = "deg", .range = dip_range, .usual = usual_dip, .example = "40",
     .required = true,
     .meaning = "angle below the horizontal", .repair = dip_repair, .slip = angle_slip},
    {.table = "joints", .key = "dip_direction", .unit = "deg", .range = direction_range, .usual = usual_direction,
     .example = "130",
     .meaning = dip_direction_meaning, .repair = direction_repair, .slip = angle_slip},
    {.table = "joints", .key = "point", .type = vector, .unit = "m", .range = sane, .example = "[0, 0, 0]",
     .required = true, .meaning = "any point of the joint"},
    {.table = "joints", .key = "properties", .type = name, .example = "\"rock\"",
     .meaning = "name of a joint_properties table; may be left out where only one exists or one is named `default`"},
    {.table = "joint_properties", .key = "name", .type = name, .example = "\"rock\"", .required = true,
     .meaning = "unique among the joint properties"},
    {.table = "joint_properties", .key = "normal_stiffness", .unit = "Pa/m", .range = stiffness,
     .usual = usual_stiffness, .example = "10e9",
     .required = true, .meaning = "normal stress per overlap (N/m with constant_stiffness)",
     .breaks = "too soft: blocks sink into each other; too stiff: the time step shrinks with its square root",
     .slip = stiffness_slip},
    {.table = "joint_properties", .key = "shear_stiffness", .unit = "Pa/m", .range = stiffness,
     .usual = usual_stiffness, .example = "1e9",
     .required = true, .meaning = "shear stress per slip before sliding (N/m with constant_stiffness)",
     .slip = stiffness_slip},
    {.table = "joint_properties", .key = "friction_deg", .unit = "deg", .range = friction_range,
     .usual = usual_friction, .example = "35",
     .required = true, .meaning = "friction angle", .repair = "give the angle, not its tangent, below 90 degrees",
     .slip = friction_slip},
    {.table = "joint_properties", .key = "constant_stiffness", .type = boolean, .fallback = "false", .example = "true",
     .meaning = "the stiffness is in N/m whatever the contact area, which then is never computed"},
    {.table = "joint_properties", .key = "sub_contacts", .type = integer, .range = {1, 64}, .fallback = "1",
     .example = "4",
     .meaning = "points that carry a joint face, along each of its directions (4: 4 in 2-D, 4 x 4 in 3-D); 1: the "
         "contact point alone",
     .breaks = "with one point a face resists neither spin nor, as a face does, rocking; each more costs time"},
    {.table = "joint_properties", .key = "normal_law", .type = choice, .fallback = "\"constant\"",
     .example = "\"linear\"", .choices = {"constant", "linear", "power"},
     .meaning = "normal stiffness kn against normal stress σ; constant: kn = normal_stiffness; linear: normal_stiffness + "
         "normal_growth σ, so that σ = normal_stiffness / normal_growth (exp(normal_growth u) - 1) at overlap u; power: "
         "normal_stiffness (σ / 1 Pa)^normal_exponent, the stiffness then being that at 1 Pa",
     .breaks = "stiffness grows with load, and the time step shrinks with its square root"},
    {.table = "joint_properties", .key = "normal_growth", .unit = "1/m", .range = positive, .usual = {100, 1e6},
     .example = "7.4e4", .required = true, .when = {"normal_law", "linear"},
     .meaning = "gain of normal stiffness per normal stress"},
    {.table = "joint_properties", .key = "normal_exponent", .unit = "1", .range = {0, 1, true, true},
     .usual = {0.1, 0.95},
     .example = "0.75", .required = true, .when = {"normal_law", "power"},
     .meaning = "power of the normal stress", .repair = "at 1 and above no stress ever builds up from none"},
    {.table = "joint_properties", .key = "shear_law", .type = choice, .fallback = "\"constant\"",
     .example = "\"linear\"", .choices = {"constant", "linear", "power"},
     .meaning = "shear stiffness ks against normal stress σ; constant: ks = shear_stiffness; linear: shear_stiffness + "
         "shear_growth σ; power: shear_stiffness (σ / 1 Pa)^shear_exponent",
     .breaks = "makes or loses energy where the stress changes under shear: `stiffening` in the energy table"},
    {.table = "joint_properties", .key = "shear_growth", .unit = "1/m", .range = positive, .usual = {100, 1e6},
     .example = "9.7e4", .required = true, .when = {"shear_law", "linear"},
     .meaning = "gain of shear stiffness per normal stress"},
    {.table = "joint_properties", .key = "shear_exponent", .unit = "1", .range = {0, 2, true}, .usual = {0.1, 1.5},
     .example = "0.7", .required = true, .when = {"shear_law", "power"},
     .meaning = "power of the normal stress"},
    {.table = "joint_properties", .key = "friction_law", .type = choice, .fallback = "\"constant\"",
     .example = "\"softening\"", .choices = {"constant", "hardening", "softening"},
     .meaning = "friction coefficient μ against accumulated plastic slip β; constant: tan(friction_deg); hardening: "
         "tan(friction_deg) (1 - exp(-β / up)), up = hardening_slip_m (σ / 1 Pa)^hardening_exponent; softening: "
         "tan(friction_deg) - softening_drop (1 - exp(-β / softening_slip_m)); strength reduction changes friction_deg",
     .breaks = "friction that falls faster than the shear spring unloads snaps back: counted as snap_backs"},
    {.table = "joint_properties", .key = "hardening_slip_m", .unit = "m", .range = positive, .usual = {1e-8, 1e-4},
     .example = "2e-6", .required = true, .when = {"friction_law", "hardening"},
     .meaning = "plastic slip in which friction gains 63 % of its last value, at a normal stress of 1 Pa"},
    {.table = "joint_properties", .key = "hardening_exponent", .unit = "1", .range = {0, 2},
     .usual = {.low = 0.01, .high = 1, .or_zero = true}, .fallback = "0",
     .example = "0.213", .when = {"friction_law", "hardening"},
     .meaning = "power of the normal stress with which that slip grows"},
    {.table = "joint_properties", .key = "softening_drop", .unit = "1", .range = {0, 100, true}, .usual = {5e-3, 2},
     .example = "0.059266", .required = true, .when = {"friction_law", "softening"},
     .meaning = "friction coefficient lost in the end", .slip = "was it given in degrees?"},
    {.table = "joint_properties", .key = "softening_slip_m", .unit = "m", .range = positive, .usual = {2e-4, 10},
     .example = "0.35", .required = true, .when = {"friction_law", "softening"},
     .meaning = "plastic slip in which 63 % of it is lost"},
    {.table = "joint_properties", .key = "tension", .unit = "Pa", .range = not_negative,
     .usual = {.low = 1e3, .high = 2e7, .or_zero = true}, .fallback = "0",
     .example = "0.076e6",
     .meaning = "tensile strength of bonded joints, which lasts until the bond breaks by tension or slip; the overlap at "
         "which there is no stress moves to tension / normal_stiffness, and stays there",
     .breaks = "counts only where a stage has made bonds (stage.bond)", .slip = "was it given in MPa?"},
    {.table = "joint_properties", .key = "cohesion", .unit = "Pa", .range = not_negative,
     .usual = {.low = 1e3, .high = 1e8, .or_zero = true}, .fallback = "0",
     .example = "0.787e6",
     .meaning = "cohesion of bonded joints, which lasts until the bond breaks by tension or slip",
     .breaks = "counts only where a stage has made bonds (stage.bond)", .slip = "was it given in MPa?"},
    {.table = "blocks", .key = "name", .type = name, .example = "\"slider\"", .required = true,
     .meaning = "unique among the blocks"},
    {.table = "blocks", .key = "vertices", .type = points, .unit = "m", .range = sane,
     .example = "[[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1]]",
     .meaning = "all corners of a convex block, in any order"},
    {.table = "blocks", .key = "planes", .type = tables, .holds = {"blocks.planes"},
     .meaning = "the half-spaces `normal · x <= offset` that the block lies in"},
    {.table = "blocks", .key = "box", .type = table, .holds = {"box"},
     .meaning = "a box along the axes"},
    {.table = "blocks", .key = "part_of", .type = name, .example = "\"slider\"",
     .meaning = "another block: both are convex parts of one rigid body, which has that block's name, density and motion"},
    {.table = "blocks", .key = "density", .unit = "kg/m³", .range = positive, .usual = usual_density, .example = "2500",
     .meaning = "replaces the scene's density", .repair = "rock has 2000 to 3000 kg/m³", .slip = density_slip},
    {.table = "blocks", .key = "velocity", .type = vector, .unit = "m/s", .range = sane, .usual = usual_speed,
     .example = "[0, 0, -1]",
     .meaning = "when the first stage begins; at rest without it"},
    {.table = "blocks", .key = "angular_velocity", .type = spin, .unit = "rad/s", .range = sane,
     .usual = usual_speed, .example = "[0, 0, 1]",
     .meaning = "when the first stage begins, world axes; in 2-D one number, counter-clockwise"},
    {.table = "blocks", .key = "fixed", .type = boolean, .fallback = "false", .example = "true",
     .meaning = "the block never moves"},
    {.table = "blocks.planes", .key = "normal", .type = vector, .range = sane, .example = "[0, 0, 1]", .required = true,
     .meaning = "outward normal, of any length but zero"},
    {.table = "blocks.planes", .key = "offset", .unit = "m", .range = sane, .example = "1",
     .meaning = "`normal · x` on the plane, for the normal as given"},
    {.table = "blocks.planes", .key = "point", .type = vector, .unit = "m", .range = sane, .example = "[0, 0, 1]",
     .meaning = "any point of the plane, instead of offset; keeps its digits far from the origin"},

    // ---- choosing blocks, and what is done to them
    {.table = "label", .key = "name", .type = name, .example = "\"base\"",
     .meaning = "so that --set can address this table by name; otherwise by its number, from 1"},
    {.table = "selector", .key = "all", .type = boolean, .fallback = "false", .example = "true",
     .meaning = "every block"},
    {.table = "selector", .key = "bodies", .type = names, .example = "[\"slider\"]",
     .meaning = "blocks of these names"},
    {.table = "selector", .key = "above", .type = names, .example = "[\"A\", \"B\"]",
     .meaning = "blocks whose centroid lies above all these joints (on the side of the upward normal; to the side it "
         "dips to where the joint is vertical)"},
    {.table = "selector", .key = "below", .type = names, .example = "[\"A\"]",
     .meaning = "blocks whose centroid lies below all these joints"},
    {.table = "selector", .key = "inside", .type = vector, .unit = "m", .range = sane, .example = "[0.5, 0.5, -1]",
     .meaning = "the block that holds this point"},
    {.table = "restrain", .key = "translation", .type = axes, .example = "[\"x\", \"y\"]",
     .meaning = "directions without movement; true: all"},
    {.table = "restrain", .key = "rotation", .type = axes, .example = "true",
     .meaning = "axes without rotation; true: all (2-D: only true)"},
    {.table = "motion", .key = "velocity", .type = vector, .unit = "m/s", .range = sane, .usual = usual_speed,
     .example = "[0, 0, -1]",
     .meaning = "velocity of the centroid"},
    {.table = "motion", .key = "angular_velocity", .type = spin, .unit = "rad/s", .range = sane,
     .usual = usual_speed, .example = "[0, 0, 1]",
     .meaning = "world axes; in 2-D one number, counter-clockwise"},

    // ---- numerical choices: the defaults are those of core/settings.hpp, which a test compares
    {.table = "accuracy", .key = "level", .type = choice, .example = "\"balanced\"", .required = true,
     .choices = {"fast", "balanced", "reference"},
     .meaning = "sets what the scene does not state itself: tolerances of a reduction, its ramps, rest and the time step, "
         "as the cases' studies found them to keep an error of 5 %, 1 % or 0.1 %"},
    {.table = "contact", .key = "lp", .type = choice, .fallback = "\"own\"", .example = "\"glpk\"",
     .choices = {"own", "glpk"}, .meaning = "solver of the linear program that tells whether two blocks overlap",
     .breaks = "glpk is slow, a reference only"},
    {.table = "contact", .key = "centre", .type = choice, .fallback = "\"own\"", .example = "\"ipopt\"",
     .choices = {"own", "ipopt", "ipopt_scaled"},
     .meaning = "solver of the analytic centre; ipopt: scaled by the overlap's own shape; ipopt_scaled: turned into the "
         "contact normal's frame and scaled along it",
     .breaks = "Ipopt is slow, a reference only; where it is built in, it also answers when our own search fails"},
    {.table = "contact", .key = "point", .type = choice, .fallback = "\"analytic_centre\"", .example = "\"chebyshev\"",
     .choices = {"analytic_centre", "centroid", "chebyshev"},
     .meaning = "where in the overlap the contact acts: at its analytic centre, its centroid, or the centre of the "
         "largest ball in it",
     .breaks = "the centroid costs more; the Chebyshev point is cheaper but jumps"},
    {.table = "contact", .key = "overlap", .type = choice, .fallback = "\"closed_form\"", .example = "\"bracketing\"",
     .choices = {"closed_form", "bracketing"}, .meaning = "how the ends of the overlap along the normal are found",
     .breaks = "bracketing is slow, a reference only"},
    {.table = "contact", .key = "tolerance", .unit = "1", .range = {0, 1e-3},
     .usual = {.low = 1e-14, .high = 5e-11, .or_zero = true}, .fallback = "0", .example = "1e-12",
     .meaning = "two blocks touch when they overlap by more than this times the smaller inscribed radius, and by more than "
         "rounding hides (at most 64 ulp of the pair's size)",
     .breaks = "below 1e-14 rounding hides it; far above, contacts are found late"},
    {.table = "contact", .key = "potential_radius", .unit = "1", .range = {0, 1, true}, .usual = {1e-3, 0.2},
     .fallback = "0.02",
     .example = "0.01", .meaning = "rounding of edges for the contact normal, times the smaller inscribed radius",
     .breaks = "must exceed the overlap; large values tilt the normal of face contacts near an edge"},
    {.table = "contact", .key = "newton_tolerance", .unit = "1", .range = {0, 0.1, true}, .usual = {1e-10, 1e-3},
     .fallback = "1e-5",
     .example = "1e-8", .meaning = "the search for the centre stops when its decrement is below this",
     .breaks = "1e-3 leaves 1e-6 of the overlap, 1e-5 leaves 1e-9; 0.1 leaves visible noise"},
    {.table = "contact", .key = "newton_limit", .type = integer, .unit = "1", .range = {1, 1e6}, .usual = {20, 1e4},
     .fallback = "200",
     .example = "400", .meaning = "largest number of iterations of that search",
     .breaks = "a search that needs more ends the run as failed"},
    {.table = "contact", .key = "skin", .unit = "1", .range = {0, 100, true}, .usual = {0.01, 2}, .fallback = "0.1",
     .example = "0.2",
     .meaning = "blocks closer than this times the smallest inscribed radius are kept in the list of neighbours",
     .breaks = "changes the cost, never the result"},
    {.table = "damping", .key = "statics", .type = choice, .fallback = "\"adaptive\"", .example = "\"local\"",
     .choices = {"adaptive", "local"},
     .meaning = "how settle stages and the trials of a reduction come to rest; adaptive: dynamic relaxation, by the fewest "
         "steps, in which inertia, time and velocities are fictitious and the other keys of this table mean nothing; "
         "local: the true motion, damped by the other keys, as in the thesis",
     .breaks = "adaptive is for what is nearly at rest; where the way to rest is an event, as in a fall, choose local"},
    {.table = "damping", .key = "local", .unit = "1", .range = share,
     .usual = {.low = 0.01, .high = 0.95, .or_zero = true}, .fallback = "0.7", .example = "0",
     .meaning = "share by which each force component is lessened when it drives the motion (Cundall); a stage's "
         "damping table takes what it leaves out from the scene's", .repair = "0 for dynamics, 0.7 to reach rest",
     .breaks = "0 never comes to rest by itself; above 0.9 failure is delayed"},
    {.table = "damping", .key = "viscous_ratio", .unit = "1", .range = {0, 10},
     .usual = {.low = 1e-3, .high = 1, .or_zero = true}, .fallback = "0", .example = "0.1",
     .meaning = "dashpot normal to every contact, as a share of critical damping",
     .breaks = "large values shorten the time step"},
    {.table = "time", .key = "fraction", .unit = "1", .range = {0, 1, true}, .usual = {1e-3, 0.5}, .fallback = "0.2",
     .example = "0.1",
     .meaning = "time step as a share of the stability limit",
     .breaks = "above 0.2 (0.1 without damping) contacts that open and close gain energy"},
    {.table = "time", .key = "step_s", .unit = "s", .range = {0, 1e9, true}, .usual = {5e-7, 0.02}, .example = "1e-4",
     .meaning = "a fixed time step instead of the estimate",
     .breaks = "needed where no block ever touches; unstable above the limit", .slip = "was it given in ms or µs?"},
    {.table = "equilibrium", .key = "unbalanced", .unit = "1", .range = {0, 1, true}, .usual = {1e-8, 1e-5},
     .fallback = "1e-6", .example = "1e-7",
     .meaning = "at rest when for every free block unbalanced force and momentum stay below this share of the mean "
         "contact force", .breaks = "too loose: a slow slide passes as rest"},
    {.table = "equilibrium", .key = "window", .type = integer, .unit = "steps", .range = {1, 1e6},
     .usual = {2, 1000}, .fallback = "10",
     .example = "50", .meaning = "number of steps in a row that must be at rest"},
    {.table = "slicing", .key = "smallest_inscribed_radius", .unit = "m", .range = not_negative,
     .usual = {.low = 1e-3, .high = 5, .or_zero = true}, .fallback = "0",
     .example = "0.01", .meaning = "a cut that would leave a smaller block is not made in that block",
     .breaks = "slivers shorten the time step", .slip = "was it given in mm?"},

    // ---- stages
    {.table = "stage", .key = "name", .type = name, .example = "\"settle\"", .required = true,
     .meaning = "unique among the stages"},
    {.table = "stage", .key = "kind", .type = choice, .example = "\"settle\"", .required = true,
     .choices = {"settle", "run", "reduce"},
     .meaning = "settle: until at rest; run: for a given time; reduce: lower the friction until the model fails"},
    {.table = "stage", .key = "gravity_ramp_s", .unit = "s", .range = {0, 1e9}, .usual = usual_ramp, .fallback = "0",
     .example = "0.5",
     .when = {"kind", "settle|run"}, .meaning = "gravity grows from none to full within this time",
     .breaks = "0 loads the joints dynamically, to twice their weight without damping", .slip = "was it given in ms?"},
    {.table = "stage", .key = "gravity_to", .unit = "1", .range = {0, 1e6}, .usual = usual_factor, .example = "2",
     .when = {"kind", "settle|run"},
     .meaning = "multiple of the scene's gravity that acts at the end of the ramp, which then begins at what acted in the "
         "stage before, or at once where there is no ramp. Without it a ramp goes from none to 1, and a stage without "
         "ramp leaves gravity as it is"},
    {.table = "stage", .key = "time_limit_s", .unit = "s", .range = {0, 1e9, true}, .usual = {0.1, 1e4},
     .fallback = "1e9", .example = "60",
     .when = {"kind", "settle"}, .meaning = "gives up when not at rest by then", .slip = "was it given in ms?"},
    {.table = "stage", .key = "step_limit", .type = integer, .unit = "steps", .range = count, .usual = {1e4, 1e8},
     .fallback = "1000000", .example = "2000000", .when = {"kind", "settle|reduce"},
     .meaning = "gives up when not at rest after so many steps (reduce: in one trial)"},
    {.table = "stage", .key = "duration_s", .unit = "s", .range = {0, 1e9, true}, .usual = {0.01, 1000},
     .example = "2", .required = true,
     .when = {"kind", "run"}, .meaning = "simulated time", .slip = "was it given in ms?"},
    {.table = "stage", .key = "method", .type = choice, .fallback = "\"bisection\"", .example = "\"steps\"",
     .when = {"kind", "reduce"}, .choices = {"bisection", "steps", "rate", "two_rates"},
     .meaning = "bisection: halve the bracket, each trial from the last stable state; steps: lower in steps, each to "
         "rest; rate: lower continuously; two_rates: the same twice from one equilibrium, extrapolated to no rate"},
    {.table = "stage", .key = "joint_properties", .type = names, .example = "[\"rock\"]", .when = {"kind", "reduce"},
     .meaning = "the properties whose friction is lowered; all without it"},
    {.table = "stage", .key = "from_deg", .unit = "deg", .range = friction_range, .usual = usual_friction,
     .example = "60", .required = true,
     .when = {"kind", "reduce"}, .meaning = "friction angle at the start; the model must be stable there",
     .slip = friction_slip},
    {.table = "stage", .key = "to_deg", .unit = "deg", .range = friction_range, .usual = {1, 85}, .example = "5",
     .required = true,
     .when = {"kind", "reduce"}, .meaning = "friction angle at which the search ends", .slip = friction_slip},
    {.table = "stage", .key = "tolerance_deg", .unit = "deg", .range = {0, 90, true}, .usual = {5e-4, 5},
     .example = "0.01",
     .required = true, .when = {"method", "bisection"}, .meaning = "largest bracket at the end"},
    {.table = "stage", .key = "step_deg", .unit = "deg", .range = {0, 90, true}, .usual = {0.02, 5},
     .example = "0.5", .required = true,
     .when = {"method", "steps"}, .meaning = "decrement"},
    {.table = "stage", .key = "rate_deg_per_s", .unit = "deg/s", .range = {0, 1e6, true}, .usual = {1e-3, 1},
     .example = "0.025",
     .required = true, .when = {"method", "rate|two_rates"}, .meaning = "speed of reduction; two_rates: the faster one",
     .breaks = "too fast: failure is found late, by the power 2/3 of the rate"},
    {.table = "stage", .key = "slower_rate_deg_per_s", .unit = "deg/s", .range = {0, 1e6, true}, .usual = {1e-3, 1},
     .example = "0.02",
     .required = true, .when = {"method", "two_rates"}, .meaning = "the slower speed of reduction",
     .breaks = "close to the faster one: the extrapolation magnifies small differences"},
    {.table = "stage", .key = "failure_displacement", .unit = "m", .range = not_negative,
     .usual = {.low = 1e-4, .high = 1, .or_zero = true}, .fallback = "0", .example = "0.01", .when = {"kind", "reduce"},
     .meaning = "a block that has moved this far since the search began (rate, two_rates: since the fall began) has "
         "failed; 0: a tenth of the smallest inscribed radius of the free blocks",
     .breaks = "must exceed the elastic settlement; too large: trials take long", .slip = "was it given in mm?"},
    {.table = "stage", .key = "ramp_steps", .type = integer, .unit = "steps", .range = count, .usual = {20, 1e5},
     .fallback = "500", .example = "2000", .when = {"method", "bisection|steps|two_rates"},
     .meaning = "number of steps over which a trial lowers the friction; two_rates: before the slower one",
     .breaks = "too few: the inertia of the change breaks the path"},
    {.table = "stage", .key = "damping", .type = table, .holds = {"damping"},
     .meaning = "replaces the scene's damping within this stage"},
    {.table = "stage", .key = "fix", .type = tables, .holds = {"label", "selector"},
     .meaning = "blocks fixed before the stage begins"},
    {.table = "stage", .key = "release", .type = tables, .holds = {"label", "selector"},
     .meaning = "blocks set free before the stage begins"},
    {.table = "stage", .key = "remove", .type = tables, .holds = {"label", "selector"},
     .meaning = "blocks excavated before the stage begins"},
    {.table = "stage", .key = "move", .type = tables, .when = {"kind", "run"},
     .holds = {"label", "motion", "move", "selector"},
     .meaning = "blocks whose motion is prescribed while the stage lasts, whatever the load on them; their other "
         "freedoms stay as they are, those of a fixed block are held. Afterwards a fixed block stands, a free one goes on"},
    {.table = "stage", .key = "boundary", .type = tables, .holds = {"label", "boundary", "selector"},
     .meaning = "stress on the outer faces of blocks, those that no joint made, from this stage on; it replaces what the "
         "blocks bore before"},
    {.table = "stage", .key = "friction_deg", .unit = "deg", .range = friction_range, .usual = usual_friction,
     .example = "30",
     .meaning = "friction angle of every joint from this stage on", .slip = friction_slip},
    {.table = "stage", .key = "bond", .type = boolean, .fallback = "false", .example = "true",
     .meaning = "before the stage begins, all joints under compression whose properties state tension or cohesion are "
         "bonded; a bond breaks once, by tension or slip"},

    {.table = "boundary", .key = "stress", .type = numbers, .unit = "Pa", .range = sane,
     .example = "[50e3, 50e3, 0, 0, 0, 0]", .required = true,
     .meaning = "compression positive, world axes: xx, yy, zz, yz, zx, xy; in 2-D xx, yy, xy. The force on each face keeps "
         "size and direction while the block moves",
     .breaks = "needs blocks or fixed rock to push against"},
    {.table = "move", .key = "translation", .type = axes, .fallback = "true", .example = "[\"x\"]",
     .meaning = "directions along which the velocity is prescribed; true: all. Along the others the block is as free as "
         "without it"},
    {.table = "move", .key = "times_s", .type = numbers, .unit = "s", .range = {0, 1e9}, .example = "[0, 0.1, 1]",
     .meaning = "times since the stage began, ascending, at which `factors` are given"},
    {.table = "move", .key = "factors", .type = numbers, .range = sane, .example = "[0, 1, 1]",
     .meaning = "what the velocities are multiplied by at `times_s`: linear in between, constant before and after"},
    {.table = "move", .key = "frequency_hz", .unit = "Hz", .range = {0, 1e9, true}, .usual = {0.01, 500},
     .example = "2",
     .meaning = "the velocities are multiplied by sin(2π frequency_hz t + phase_deg), t since the stage began; times the "
         "factors where both are given",
     .breaks = "needs some twenty steps a period", .slip = "was the period given?"},
    {.table = "move", .key = "phase_deg", .unit = "deg", .range = {-360, 360}, .usual = usual_direction, .fallback = "0",
     .example = "90", .meaning = "of that sine: 90 begins at full velocity", .slip = angle_slip},

    // ---- what is written
    {.table = "monitors", .key = "name", .type = name, .example = "\"wedge\"", .required = true,
     .meaning = "unique among the monitors; begins its columns in history.csv"},
    {.table = "monitors", .key = "quantities", .type = choices, .example = "[\"displacement\", \"rotation\"]",
     .required = true, .choices = {"displacement", "velocity", "rotation", "angular_velocity", "contact_load",
                                  "contact_force"},
     .meaning = "contact_force: resultant over the contacts of a joint, which `joint` names; the others: of one block, "
         "which a selector chooses; contact_load: what all contacts exert on the block"},
    {.table = "monitors", .key = "joint", .type = name, .example = "\"A\"",
     .meaning = "joint of contact_force"},
    {.table = "output", .key = "history_interval_s", .unit = "s", .range = {0, 1e9},
     .usual = {.low = 1e-6, .high = 5, .or_zero = true}, .fallback = "0", .example = "0.01",
     .meaning = "time between rows of history.csv; 0: about 200 rows a stage", .slip = "was it given in ms?"},
    {.table = "output", .key = "frame_interval_s", .unit = "s", .range = {0, 1e9},
     .usual = {.low = 5e-4, .high = 50, .or_zero = true}, .fallback = "0", .example = "0.1",
     .meaning = "time between ParaView frames; 0: at the end of each stage only", .slip = "was it given in ms?"},
    {.table = "output", .key = "frames", .type = boolean, .fallback = "true", .example = "false",
     .meaning = "write ParaView frames"},

};
// clang-format on
}  // namespace

std::span<const KeyRow> key_rows() {
  return rows;
}

}  // namespace voussoir
