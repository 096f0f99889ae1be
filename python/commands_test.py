"""The commands of the package against the program called by hand: the same files, errors with their place, Ctrl-C."""
import ast
import importlib.metadata
import inspect
import json
import os
import signal
import subprocess
import sys
import tempfile
import textwrap
import time
import tomllib
import unittest
import unittest.mock
from pathlib import Path

try:
    import numpy as np
except ImportError:
    print("skipped: numpy is not installed (Debian: python3-numpy)")
    sys.exit(77)
import voussoir

SOURCE = Path(os.environ["VOUSSOIR_SOURCE_DIR"])
WEDGE = SOURCE / "examples/wedge.toml"
PLANE = SOURCE / "docs/scenes.toml"
FALL = SOURCE / "cases/free_fall/scene.toml"  # long


def without_machine(folder):
    results = json.loads((Path(folder) / "results.json").read_text())
    return {key: value for key, value in results.items() if key not in ("program", "timing")}


def setUpModule():
    global scratch
    folder = tempfile.TemporaryDirectory()
    unittest.addModuleCleanup(folder.cleanup)
    scratch = Path(folder.name)


class Commands(unittest.TestCase):
    def test_run_gives_the_files_of_the_program(self):
        by_hand = scratch / "by_hand"
        subprocess.run([voussoir.program(), "run", WEDGE, "--out", by_hand, "--set", "joints.A.dip=46", "--quiet"], check=True)
        found = voussoir.run(WEDGE, scratch / "run", set={"joints.A.dip": 46})
        self.assertEqual(without_machine(found), without_machine(by_hand))
        self.assertEqual(found.exit_code, 0)
        self.assertIn("factor_of_safety", found.text)
        value = found.values["factor_of_safety"]
        self.assertGreater(value["error_bar"], 0)
        self.assertEqual(found.history["time_s"].dtype, np.float64)
        self.assertEqual(len(found.history["time_s"]), len((by_hand / "history.csv").read_text().splitlines()) - 1)
        with self.assertRaisesRegex(FileNotFoundError, "view=True"):
            found.page
        self.assertNotIn("iframe", found._repr_html_())

    def test_the_page_by_option_and_by_key(self):
        for number, request in enumerate(({"view": True}, {"set": {"output.view": True}})):
            found = voussoir.run(WEDGE, scratch / f"view_{number}", **request)
            self.assertTrue(found.page.exists())
            self.assertIn("view.bin", found.files)
            self.assertIn("iframe", found._repr_html_())
        self.assertTrue(voussoir.view(found, overwrite=True).page.exists())
        self.assertTrue(voussoir.report(found, author="A. Voss").endswith("report.html"))
        self.assertIn("report.html", found.files)

    def test_a_dict_is_a_scene(self):
        by_file = voussoir.run(PLANE, scratch / "plane")
        by_dict = voussoir.run(tomllib.loads(PLANE.read_text()), scratch / "plane_dict")
        self.assertEqual(by_dict.results["state_hash"], by_file.results["state_hash"])
        self.assertEqual(by_dict.values, by_file.values)

    def test_the_other_commands(self):
        self.assertIn("block", voussoir.check(WEDGE))
        cut = voussoir.slice(WEDGE, scratch / "slice", view=True, stl=True)
        self.assertTrue({"blocks.csv", "blocks.stl", "view.html"} <= set(cut.files), cut.files)
        self.assertTrue((cut.table("blocks.csv")["volume_m3"] > 0).all())
        tested = voussoir.joint_test(WEDGE, scratch / "joint_test")
        self.assertIn("shear_stress_Pa", tested.table("joint_test.csv"))
        self.assertIn("joint_properties", voussoir.docs())
        text = scratch / "wedge.dat"
        voussoir.export(WEDGE, text, as_="3dec")
        self.assertIn("block", text.read_text())
        blocks = voussoir.blocks(voussoir.Scene(WEDGE), required=1.3)
        self.assertAlmostEqual(np.nanmin(blocks.table["factor"]), 1.4087, places=4)
        if importlib.util.find_spec("pandas"):
            self.assertEqual(list(cut.frame("blocks.csv").columns), list(cut.table("blocks.csv")))

    def test_limit_analysis(self):
        try:
            found = voussoir.limit(SOURCE / "examples/wet_slope.toml", scratch / "limit", factor=True)
        except ValueError as error:  # a program without it
            self.skipTest(str(error))
        self.assertTrue(found.files)

    def test_modes(self):
        found = voussoir.modes(SOURCE / "examples/gate.toml", scratch / "modes", number=2)
        self.assertIn("modes.json", found.files)

    def test_a_study_in_one_and_in_parts(self):
        (scratch / "study.toml").write_text(textwrap.dedent(f"""
            scene = "{PLANE}"
            quantity = "factor_of_safety"
            [[sweep]]
            name = "friction"
            key = "joint_properties.rock.friction_deg"
            unit = "deg"
            values = [35, 40]
            """))
        whole = voussoir.study(scratch / "study.toml", scratch / "study", jobs=1)
        planned = voussoir.plan(scratch / "study.toml", scratch / "parts")
        subprocess.run([voussoir.program(), "study", "run", planned, "--quiet"], check=True)
        gathered = voussoir.gather(planned)
        first, second = whole.table("study.csv"), gathered.table("study.csv")
        self.assertEqual(list(first), list(second))
        self.assertEqual(len(first[next(iter(first))]), 3)  # the stated scene and two values

    def test_options_are_words(self):
        words = voussoir.commands._words({"view": True, "until": "settle", "threads": 2, "keep": False, "as_": "yade",
                                          "joint": ["a", "b"], "out": Path("x"), "begin": None})
        self.assertEqual(words, ["--view", "--until", "settle", "--threads", "2", "--as", "yade", "--joint", "a", "--joint", "b",
                                 "--out", "x"])


class Portions(unittest.TestCase):
    def test_keeps_the_data_of_the_page_that_the_scene_requests(self):
        folder = scratch / "viewed"
        run = voussoir.Scene(PLANE, set={"output.view": True}).start()
        run.save(folder)
        start = (folder / "view.bin").stat().st_size
        while run.advance():
            pass
        run.save(folder)
        self.assertGreater((folder / "view.bin").stat().st_size, start, "another frame")
        self.assertIn("<html", voussoir.view(folder).page.read_text())
        run.save(folder, overwrite=True)
        voussoir.Scene(PLANE).start().save(scratch / "not_viewed")
        self.assertFalse((scratch / "not_viewed/view.bin").exists())

    def test_a_notebook_shows_the_run_and_its_blocks(self):
        run = voussoir.Scene(PLANE).start()
        before = run._repr_html_()
        self.assertIn("<td>under way</td>", before)
        self.assertIn("iframe", before)
        run.advance(10)
        now = run.history["slab_displacement_x_m"][-1]
        self.assertIn(f"<th>slab_displacement_x_m</th><td>{now:.6g}</td>", run._repr_html_())
        while run.advance():
            pass
        value = run.results["values"]["factor_of_safety"]
        after = run._repr_html_()
        self.assertIn(f"<th>factor_of_safety</th><td>{value['value']:.6g} ± {value['error_bar']:.2g}</td>", after)
        self.assertIn(f"<td>{run.state.steps}</td>", after)
        self.assertIn("<td>done</td>", after)
        with unittest.mock.patch("voussoir.notebook.program", side_effect=FileNotFoundError):
            self.assertNotIn("iframe", run._repr_html_(), "the module alone makes no page")


class Errors(unittest.TestCase):
    def test_of_a_scene_has_its_place(self):
        for call in (voussoir.check, voussoir.run):
            with self.assertRaises(voussoir.SceneError) as caught:
                call(PLANE, set={"joints.bedding.dip": 95})
            self.assertEqual(caught.exception.key, "joints.bedding.dip")
            self.assertTrue(str(caught.exception.file).startswith(str(PLANE)), caught.exception.file)
            self.assertIn("between 0 and 90", str(caught.exception))
        self.assertFalse((Path("results") / "scenes").exists())
        with self.assertRaises(voussoir.SceneError) as caught:
            voussoir.check(tomllib.loads(PLANE.read_text()), set={"joints.bedding.dip": 95})
        self.assertEqual(caught.exception.key, "joints.bedding.dip")

    def test_of_a_command_say_what_the_program_says(self):
        with self.assertRaisesRegex(ValueError, "no-such-option"):
            voussoir.run(PLANE, scratch / "never", no_such_option=1)
        with self.assertRaisesRegex(ValueError, "nowhere.toml"):
            voussoir.check(scratch / "nowhere.toml")
        done = voussoir.run(PLANE, scratch / "twice")
        with self.assertRaisesRegex(ValueError, "overwrite"):
            voussoir.run(PLANE, done)
        # also of a scene that the module refuses, since only the program has error budgets
        budget = {"accuracy.budget": True}
        done = voussoir.run(PLANE, scratch / "budget", set=budget)
        with self.assertRaisesRegex(ValueError, "overwrite"):
            voussoir.run(PLANE, done, set=budget)
        # a goal that was not reached is a result
        missed = voussoir.run(PLANE, scratch / "missed", set={"stage.safety.from_factor": 1.6})
        self.assertEqual(missed.exit_code, 1)
        self.assertTrue(missed.results)

    def test_of_a_missing_program_names_the_variable(self):
        found = subprocess.run([sys.executable, "-c", "import voussoir; voussoir.docs()"], text=True, capture_output=True,
                               env={**os.environ, "VOUSSOIR_PROGRAM": "", "PATH": str(scratch)})
        if (Path(voussoir.__file__).parent / "bin").exists():
            self.assertEqual(found.returncode, 0, found.stderr)
        else:
            self.assertIn("VOUSSOIR_PROGRAM", found.stderr)

    def test_ctrl_c_leaves_a_checkpoint(self):
        code = textwrap.dedent(f"""
            import voussoir
            try:
                voussoir.run({str(FALL)!r}, {str(scratch / "stopped")!r}, checkpoint_steps=50)
            except KeyboardInterrupt:
                print("interrupted")
            """)
        process = subprocess.Popen([sys.executable, "-c", code], stdout=subprocess.PIPE, text=True)
        checkpoint = scratch / "stopped" / "checkpoint.bin"
        for _ in range(600):
            if any((scratch / "stopped").glob("checkpoint*")) or process.poll() is not None:
                break
            time.sleep(0.05)
        process.send_signal(signal.SIGINT)
        self.assertEqual(process.communicate()[0], "interrupted\n")
        self.assertTrue(any((scratch / "stopped").glob("checkpoint*")), checkpoint)
        with self.assertRaises(ValueError):  # an unfinished run is not replaced in silence
            voussoir.run(FALL, scratch / "stopped")


class Package(unittest.TestCase):
    def test_the_stub_names_what_the_module_has(self):
        stub = ast.parse((Path(voussoir.__file__).parent / "_core.pyi").read_text())
        stated = {node.name: node for node in stub.body if isinstance(node, (ast.ClassDef, ast.FunctionDef))}
        self.assertEqual(set(stated) | {"__version__"}, {name for name in dir(voussoir._core)
                                                         if not name.startswith("_") or name == "__version__"})
        for name in ("Scene", "Run", "State"):
            members = {node.name for node in stated[name].body if isinstance(node, ast.FunctionDef)}
            found = {member for member in vars(getattr(voussoir._core, name)) if not member.startswith("_")}
            self.assertEqual(members - {"__init__"}, found)
        self.assertTrue((Path(voussoir.__file__).parent / "py.typed").exists())

    def test_every_public_name_is_documented(self):
        for name in voussoir.__all__:
            if name != "__version__":
                self.assertTrue(inspect.getdoc(getattr(voussoir, name)), name)

    @unittest.skipUnless(os.environ.get("VOUSSOIR_INSTALLED"), "the package of the build folder has no metadata")
    def test_its_metadata(self):
        self.assertEqual(importlib.metadata.version("voussoir"), voussoir.__version__)
        self.assertEqual(Path(voussoir.program()), Path(voussoir.__file__).parent / "bin/voussoir")
        command = Path(sys.executable).parent / "voussoir"
        shown = subprocess.run([command, "--version"], check=True, text=True, capture_output=True).stdout
        self.assertIn(voussoir.__version__, shown)


if __name__ == "__main__":
    unittest.main()
