"""The Python module against the program: the same bits, and views, copies, errors and signals as its README states."""
import ast
import csv
import gc
import json
import os
import re
import signal
import subprocess
import sys
import tempfile
import textwrap
import threading
import time
import tomllib
import unittest
import xml.etree.ElementTree as ElementTree
from pathlib import Path

try:
    import numpy as np
except ImportError:
    print("skipped: numpy is not installed (Debian: python3-numpy)")
    sys.exit(77)
import voussoir
from frame_file import Frame

SOURCE, PROGRAM = Path(os.environ["VOUSSOIR_SOURCE_DIR"]), os.environ["VOUSSOIR_PROGRAM"]
WEDGE = SOURCE / "cases/wedge/scene.toml"  # 3-D, a search with rejected trials
TUNNEL = SOURCE / "app/testing/tunnel.toml"  # 2-D, bolts, an excavation that divides blocks
LINED = Path("lined_tunnel.toml")  # the same with a stage that adds bodies: setUpModule writes it
CUBES = SOURCE / "app/testing/two_cubes.toml"
FALL = SOURCE / "cases/free_fall/scene.toml"  # long


def results_of(folder):
    """results.json without machine and program"""
    results = json.loads((Path(folder) / "results.json").read_text())
    return {key: value for key, value in results.items() if key not in ("program", "timing", "warnings")}


def told(run):
    return {key: value for key, value in run.results.items() if key not in ("program", "timing", "warnings")}


def end_of(run, steps=1000):
    while run.advance(steps):
        pass
    return run


def setUpModule():
    """A folder for runs of the program, one for each scene, and for the files of tests."""
    global scratch, made
    folder = tempfile.TemporaryDirectory()
    unittest.addModuleCleanup(folder.cleanup)
    scratch, made = Path(folder.name), {}
    tree = tomllib.loads(TUNNEL.read_text())
    tree["linings"] = [{"name": "shell", "excavation": "tunnel", "joint_properties": "rock", "nodes": 12, "thickness": 0.1,
                        "young_modulus": 1e9, "density": 2400}]
    tree["stage"][2]["install"].append("shell")
    (scratch / LINED).write_text(voussoir.Scene(tree).toml)


def scene_of(path):
    return voussoir.Scene(scratch / path)  # an absolute path stays absolute


def program(path, *sets):
    key = (path, sets)
    if key not in made:
        folder = scratch / f"program_{len(made)}"
        options = [option for text in sets for option in ("--set", text)]
        subprocess.run([PROGRAM, "run", scratch / path, "--out", folder, "--quiet", *options], check=True)
        made[key] = folder
    return made[key]


class SameBits(unittest.TestCase):
    def test_any_portions_and_threads_end_in_the_program_s_results(self):
        for path in (WEDGE, TUNNEL, LINED):
            expected = results_of(program(path))
            for steps, threads in ((1, 1), (7, 2), (1000, 1)):
                with self.subTest(path.name, steps=steps):
                    run = end_of(scene_of(path).start(threads=threads), steps)
                    self.assertEqual(run.state_hash, expected["state_hash"])
                    self.assertEqual(told(run), expected)
                    self.assertTrue(run.done)
                    self.assertFalse(run.advance(10))
                    self.assertEqual(told(run), expected, "a finished run does not change")

    def test_advance_counts_steps_exactly(self):
        run = voussoir.Scene(WEDGE).start()
        for steps in (1, 7, 1000):
            before = run.state.steps
            self.assertTrue(run.advance(steps))
            self.assertEqual(run.state.steps, before + steps)

    def test_set_and_dict_are_the_scene_of_the_program(self):
        expected = results_of(program(WEDGE, "joints.A.dip=42.5", 'title="a \\"b\\" c"'))
        set_here = {"joints.A.dip": np.float64(42.5), "title": 'a "b" c'}
        scene = voussoir.Scene(WEDGE, set=set_here)
        self.assertEqual(scene.hash, expected["input_hash"])
        self.assertEqual(end_of(scene.start()).state_hash, expected["state_hash"])

        tree = tomllib.loads(WEDGE.read_text())
        self.assertEqual(voussoir.Scene(tree, set=set_here).hash, expected["input_hash"])
        tree["joints"][0]["dip"] = 42.5
        tree["title"] = 'a "b" c'
        tree["gravity"] = np.array([0, 0, -9.81])
        tree["joints"] = tuple(tree["joints"])
        self.assertEqual(voussoir.Scene(tree).hash, expected["input_hash"])
        self.assertEqual(voussoir.Scene(tomllib.loads(scene.toml)).hash, scene.hash)
        self.assertNotEqual(voussoir.Scene(WEDGE).hash, scene.hash)

    def test_links_the_core_alone(self):
        libraries = Path("/proc/self/maps").read_text()
        self.assertIn("voussoir", libraries)
        self.assertNotIn("glpk", libraries)


class Views(unittest.TestCase):
    def test_are_of_the_present_and_equal_the_history(self):
        scene = voussoir.Scene(WEDGE)
        run = scene.start()
        displacement, rotation, velocity = run.state.displacement, run.state.rotation, run.state.velocity
        self.assertEqual((displacement.shape, rotation.shape, velocity.shape), ((4, 3), (4, 3), (4, 3)))
        self.assertFalse(displacement.any())
        run.advance(100)
        self.assertTrue(displacement.any() and velocity.any(), "they follow the run")
        end_of(run)
        wedge = displacement.any(axis=1).argmax()
        for k, axis in enumerate("xyz"):
            self.assertEqual(run.history[f"wedge_displacement_{axis}_m"][-1], displacement[wedge, k])

        # turns, in space and in the plane
        path = SOURCE / "app/testing/turning_block.toml"
        run = voussoir.Scene(path, set={"monitors": [{"name": "top", "above": ["bedding-1"], "quantities": ["rotation"]}]})
        run = end_of(run.start())
        turned = np.degrees(run.state.rotation)
        self.assertGreater(np.linalg.norm(turned, axis=1).max(), 30)
        told_turn = [run.history[f"top_rotation_{axis}_deg"][-1] for axis in "xyz"]
        self.assertLess(np.abs(turned - told_turn).max(axis=1).min(), 1e-12 * 360)
        run = voussoir.Scene(TUNNEL, set={"monitors": [{"name": "top", "inside": [4, 7], "quantities": ["rotation"]}]})
        run = end_of(run.start())
        self.assertEqual(run.state.rotation.shape, (run.state.displacement.shape[0],))
        self.assertEqual(run.state.displacement.shape[1], 2)
        self.assertIn(run.history["top_rotation_deg"][-1], np.degrees(run.state.rotation))

    def test_survive_their_run_and_refuse_writing(self):
        scene = voussoir.Scene(WEDGE)
        run = scene.start()
        run.advance(500)
        views = [run.state.displacement, run.state.rotation, run.state.velocity]
        kept = [view.copy() for view in views]
        for view in views:
            self.assertFalse(view.flags.owndata or view.flags.writeable)
            with self.assertRaises(ValueError):
                view[0, 0] = 1
            with self.assertRaises(ValueError):
                view.flags.writeable = True
            self.assertFalse(view[1:].flags.writeable)
        self.assertTrue(np.shares_memory(views[0], run.state.displacement), "no copy is made")
        del scene, run
        gc.collect()
        others = [end_of(voussoir.Scene(WEDGE).start()) for _ in range(5)]  # free memory is used again
        for view, before in zip(views, kept):
            np.testing.assert_array_equal(view, before)
        self.assertEqual(len(others), 5)

    def test_of_before_a_stage_that_adds_bodies_keep_their_numbers(self):
        run = scene_of(LINED).start()
        run.advance(10)
        first = run.state.displacement
        while len(run.state.displacement) == len(first):
            before = first.copy()
            self.assertTrue(run.advance(10))
        np.testing.assert_array_equal(first, before)
        self.assertFalse(np.shares_memory(first, run.state.displacement))
        self.assertEqual(len(run.names), len(run.state.velocity))
        end_of(run)
        np.testing.assert_array_equal(first, before)


class ContactsAndSurface(unittest.TestCase):
    def assert_contacts_equal(self, contacts, frame):
        self.assertEqual(set(contacts.dtype.names), {"point"} | set(frame.point_data))
        np.testing.assert_array_equal(contacts["point"], frame.points)
        for name, numbers in frame.point_data.items():
            np.testing.assert_array_equal(contacts[name], numbers, err_msg=name)
        self.assertGreater(len(contacts), 0)

    def test_at_the_end_equal_the_last_frame_s(self):
        for path in (WEDGE, TUNNEL, LINED):
            with self.subTest(path.name):
                frames = program(path) / "frames"
                run = end_of(scene_of(path).start())
                self.assert_contacts_equal(run.contacts(), Frame(sorted(frames.glob("contacts_*"))[-1]))

                blocks = Frame(sorted(frames.glob("blocks_*"))[-1])
                points, faces, cell_data, point_data = run.surface()
                np.testing.assert_array_equal(points, blocks.points)
                np.testing.assert_array_equal(faces, np.concatenate([[len(cell), *cell] for cell in blocks.cells]))
                self.assertEqual(set(cell_data), set(blocks.cell_data))
                for name, numbers in blocks.cell_data.items():
                    np.testing.assert_array_equal(cell_data[name], numbers, err_msg=name)
                for name, numbers in blocks.point_data.items():  # in files to single precision
                    np.testing.assert_array_equal(point_data[name].astype(np.float32), numbers.astype(np.float32))

    def test_within_a_stage_equal_that_moment_s_frame(self):
        sets = "output.frame_interval_s=0.25",
        folder = program(WEDGE, *sets)
        times = [float(f.get("timestep")) for f in ElementTree.parse(folder / "contacts.pvd").iter("DataSet")]
        run = voussoir.Scene(WEDGE, set={"output.frame_interval_s": 0.25}).start()
        compared = 0
        for number, at in enumerate(times[:4]):
            while run.state.time < at:
                self.assertTrue(run.advance(1))
            if run.state.time == at > 0 and run.stage == "settle":
                self.assert_contacts_equal(run.contacts(), Frame(folder / f"frames/contacts_{number:04}.vtp"))
                compared += 1
        self.assertGreaterEqual(compared, 2)

    def test_a_copy_that_the_run_does_not_change(self):
        run = voussoir.Scene(CUBES).start()
        run.advance(30)
        contacts = run.contacts()
        self.assertTrue(contacts.flags.owndata and contacts.flags.writeable)
        before = contacts.copy()
        end_of(run)
        np.testing.assert_array_equal(contacts, before)
        weight = run.contacts()["force"][0]
        np.testing.assert_allclose(weight, [0, 0, 20000], atol=0.2)  # 2 t at 10 m/s², equilibrium to 1e-6, less the damping's

    def test_the_surface_is_closed_and_outwards(self):
        points, faces, cell_data, _ = voussoir.Scene(CUBES).start().surface()
        volume, place, cells = {}, 0, 0
        while place < len(faces):
            corners = points[faces[place + 1:place + 1 + faces[place]]]
            body = cell_data["body"][cells]
            for b, c in zip(corners[1:], corners[2:]):
                volume[body] = volume.get(body, 0) + np.dot(corners[0], np.cross(b, c)) / 6
            place, cells = place + 1 + faces[place], cells + 1
        self.assertEqual(cells, len(cell_data["joint"]))
        np.testing.assert_allclose(sorted(volume.values()), [1, 1], rtol=1e-14)


class Save(unittest.TestCase):
    def test_writes_the_program_s_files(self):
        for path in (WEDGE, TUNNEL, LINED):
            with self.subTest(path.name):
                made, saved = program(path), scratch / f"saved_{path.stem}"
                run = end_of(scene_of(path).start())
                run.save(saved)
                self.assertEqual(results_of(saved), results_of(made))
                for table in ("history.csv", "bolts.csv", "lining.csv"):
                    self.assertEqual((made / table).exists(), (saved / table).exists(), table)
                    if (made / table).exists():
                        self.assertEqual((made / table).read_bytes(), (saved / table).read_bytes(), table)
                self.assertEqual((saved / "frames/contacts_0000.vtp").read_bytes(),
                                 sorted(made.glob("frames/contacts_*"))[-1].read_bytes())
                self.assertEqual(voussoir.Scene(saved / "scene.toml").hash, scene_of(path).hash)

    def test_again_adds_a_frame_and_nothing_else_is_replaced(self):
        folder = scratch / "twice"
        run = voussoir.Scene(CUBES).start()
        run.advance(10)
        run.save(folder)
        run.save(folder)
        self.assertFalse((folder / "results.json").exists(), "the scene is not done")
        self.assertEqual(run.results["status"], "under way")
        end_of(run).save(folder)
        self.assertEqual(len(list(folder.glob("frames/blocks_*"))), 2)
        self.assertTrue((folder / "results.json").exists())

        other = voussoir.Scene(CUBES).start()
        with self.assertRaisesRegex(FileExistsError, "history.csv|frames|blocks|scene.toml"):
            other.save(folder)
        other.save(folder, overwrite=True)
        self.assertFalse((folder / "results.json").exists(), "of the other run")
        self.assertEqual(len(list(folder.glob("frames/blocks_*"))), 1)

        again = voussoir.Scene(folder / "scene.toml").start()
        with self.assertRaisesRegex(FileExistsError, "is read by this scene"):
            again.save(folder, overwrite=True)
        with self.assertRaisesRegex(FileExistsError, "run of the program"):
            again.save(program(CUBES), overwrite=True)
        with self.assertRaises(OSError):
            again.save(CUBES / "below_a_file")


class Blocks(unittest.TestCase):
    def test_are_those_of_the_program(self):
        slope = SOURCE / "examples" / "tutorial" / "slope.toml"
        with tempfile.TemporaryDirectory() as out:
            subprocess.run([PROGRAM, "blocks", slope, "--required", "1.3", "--seismic", "0.1/180", "--out", out], check=True,
                           stdout=subprocess.DEVNULL)
            expected = json.loads((Path(out) / "blocks_verdicts.json").read_text())
            rows = list(csv.DictReader((Path(out) / "blocks_verdicts.csv").read_text().splitlines()))
        found = voussoir.blocks(voussoir.Scene(slope), required=1.3, seismic=(0.1, 180))
        for content in (expected, found.verdicts):
            content.pop("program")
        self.assertEqual(found.verdicts, expected)
        factors = [float(row["factor"] or "nan") for row in rows]
        np.testing.assert_array_equal(found.table["factor"], factors)
        self.assertEqual(found.table["verdict"], [row["verdict"] for row in rows])
        self.assertEqual(len(found.surface.cell_data["factor"]), len(found.surface.cell_data["body"]))

    def test_the_tutorial_s_pair_is_lower_than_its_blocks(self):
        slope = voussoir.Scene(SOURCE / "examples" / "tutorial" / "slope.toml")
        found = voussoir.blocks(slope).verdicts
        self.assertAlmostEqual(found["clusters"][0]["factor"], 1.069448, places=6)
        with self.assertRaisesRegex(ValueError, "no stage has this name"):
            voussoir.blocks(slope, after="nowhere")
        with self.assertRaises(ValueError):
            voussoir.blocks(slope, required=0)
        with self.assertRaisesRegex(ValueError, "seismic trend .* is not from 0 to 360"):
            voussoir.blocks(slope, seismic=(0.1, 400))

    def test_stand_beside_the_search_in_results(self):
        scene = voussoir.Scene(SOURCE / "examples" / "tutorial" / "slope.toml")
        at = end_of(scene.start()).results["at_last_stable_state"][0]
        self.assertAlmostEqual(at["block_theory"]["critical"], 1.069448, places=6)


class Errors(unittest.TestCase):
    def refused(self, *arguments, **named):
        with self.assertRaises(voussoir.SceneError) as caught:
            voussoir.Scene(*arguments, **named)
        error = caught.exception
        self.assertIsInstance(error, ValueError)
        self.assertNotIn("\n", str(error))
        return error

    def test_name_file_line_and_key(self):
        with tempfile.TemporaryDirectory() as scratch:
            path = Path(scratch) / "steep.toml"
            lines = CUBES.read_text().splitlines()
            line = lines.index("dip = 0") + 1
            lines[line - 1] = "dip = 95"
            path.write_text("\n".join(lines))
            error = self.refused(path)
            self.assertEqual((error.file, error.line, error.key), (str(path), line, "joints.bed.dip"))
            self.assertTrue(str(error).startswith(f"{path}:{line}: joints.bed.dip = 95: "), error)

            path.write_text("dimension = 3\ngravity = = 1\n")
            error = self.refused(path)
            self.assertEqual((error.file, error.line, error.key), (str(path), 2, ""))

        error = self.refused(CUBES, set={"joints.bed.dip": 95})
        self.assertEqual((error.file, error.line, error.key), (str(CUBES), 0, "joints.bed.dip"))
        self.assertIn("--set joints.bed.dip=95", str(error))
        self.assertEqual(self.refused(CUBES, set={"joints.bad.dip": 5}).key, "joints.bad")
        error = self.refused(SOURCE / "no_such.toml")
        self.assertEqual((error.file, error.line), (str(SOURCE / "no_such.toml"), 0))

    def test_in_a_dict_name_the_key(self):
        tree = tomllib.loads(CUBES.read_text())
        tree["density"] = float("nan")
        error = self.refused(tree)
        self.assertEqual((error.file, error.line, error.key), ("dict", 0, "density"))
        tree["density"] = 2000
        tree["joints"][0]["dpi"] = 3
        self.assertIn("dip", str(self.refused(tree)), "the suggested key")
        tree["joints"] = {1, 2}
        with self.assertRaisesRegex(TypeError, "set"):
            voussoir.Scene(tree)
        tree["joints"] = tree
        with self.assertRaisesRegex(ValueError, "nest"):
            voussoir.Scene(tree)
        with self.assertRaises(TypeError):
            voussoir.Scene(3)

    def test_features_of_the_program_alone_are_refused(self):
        self.assertEqual(self.refused(WEDGE, set={"contact.lp": "glpk"}).key, "contact.lp")
        self.assertEqual(self.refused(WEDGE, set={"accuracy.budget": True}).key, "accuracy.budget")
        self.assertEqual(self.refused(WEDGE, set={"accuracy.error": "1 %"}).key, "accuracy.error")

    def test_of_arguments_and_of_a_run_that_fails(self):
        scene = voussoir.Scene(CUBES)
        for threads in (0, 2000):
            with self.assertRaises(ValueError):
                scene.start(threads=threads)
        with self.assertRaises(ValueError):
            scene.start().advance(0)
        stopped = end_of(voussoir.Scene(CUBES, set={"stage.settle.step_limit": 5}).start())
        self.assertEqual(stopped.results["status"], "incomplete")
        self.assertIn("step limit", stopped.results["message"])


class Life(unittest.TestCase):
    def test_memory_stays_flat_over_a_hundred_runs(self):
        def resident():
            return int(Path("/proc/self/statm").read_text().split()[1]) * os.sysconf("SC_PAGE_SIZE")

        def use(kept):
            run = voussoir.Scene(TUNNEL).start()
            run.advance(50)
            kept += [run, run.state.displacement, run.state.rotation, run.contacts(), run.surface(), run.results, run.history]

        for _ in range(30):  # until the allocator's memory is constant
            use([])
        before, kept = resident(), []
        for _ in range(30):
            use(kept)
        each = (resident() - before) / 30
        self.assertGreater(each, 10_000, "the memory of a run is measurable")
        kept.clear()
        before = resident()
        for _ in range(100):
            use([])
        # a leak of a tenth of the runs would show
        self.assertLess(resident() - before, 10 * each)

    def test_ctrl_c_ends_between_steps_and_the_run_continues(self):
        script = textwrap.dedent(f"""
            import voussoir
            scene = voussoir.Scene({str(FALL)!r})
            run = scene.start()
            try:
                run.advance(1)
                print("begun", flush=True)
                run.advance(10**12)
                print("not interrupted")
            except KeyboardInterrupt:
                steps = run.state.steps
                assert steps > 1 and not run.done and run.state.displacement.any()
                assert run.advance(3) and run.state.steps == steps + 3
                same = scene.start()
                same.advance(steps + 3)
                assert same.state_hash == run.state_hash
                print("went on")
        """)
        child = subprocess.Popen([sys.executable, "-c", script], stdout=subprocess.PIPE, text=True)
        self.assertEqual(child.stdout.readline(), "begun\n")
        used = Path(f"/proc/{child.pid}/stat")
        begun = int(used.read_text().split()[13])
        while int(used.read_text().split()[13]) < begun + 0.3 * os.sysconf("SC_CLK_TCK"):
            time.sleep(0.02)
        child.send_signal(signal.SIGINT)
        out, _ = child.communicate(timeout=120)
        self.assertEqual((out, child.returncode), ("went on\n", 0))

    def test_other_threads_run_meanwhile_and_are_refused(self):
        run = voussoir.Scene(FALL).start()
        view = run.state.displacement
        worker = threading.Thread(target=run.advance, args=(3000,))
        worker.start()
        refusals = 0
        while worker.is_alive():
            try:
                run.state_hash
            except RuntimeError as error:
                self.assertIn("another thread", str(error))
                refusals += 1
            view.sum()
            time.sleep(0.001)
        self.assertGreater(refusals, 0)
        self.assertEqual(run.state.steps, 3000)

    def test_is_installed_as_its_component(self):
        with tempfile.TemporaryDirectory() as prefix:
            subprocess.run([os.environ["CMAKE_COMMAND"], "--install", os.environ["VOUSSOIR_BUILD_DIR"], "--component", "python",
                            "--prefix", prefix], check=True, stdout=subprocess.DEVNULL)
            package = Path(prefix) / "lib/python3/dist-packages/voussoir"
            installed = {str(path.relative_to(package)) for path in package.rglob("*") if path.is_file()}
            module = Path(voussoir._core.__file__).name
            self.assertEqual(installed, {module} | {path.name for path in (SOURCE / "python/src/voussoir").glob("*.*")})
            found = subprocess.run([sys.executable, "-c", "import voussoir; print(voussoir.__file__, voussoir.__version__)"],
                                   env={**os.environ, "PYTHONPATH": str(package.parent)}, cwd=prefix, check=True, text=True,
                                   stdout=subprocess.PIPE).stdout.split()
            self.assertEqual(found, [str(package / "__init__.py"), voussoir.__version__])


class Readme(unittest.TestCase):
    def test_its_lines_run(self):
        code = re.search(r"```python\n(.*?)```", (SOURCE / "python/README.md").read_text(), re.DOTALL)[1]
        self.assertEqual(len(code.splitlines()), 15)
        ast.parse(code)
        (scratch / "cases").symlink_to(SOURCE / "cases")
        out = subprocess.run([sys.executable, "-c", code], cwd=scratch, check=True, text=True,
                             stdout=subprocess.PIPE).stdout
        expected = results_of(program(WEDGE, "joints.A.dip=42"))
        found = expected["values"]["critical_friction"]
        self.assertTrue(out.endswith(f"{found['value']:.3f} ± {found['error_bar']:.3f} deg {expected['state_hash']}\n"), out)
        self.assertIn("reduce: ", out)
        self.assertEqual(results_of(scratch / "results/steeper_wedge"), expected)


if __name__ == "__main__":
    unittest.main()
