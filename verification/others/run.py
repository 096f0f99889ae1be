"""Runs problems in engines, each with its settings: OUT/ENGINE/PROBLEM/answer.csv. usage: run.py PROBLEMS BUILD PROGRAM OUT
[--engine NAME] [--problem NAME] [--settings one|best]"""
import argparse
import csv
import json
import os
import sys

from answer import answers
from engines import HERE, Process, engines
from problem import Problem


def settings_of(engine, which, problem):
    """of ENGINE/settings.json: `one` for everything, or `best` of the problem, `one` if the sweep has none for it"""
    with open(os.path.join(HERE, engine.folder, "settings.json"), encoding="utf-8") as file:
        stored = json.load(file)
    chosen = stored["best"].get(problem, stored["one"]) if which == "best" else stored["one"]
    return {**chosen, **engine.extra}


def value_text(value):
    return "" if value is None else value if isinstance(value, str) else "%.10g" % value


def write_answer(path, engine, settings, found):
    os.makedirs(os.path.dirname(path), exist_ok=True)
    with open(path, "w", encoding="utf-8", newline="") as file:
        file.write("# code: %s %s\n# model: %s\n" % (engine.name, engine.version, engine.model))
        file.write("# setting: %s\n" % (" ".join("%s=%g" % s for s in settings.items()) or "as it comes"))
        rows = csv.writer(file, lineterminator="\n")
        rows.writerow(["quantity", "unit", "value", "seconds", "note"])
        for a in found:
            seconds = "%.3g" % a.seconds if isinstance(a.value, float) else ""
            rows.writerow([a.quantity, a.unit, value_text(a.value), seconds, a.note])


def main():
    parser = argparse.ArgumentParser()
    for name in ("problems", "build", "program", "out"):
        parser.add_argument(name)
    parser.add_argument("--engine", action="append")
    parser.add_argument("--problem", action="append")
    parser.add_argument("--settings", default="one", choices=("one", "best"))
    given = parser.parse_args()
    found = engines(given.build, given.program)
    for name in given.engine or found:
        process = Process(found[name])
        for folder in given.problem or sorted(os.listdir(given.problems)):
            if not os.path.exists(os.path.join(given.problems, folder, "blocks.json")):
                continue
            problem = Problem.read(os.path.join(given.problems, folder))
            settings = settings_of(found[name], given.settings, problem.name)
            result = answers(problem, process, settings)
            write_answer(os.path.join(given.out, name, folder, "answer.csv"), found[name], settings, result)
            for a in result:
                print("%s %s: %s: %s %s (%.3g s) %s" % (name, folder, a.quantity, value_text(a.value), a.unit, a.seconds, a.note))
            sys.stdout.flush()
        process.close()


if __name__ == "__main__":
    main()
