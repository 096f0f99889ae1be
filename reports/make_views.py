#!/usr/bin/python3
"""make_views.py --source REPOSITORY --build BUILD [--jobs N] [--only CASE …]: the manual's views of the cases' blocks.

Runs every scene that reports/views.toml names, takes its poster by headless Chromium, and writes BUILD/reports/views:
CASE.html, the figures of a case, and script.html, which a page includes once. A figure is kept if program, scenes of the
case and entry have not changed. Without the viewer a case's page gives the reason, without Chromium there are no posters;
both end with 77. A scene that cannot be run is named, and the exit code is 1.
"""
import argparse
import concurrent.futures
import hashlib
import html
import pathlib
import shutil
import subprocess
import sys
import tomllib

WIDTH, HEIGHT = 920, 560  # of a poster, pixels; the figure has this shape
LONGEST = 300  # s of a run


class Missing(Exception):
    """the reason why something cannot be shown"""


def last_line(text):
    return (text.strip().splitlines() or ["no message"])[-1]


def call(*command, **options):
    done = subprocess.run(command, capture_output=True, text=True, errors="replace", **options)
    if done.returncode != 0:
        raise Missing(last_line(done.stderr))
    return done.stdout


class Views:
    def __init__(self, source, build):
        self.source, self.out = source, build / "reports" / "views"
        self.program = build / "app" / "voussoir"
        self.node = shutil.which("node") or shutil.which("nodejs")
        self.posters = bool(self.node and shutil.which("chromium"))
        self.out.mkdir(parents=True, exist_ok=True)
        self.built = hashlib.sha256(self.program.read_bytes() + (source / "viewer/poster.mjs").read_bytes()).hexdigest()

    def key(self, view):
        text = hashlib.sha256(f"{self.built} {self.posters} {view}".encode())
        for file in sorted((self.source / "cases" / view["case"]).iterdir()):
            if file.suffix in (".toml", ".csv"):
                text.update(file.read_bytes())
        return text.hexdigest()

    def figure(self, view, number):
        """the piece of the page, made again if something has changed"""
        work = self.out / "work" / f"{view['case']}-{number}"
        key, piece, wanted = work / "key", work / "piece.html", self.key(view)
        if not (piece.exists() and key.exists() and key.read_text() == wanted):
            shutil.rmtree(work, ignore_errors=True)
            work.mkdir(parents=True)
            run, poster = work / "run", work / "poster.webp"
            settings = [word for setting in view.get("set", []) for word in ("--set", setting)]
            call(self.program, "run", f"cases/{view['case']}/{view['scene']}", "--view", "--quiet", "--threads", "1", "--out", run,
                 *settings, "--set", "output.frames=false", cwd=self.source, timeout=LONGEST)
            options = []
            if self.posters:
                call(self.node, self.source / "viewer/poster.mjs", run / "view.html", poster, view["look"], str(WIDTH), str(HEIGHT),
                     timeout=LONGEST)
                options = ["--poster", poster]
            call(self.program, "view", run, "--fragment", "--look", view["look"], *options, "--out", piece)
            shutil.rmtree(run)
            key.write_text(wanted)
        caption = html.escape(view["caption"])
        if not self.posters:
            caption += " The picture is missing: node or Chromium was not installed when this page was made."
        return f'<figure class="view">{piece.read_text()}<figcaption>{caption}</figcaption></figure>\n'

    def case(self, name, views):
        """writes the figures of one case; returns the failures"""
        text, failures = "", []
        for number, view in enumerate(views, 1):
            try:
                text += self.figure(view, number)
            except (Missing, OSError, subprocess.TimeoutExpired) as problem:
                failures.append(f"view of {name}, {view['scene']}: {problem}")
                text += f'<p class="note">The blocks of {html.escape(view["scene"])} are not shown: {html.escape(str(problem))}</p>\n'
        (self.out / f"{name}.html").write_text(text)
        return failures

    def forget_all_but(self, cases):
        """removes the pages of an older list"""
        for page in self.out.glob("*.html"):
            if page.stem not in {*cases, "script"}:
                page.unlink()
        for work in (self.out / "work").glob("*"):
            if work.name.rpartition("-")[0] not in cases:
                shutil.rmtree(work)

    def without_viewer(self, names, reason):
        for name in names:
            (self.out / f"{name}.html").write_text(f'<p class="note">The interactive view of the blocks is missing: {html.escape(reason)}</p>\n')


def main():
    options = argparse.ArgumentParser()
    options.add_argument("--source", type=pathlib.Path, required=True)
    options.add_argument("--build", type=pathlib.Path, required=True)
    options.add_argument("--jobs", type=int, default=1)
    options.add_argument("--only", action="append", default=[])
    arguments = options.parse_args()
    views = Views(arguments.source.resolve(), arguments.build.resolve())
    with open(arguments.source / "reports" / "views.toml", "rb") as file:
        listed = tomllib.load(file)["view"]
    cases = {}
    for view in listed:
        if not arguments.only or view["case"] in arguments.only:
            cases.setdefault(view["case"], []).append(view)
    if not arguments.only:
        views.forget_all_but(cases)

    try:
        call(views.program, "view", "--script", "--overwrite", "--out", views.out / "script.html")
    except Missing as problem:
        (views.out / "script.html").unlink(missing_ok=True)
        views.without_viewer(cases, str(problem))
        print(f"SKIPPED: views of the cases: {problem}")
        return 77
    with concurrent.futures.ThreadPoolExecutor(arguments.jobs) as pool:
        failures = [text for found in pool.map(views.case, cases, cases.values()) for text in found]
    for text in failures:
        print(text)
    print(f"views: {len(cases)} cases, {len(failures)} failed")
    if not views.posters:
        print("SKIPPED: posters of the views: node or chromium is not installed")
    return 1 if failures else 0 if views.posters else 77


if __name__ == "__main__":
    sys.exit(main())
