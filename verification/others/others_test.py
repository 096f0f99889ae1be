"""The harness without engines: what a problem expands to, how paths are measured, how a search ends, how an answer is judged."""
import json
import math
import os
import sys
import tempfile
import unittest

try:
    import numpy as np
    import scipy.optimize  # noqa: F401, read by overlap
except ImportError:
    print("not tested: python3-numpy or python3-scipy is not installed")
    sys.exit(1 if os.environ.get("VOUSSOIR_NO_SKIP") == "1" else 77)

import answer
import choose
import engines
import overlap
import run
import score
import table
from measure import Path, accelerates, bisect, falls, gets_faster
from problem import CannotState, Problem, bonded_faces, mass_properties, matrix_of, quaternion_of, turn_matrix
from scene import force_at, gravity_at, read_scene, scene_text, turned

G = 9.81
FACES = [[0, 4, 6, 2], [1, 3, 7, 5], [0, 1, 5, 4], [2, 6, 7, 3], [0, 2, 3, 1], [4, 5, 7, 6]]  # of box()


def box(low, high):
    return [[(low, high)[k & 1][0], (low, high)[k >> 1 & 1][1], (low, high)[k >> 2][2]] for k in range(8)]


def block(name, low, high, fixed=False, density=2000.0):
    low, high = np.array(low, float), np.array(high, float)
    lengths, centre = high - low, (low + high) / 2
    mass = density * lengths.prod()
    moments = mass / 12 * np.array([lengths[1]**2 + lengths[2]**2, lengths[0]**2 + lengths[2]**2, lengths[0]**2 + lengths[1]**2])
    corners = box(low, high)
    return dict(name=name, fixed=fixed, density_kg_m3=density, mass_kg=mass, centre_m=list(centre), quaternion_wxyz=[1, 0, 0, 0],
                moments_kg_m2=list(moments), box_m=list(lengths), vertices_m=corners,
                vertices_in_axes_m=[list(np.array(c) - centre) for c in corners],
                faces=[dict(normal=[0, 0, 0], offset_m=0, corners=f) for f in FACES], velocity_m_s=[0, 0, 0], spin_rad_s=[0, 0, 0])


def incline():
    blocks = [block("the slab", (-6, -3, -1), (6, 3, 0), True), block("cube", (-1, -.5, 0), (1, .5, 1))]
    return dict(name="incline", dimension=3, blocks=blocks,
                joints=[dict(blocks="all others", friction_deg=30.0, cohesion_Pa=0.0, tension_Pa=0.0,
                             stiff=dict(kn_Pa_per_m=1e11, ks_Pa_per_m=1e11), stated=dict(kn_Pa_per_m=1e9, ks_Pa_per_m=2e8))],
                gravity=[dict(time_s=0.0, g_m_s2=[0, 0, 0]), dict(time_s=1.0, g_m_s2=[0, 0, -G])], duration_s=3.5, output_s=0.05,
                search=dict(parameter="tilt_deg", lower=20.0, upper=40.0, tolerance=0.005, fails_at="upper",
                            acts=dict(kind="gravity direction", axis=[0, -1, 0])),
                criterion=dict(kind="accelerates", block="cube", times_s=[1.5, 2.5, 3.5], excess_m=5e-4, far_m=0.3),
                positions=[], variants=[], loads=[], bolts=[], asked=[dict(quantity="critical tilt", unit="deg", how="")])


def path(places):
    """of a block that is at x = places(t)"""
    return Path([[t, places(t), 0, 0, 1, 0, 0, 0, 0, 0, 0, 0, 0, 0] for t in np.arange(0, 3.51, 0.05)])


class Expansion(unittest.TestCase):
    def test_gravity_is_turned_and_grows(self):
        scene = Problem(incline()).scene(25.0)
        full = G * np.array([math.sin(math.radians(25)), 0, -math.cos(math.radians(25))])
        np.testing.assert_allclose(gravity_at(scene, 0.25), full / 4, atol=1e-12)
        np.testing.assert_allclose(gravity_at(scene, 7.0), full, atol=1e-12)

    def test_friction_acts_on_friction_alone(self):
        stated = incline()
        stated["search"]["acts"] = dict(kind="friction")
        self.assertAlmostEqual(Problem(stated).scene(45.0)["friction"], 1.0)
        self.assertAlmostEqual(Problem(stated).scene()["friction"], math.tan(math.pi / 6))

    def test_unknown_searches_are_refused(self):
        stated = incline()
        stated["search"]["acts"] = dict(kind="colour")
        with self.assertRaises(CannotState):
            Problem(stated).scene(1.0)

    def test_moved_vertices_give_a_new_mass_centre_and_box(self):
        stated = incline()
        lift = [[0, 0, 0 if v[2] == 0 else 1] for v in stated["blocks"][1]["vertices_m"]]
        stated["search"]["acts"] = dict(kind="vertices", at=1.0, change=dict(cube=lift))
        cube = Problem(stated).scene(3.0)["blocks"][1]
        self.assertAlmostEqual(cube["mass"], 2000 * 2 * 1 * 3)
        np.testing.assert_allclose(cube["centre"], [0, 0, 1.5], atol=1e-12)
        np.testing.assert_allclose(cube["box"], [2, 1, 3], atol=1e-12)
        np.testing.assert_allclose(cube["moments"], 12000 / 12 * np.array([10, 13, 5]), rtol=1e-12)

    def test_mass_properties_of_a_tetrahedron(self):
        corners = [[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1]]
        mass, centre, inertia = mass_properties(corners, [[0, 2, 1], [0, 1, 3], [0, 3, 2], [1, 2, 3]], 6.0)
        self.assertAlmostEqual(mass, 1.0)
        np.testing.assert_allclose(centre, [0.25] * 3)
        np.testing.assert_allclose(inertia, np.full((3, 3), 1 / 80) + np.eye(3) * (3 / 40 - 1 / 80))

    def test_a_turned_problem_is_the_same_problem(self):
        stated = incline()
        turn = quaternion_of(turn_matrix([1, 2, 3], 40))
        plain = Problem(stated).scene(20.0)
        other = Problem(stated).scene(20.0, position=dict(turn_wxyz=list(turn)))
        for a, b in zip(plain["blocks"], other["blocks"]):
            for v in a["vertices"]:
                before = a["centre"] + turned(a["turn"], v)
                np.testing.assert_allclose(b["centre"] + turned(b["turn"], v), turned(turn, before), atol=1e-12)
        np.testing.assert_allclose(gravity_at(other, 5), turned(turn, gravity_at(plain, 5)), atol=1e-12)

    def test_a_variant_replaces_what_it_states(self):
        stated = incline()
        stated["asked"].append(dict(quantity="at speed", unit="deg", how=""))
        stated["variants"] = [dict(name="at speed", quantities=["at speed"], velocities_m_s={"cube": [1, 0, 0]}, duration_s=2.0)]
        first, second = Problem(stated).variants()
        self.assertEqual([a["quantity"] for a in first.asked], ["critical tilt"])
        self.assertEqual([a["quantity"] for a in second.asked], ["at speed"])
        self.assertEqual(second.scene()["duration"], 2.0)
        self.assertEqual(list(second.scene()["blocks"][1]["velocity"]), [1, 0, 0])
        self.assertEqual(list(first.scene()["blocks"][1]["velocity"]), [0, 0, 0])

    def test_what_a_problem_needs(self):
        stated = incline()
        self.assertEqual(Problem(stated).needs(), set())  # prisms along y
        stated["gravity"][1]["g_m_s2"] = [0, 1, -G]
        stated["joints"][0]["tension_Pa"] = 1.0
        self.assertEqual(Problem(stated).needs(), {"space", "bond"})

    def test_loads_are_force_and_moment_and_grow(self):
        stated = incline()
        stated["loads"] = [dict(block="cube", force_N=[0, 0, 8], point_m=[1, 0, 0.5], times_s=[0, 2], factors=[0, 1])]
        scene = Problem(stated).scene()
        np.testing.assert_allclose(scene["forces"]["cube"], [0, 0, 8, 0, -8, 0])
        np.testing.assert_allclose(force_at(scene, "cube", 0.5), [0, 0, 2, 0, -2, 0])

    def test_the_text_is_read_back(self):
        scene = Problem(incline()).scene(21.0, stiffness="stated")
        read, settings = read_scene(scene_text(scene, dict(dt=0.001), springs=True).splitlines()[:-1])
        self.assertEqual(settings, dict(dt=0.001))
        self.assertEqual(read["joint"], [1e9, 2e8, 0, 0])
        self.assertEqual([b["name"] for b in read["blocks"]], ["the_slab", "cube"])
        for a, b in zip(scene["blocks"], read["blocks"]):
            np.testing.assert_array_equal(np.array(a["vertices"]), np.array(b["vertices"]))
            self.assertEqual((a["mass"], a["fixed"]), (b["mass"], b["fixed"]))
            for face in b["faces"]:  # every vertex is behind every plane, the face's own upon it
                heights = [np.dot(face["plane"][:3], v) - face["plane"][3] for v in b["vertices"]]
                self.assertLess(max(heights), 1e-12)
                self.assertLess(max(abs(heights[k]) for k in face["corners"]), 1e-12)


class Measurement(unittest.TestCase):
    def test_creep_is_no_failure_but_acceleration_and_distance_are(self):
        c = incline()["criterion"]
        self.assertFalse(accelerates({"cube": path(lambda t: 0.08 * t)}, c))
        self.assertTrue(accelerates({"cube": path(lambda t: max(0.0, t - 1)**2 * 3e-4)}, c))
        self.assertFalse(accelerates({"cube": path(lambda t: max(0.0, t - 1)**2 * 2e-4)}, c))
        self.assertTrue(accelerates({"cube": path(lambda t: 0.1 * t)}, c))

    def test_a_block_sent_off(self):
        c = dict(kind="gets faster", block="cube", times_s=[0.5, 1.0, 1.5], stopped_m=0.05)
        self.assertTrue(gets_faster({"cube": path(lambda t: t + 0.01 * t * t)}, c))
        self.assertFalse(gets_faster({"cube": path(lambda t: t - 0.01 * t * t)}, c))
        self.assertFalse(gets_faster({"cube": path(lambda t: 0.3 + 1e-9 * t * t)}, c))  # it has stopped
        self.assertTrue(gets_faster({"cube": path(lambda t: 0.3 + 1e-9 * t * t)}, dict(c, stopped_m=1e-10)))
        del c["stopped_m"]
        with self.assertRaisesRegex(ValueError, "lacks stopped_m"):
            gets_faster({"cube": path(lambda t: t)}, c)

    def test_any_block_may_fall(self):
        c = dict(kind="falls", block="any block", far_m=0.3)
        self.assertTrue(falls({"a": path(lambda t: 0), "b": path(lambda t: t)}, c))
        self.assertFalse(falls({"a": path(lambda t: 0), "b": path(lambda t: 0.01 * t)}, c))

    def test_bisection_brackets_the_change(self):
        for fails_at, fails in (("upper", lambda v: v > 30.1), ("lower", lambda v: v < 30.1)):
            found = bisect(fails, dict(lower=20.0, upper=40.0, tolerance=0.005, fails_at=fails_at))
            self.assertLess(abs(found.value - 30.1), 0.005)
            self.assertLessEqual(found.half_width, 0.0025)
            self.assertEqual(found.note, "")

    def test_a_search_without_a_change_says_so(self):
        search = dict(lower=20.0, upper=40.0, tolerance=0.005, fails_at="lower")
        self.assertIn("every value", bisect(lambda v: True, search).note)
        self.assertEqual(bisect(lambda v: True, search).value, 40.0)
        self.assertIn("no value", bisect(lambda v: False, search).note)
        self.assertEqual(bisect(lambda v: False, search).value, 20.0)

    def test_rotations(self):
        m = turn_matrix([0, 0, 1], 90)
        np.testing.assert_allclose(m @ [1, 0, 0], [0, 1, 0], atol=1e-15)
        np.testing.assert_allclose(matrix_of(quaternion_of(m)), m, atol=1e-14)


class ExactSlide:
    """in place of a process: a cube on a plane under the scene's full gravity, by its closed form"""

    def __init__(self, engine, breaks=False):
        self.engine, self.breaks, self.scenes = engine, breaks, 0

    def run(self, text):
        self.scenes += 1
        found = engines.Run()
        scene, _ = read_scene(text.splitlines()[:-1])
        gx, _, gz = scene["gravity"][-1][1:]
        a = max(0.0, gx - scene["friction"] * -gz)
        times = np.arange(0, scene["duration"] + 1e-9, scene["output"])
        found.rows = {"cube": [[t, a * t * t / 2, 0, 0, 1, 0, 0, 0, 0, 0, 0, 0, 0, 0] for t in times]}
        found.seconds, found.failure = 0.25, "the engine stopped" if self.breaks else None
        return found


class Answers(unittest.TestCase):
    rigid = engines.Engine("exact", "1", [], "rigid", engines.RIGID)

    def test_a_search_by_an_exact_code(self):
        process = ExactSlide(self.rigid)
        (found,) = answer.answers(Problem(incline()), process, {})
        self.assertLess(abs(found.value - 30.0), 0.01)
        self.assertAlmostEqual(found.seconds, 0.25 * process.scenes)

    def test_a_code_that_stops_has_no_value(self):
        (found,) = answer.answers(Problem(incline()), ExactSlide(self.rigid, breaks=True), {})
        self.assertIsNone(found.value)
        self.assertEqual(found.note, "the engine stopped")

    def test_what_cannot_be_stated_has_a_reason(self):
        stated = incline()
        stated["joints"][0]["cohesion_Pa"] = 1e6
        (found,) = answer.answers(Problem(stated), ExactSlide(self.rigid), {})
        self.assertEqual((found.value, found.note), ("cannot state", engines.WELD))

    def test_an_answer_file_is_what_the_judge_reads(self):
        with tempfile.TemporaryDirectory() as folder:
            path_of = os.path.join(folder, "answer.csv")
            run.write_answer(path_of, self.rigid, dict(dt=0.002), [answer.Answer("critical tilt", "deg", 30.02, 1.5),
                                                                   answer.Answer("other", "m", None, 0, "the engine stopped")], "_best")
            with open(path_of, encoding="utf-8") as file:
                self.assertEqual(file.read().splitlines(), [
                    "# code: exact_best 1", "# model: rigid", "# setting: dt=0.002", "quantity,unit,value,seconds,note",
                    "critical tilt,deg,30.02,1.5,", "other,m,,,the engine stopped"])

    def test_the_table_shows_what_the_judge_says(self):
        head = "problem,quantity,unit,code,verdict,value,lower,upper,error,tolerance,seconds,note"
        lines = [head, "incline,tilt,deg,bullet 3.24,FAILED,30.5,30,30,0.5,0.01,0.2,", "incline,tilt,deg,jolt 1.1,passed,30,30,30,0,0.01,1,",
                 "incline,tilt,deg,ode 1,not run,,,,,,,the engine stopped", "incline,tilt,deg,rapier 1,not run,,,,,,,",
                 "incline,tilt,deg,box2d 1,cannot state,,,,,,,plane"]
        ((problem, name, unit, found),) = table.judged_rows(lines)
        self.assertEqual((problem, name, unit), ("incline", "tilt", "deg"))
        self.assertEqual({c: one.words() for c, one in found.items()},
                         {"bullet": "30.5, FAIL +0.5, 0.2 s", "jolt": "30, pass, 1 s", "ode": "stopped", "rapier": "not run",
                          "box2d": "cannot state"})


def cuboid(name, centre, turn, lengths, fixed=False):
    """of a scene: a box by its planes in its own axes"""
    corners = [[sx * lengths[0] / 2, sy * lengths[1] / 2, sz * lengths[2] / 2] for sx in (-1, 1) for sy in (-1, 1) for sz in (-1, 1)]
    faces = [dict(plane=[*(s * np.eye(3)[k]), lengths[k] / 2]) for k in range(3) for s in (-1, 1)]
    return dict(name=name, fixed=fixed, centre=np.array(centre, float), turn=np.array(turn, float), vertices=np.array(corners), faces=faces)


class Overlap(unittest.TestCase):
    floor = cuboid("floor", [0, 0, -0.5], [1, 0, 0, 0], [4, 4, 1], True)

    def test_a_cube_that_sinks_in(self):
        for depth in (1e-9, 2.5e-7, 1e-3):
            found = overlap.largest_overlap([self.floor, cuboid("cube", [0, 0, 0.5 - depth], [1, 0, 0, 0], [1, 1, 1])], {})
            self.assertAlmostEqual(found, depth, delta=1e-12)

    def test_an_edge_that_sinks_in(self):
        # the deepest point under the floor's plane and both planes of an edge of 90 deg: depth / (1 + root 2), twice
        turn = [math.cos(math.pi / 8), 0, math.sin(math.pi / 8), 0]
        cube = cuboid("cube", [0, 0, 0.5], [1, 0, 0, 0], [1, 1, 1])
        found = overlap.largest_overlap([self.floor, cube], {"cube": [0, 0, math.sqrt(0.5) - 1e-3, *turn]})
        self.assertAlmostEqual(found, 2e-3 / (1 + math.sqrt(2)), delta=1e-9)

    def test_a_gap_is_no_overlap_and_what_is_far_is_nothing(self):
        for height, expected in ((0.5005, 0.0), (0.6, None)):
            cube = cuboid("cube", [0, 0, height], [1, 0, 0, 0], [1, 1, 1])
            self.assertEqual(overlap.largest_overlap([self.floor, cube], {}), expected)

    def test_fixed_blocks_are_no_pair(self):
        self.assertIsNone(overlap.largest_overlap([self.floor, dict(self.floor, name="other")], {}))


class Bonds(unittest.TestCase):
    joint = [1e9, 2e8, 1e6, 3e5]

    def faces(self):
        wall, beam = block("wall", (-1, -0.5, -1), (0, 0.5, 1), True), block("beam", (0, -0.5, -0.25), (1, 0.5, 0.25))
        stated = dict(incline(), blocks=[wall, beam])
        return bonded_faces(Problem(stated).scene()["blocks"], self.joint)

    def test_springs_have_the_stiffness_of_the_face(self):
        (w,) = self.faces()
        self.assertEqual((w["block"], w["fixed"], w["strength"]), ("beam", "wall", 3e5))
        np.testing.assert_allclose([4 * w["kn"], 4 * w["ks"], w["area"]], [5e8, 1e8, 0.5])
        np.testing.assert_allclose(w["normal"], [1, 0, 0], atol=1e-12)
        points = np.array(w["points"])
        np.testing.assert_allclose(points.mean(0), 0, atol=1e-12)
        np.testing.assert_allclose((w["kn"] * points**2).sum(0), 1e9 * np.array([0, 0.5 / 12, 0.125 / 12]), rtol=1e-12)

    def test_only_codes_of_springs_read_them(self):
        scene = dict(Problem(incline()).scene(21.0), welds=self.faces())
        self.assertNotIn("weld", scene_text(scene, {}))
        (line,) = [t for t in scene_text(scene, {}, welds=True).splitlines() if t.startswith("weld")]
        self.assertEqual(len(line.split()), 1 + 2 + 4 + 3 + 12)

    def test_a_code_whose_welds_are_springs_is_judged_as_one_with_stiffness(self):
        engine = engines.Engine("welder", "1", [], "rigid", {}, welds=True)
        self.assertEqual([engine.model_for(n) for n in ({"bond"}, {"space"})], ["joint stiffness", "rigid"])
        self.assertEqual(Answers.rigid.model_for({"bond"}), "rigid")


class Choice(unittest.TestCase):
    bounds = [(10.0, 0.1), (12.0, 0.2)]

    def test_errors_in_tolerances(self):
        self.assertEqual(score.tolerances(11.0, self.bounds), 0)
        self.assertAlmostEqual(score.tolerances(9.5, self.bounds), 5)
        self.assertAlmostEqual(score.tolerances(12.4, self.bounds), 2)
        self.assertEqual(score.tolerances(1e9, self.bounds), score.MOST)
        self.assertEqual(score.tolerances(None, self.bounds), score.MOST)
        self.assertEqual(score.tolerances(float("nan"), self.bounds), score.MOST)

    @staticmethod
    def tally(*rows):
        found = choose.Tally()
        for error, seconds in rows:
            found.add(error, seconds)
        return found

    def test_an_error_within_its_tolerance_counts_nothing(self):
        found = self.tally((0.9, 2.0), (0.8, 2.0), (3.0, 5.0))
        self.assertEqual((found.sum, found.largest, found.seconds), (3.0, 3.0, 7.0))  # two of one run

    def test_least_errors_then_seconds(self):
        t = self.tally
        found = {"a": {"x": t((0.5, 9.0)), "y": t((0.9, 1.0)), "z": t((30.0, 0.1))},
                 "b": {"x": t((50.0, 1.0)), "y": t((4.0, 1.0)), "z": t((2.0, 1.0))}}
        one, best = choose.choose(found)
        self.assertEqual(one, "y")  # 0 + 4, against 0 + 50 and 30 + 2
        self.assertEqual(best, {"a": "y", "b": "z"})  # within the tolerance the quicker one

    def test_the_rock_mass_has_no_part_in_the_setting_for_everything(self):
        t = self.tally
        one, best = choose.choose({"a": {"x": t((2, 1)), "y": t((9, 1))}, "rock_mass": {"y": t((0, 1)), "z": t((5, 1))}})
        self.assertEqual((one, best["rock_mass"]), ("x", "y"))

    def test_settings_tried_on_fewer_problems_are_no_candidates_for_all(self):
        t = self.tally
        one, _ = choose.choose({"a": {"x": t((0, 1)), "y": t((9, 1))}, "b": {"y": t((9, 1))}})
        self.assertEqual(one, "y")


class Adapters(unittest.TestCase):
    def test_every_folder_has_a_grid_and_settings_of_its_own_sweep(self):
        for name in ("bullet", "ode", "box2d", "mujoco", "siconos", "rapier", "jolt", "voussoir"):
            folder = os.path.join(engines.HERE, name)
            tried = {}
            for row in choose.kept_rows(os.path.join(folder, "sweep.tsv")):
                tried.setdefault(row["problem"], []).append(choose.settings_of_text(row["setting"]))
            with open(os.path.join(folder, "settings.json"), encoding="utf-8") as file:
                chosen = json.load(file)
            self.assertTrue(any(chosen["one"] in settings for settings in tried.values()), name)
            for problem, best in chosen["best"].items():
                self.assertIn(best, tried[problem], name)

    def test_adapters_are_short(self):
        for folder, _, files in os.walk(engines.HERE):
            for file in files:
                if folder != engines.HERE and "node_modules" not in folder and file.endswith((".cpp", ".mjs", ".py")):
                    with open(os.path.join(folder, file), encoding="utf-8") as text:
                        self.assertLessEqual(len(text.readlines()), 150, file)


if __name__ == "__main__":
    unittest.main(verbosity=0)
