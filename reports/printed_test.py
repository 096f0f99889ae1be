#!/usr/bin/python3
"""printed_test.py BUILD SOURCE FOLDER [long]: a manual of a case (long: of two) and some other pages, with interactive views of blocks, is made, opened, printed and compared.

The PDF must have the text of the page, and in its contents the page of each title; a page with another number, title, line of a scene
or page number must be found to differ. Tables of keys are left to the HTML. Ends with 77 if the viewer, Chromium or poppler-utils is missing; VOUSSOIR_NO_SKIP=1 makes that a failure.
"""
import json
import os
import pathlib
import shutil
import subprocess
import sys

build, source, folder = (pathlib.Path(text).resolve() for text in sys.argv[1:4])
reports = folder / "reports"
manual, to_print, printed, damaged = (folder / name for name in ("manual.html", "manual.print.html", "manual.pdf", "damaged.html"))


def stop(status, text):
    if status == 77 and os.environ.get("VOUSSOIR_NO_SKIP") == "1":
        status = 1
    sys.exit(print(text) or status)


def run(*command, wanted=0):
    done = subprocess.run([str(word) for word in command], capture_output=True, text=True, check=False)
    text = done.stdout + done.stderr
    if done.returncode != wanted:
        stop(77 if done.returncode == 77 else 1, f"{pathlib.Path(command[0]).name} ended with {done.returncode}, not {wanted}:\n{text}")
    return text


def expect(truth, what):
    if not truth:
        stop(1, f"failed: {what}")


def row(case, computed):
    return {"case": case, "quantity": "critical friction", "kind": "exact", "source": "closed form", "because": "an example", "unit": "deg",
            "computed": computed, "expected": computed - 0.001, "error": 0.001, "tolerance": 0.05, "tolerance_absolute": 0.05, "tolerance_relative": 0.0,
            "margin": 0.02, "bound": "both", "verdict": "passed", "commit": "none", "seconds": 1.5, "contact_evaluations": 25743}


cases = ["incline", "wedge"] if sys.argv[4:] == ["long"] else ["wedge"]
shutil.rmtree(folder, ignore_errors=True)
reports.mkdir(parents=True)
(folder / "app").symlink_to(build / "app")
(reports / "verdicts.json").write_text(json.dumps({
    "commit": "none", "compared_with": "", "failures": [], "moved": [], "cases": [{"name": name, "state": "run"} for name in cases],
    "rows": [row(name, {"incline": 29.99917, "wedge": 33.35876}[name]) for name in cases]}))
(reports / "scene_keys.md").write_text(run(build / "app" / "voussoir", "docs"))

run(source / "reports" / "make_sketches.py", "--source", source, "--build", folder, *(word for name in cases for word in ("--only", name)))
run(source / "reports" / "make_views.py", "--source", source, "--build", folder, *(word for name in cases for word in ("--only", name)))
run(build / "reports" / "voussoir_manual", "--source", source, "--build", folder, "--out", manual,
    "--book", source / "reports" / "printed_book.toml")
page = manual.read_text()
expect(page.count('<div class="voussoir"') == len(cases), "each case shows its blocks")
expect(page.count('<img alt="blocks" src="data:image/webp;base64,') == len(cases), "each case has a poster")
expect(page.count('id="voussoir-viewer"') == 1, "the page contains the viewer once")

sketch = (folder / "reports" / "sketches" / "wedge.svg").read_text()
expect(all(f">{words}</text>" in sketch for words in ("8 m", "4 m")), "the sketch of the wedge has the domain's dimensions")
expect("those that are free" in page, "the sketch is shown")
viewer = folder / "manual" / "viewer.js"
expect('id=\\"voussoir-viewer\\"' in viewer.read_text(), "the pages share the viewer")
for name in cases:
    text = (folder / "manual" / f"{name}.html").read_text()
    expect('<script src="viewer.js">' in text and '<div class="voussoir"' in text, f"the page of {name} shows its blocks")

run(shutil.which("node") or "nodejs", source / "reports" / "opened_manual_test.mjs", manual, len(cases), folder / "manual" / "wedge.html")

run(source / "reports" / "print_manual.sh", to_print, printed)
print(run(source / "reports" / "same_numbers.py", to_print, printed), end="")
pictures = run("pdfimages", "-list", printed)
expect(sum(" 920 " in line for line in pictures.splitlines()) >= len(cases), "posters are printed")
page = to_print.read_text()
expect('<h2>Scene keys</h2>' not in page and '<h2>Scene keys</h2>' in manual.read_text(), "tables of keys are left to the HTML")
changes = {"33.3588": "33.3589", "<h2>Verdicts</h2>": "<h2>The verdicts</h2>", "normal_stiffness = 1e9": "normal_stiffness = 2e9",
           'data-page="verdicts"': 'data-page="top"'}
names = {'data-page="top"': "contents: Verdicts"}
for found, other in changes.items():
    expect(found in page, f"the page contains {found}")
    damaged.write_text(page.replace(found, other))
    text = run(source / "reports" / "same_numbers.py", damaged, printed, wanted=1)
    name = names.get(other, other.replace("<h2>", "").replace("</h2>", ""))
    expect(name in text, f"the difference is named: {name}, in\n{text}")
