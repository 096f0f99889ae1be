"""Runs problems in engines: OUT/ENGINE/PROBLEM/answer.csv with one setting for everything, and with --settings best
OUT/ENGINE_best/PROBLEM/answer.csv with the best setting of each problem. usage: run.py PROBLEMS BUILD PROGRAM OUT [--engine NAME]
[--problem NAME] [--settings best] [--patience SECONDS]"""
import argparse
import csv
import json
import os
import sys

from answer import answers
from engines import HERE, Process, engines
from problem import Problem


OVERLAP = "# largest overlap: "  # of blocks that stand, at the end of a trial


def settings_of(engine, which, problem):
    """of ENGINE/settings.json: `one` for everything, or `best` of the problem, `one` if the sweep has none for it"""
    with open(os.path.join(HERE, engine.folder, "settings.json"), encoding="utf-8") as file:
        stored = json.load(file)
    chosen = stored["best"].get(problem, stored["one"]) if which == "best" else stored["one"]
    return {**chosen, **engine.extra}


def value_text(value):
    return "" if value is None else value if isinstance(value, str) else "%.10g" % value


def write_answer(path, engine, settings, found, suffix="", model=None):
    os.makedirs(os.path.dirname(path), exist_ok=True)
    with open(path, "w", encoding="utf-8", newline="") as file:
        file.write("# code: %s%s %s\n# model: %s\n" % (engine.name, suffix, engine.version, model or engine.model))
        file.write("# setting: %s\n" % (" ".join("%s=%g" % s for s in settings.items()) or "as it comes"))
        overlaps = [a.overlap for a in found if a.overlap is not None]
        if overlaps:
            file.write("%s%.3g m\n" % (OVERLAP, max(overlaps)))
        rows = csv.writer(file, lineterminator="\n")
        rows.writerow(["quantity", "unit", "value", "seconds", "note"])
        for a in found:
            seconds = "%.3g" % a.seconds if isinstance(a.value, float) else ""
            rows.writerow([a.quantity, a.unit, value_text(a.value), seconds, a.note])


def run_problem(process, problem, which, out):
    """the answers of one problem, or the words that they are those of the other setting"""
    engine = process.engine
    settings, path = settings_of(engine, which, problem.name), os.path.join(out, engine.name, problem.name, "answer.csv")
    if which == "best":
        same, path = path, os.path.join(out, engine.name + "_best", problem.name, "answer.csv")
        if settings == settings_of(engine, "one", problem.name) and os.path.exists(same):
            os.makedirs(os.path.dirname(path), exist_ok=True)
            with open(same, encoding="utf-8", newline="") as file, open(path, "w", encoding="utf-8", newline="") as copy:
                copy.write(file.read().replace("# code: %s " % engine.name, "# code: %s_best " % engine.name, 1))
            print("%s %s: one setting is the best" % (engine.name, problem.name))
            return
    found = answers(problem, process, settings)
    write_answer(path, engine, settings, found, "_best" if which == "best" else "",
                 engine.model_for(problem.needs()))
    for a in found:
        words = (engine.name, problem.name, a.quantity, value_text(a.value), a.unit, a.seconds, a.note)
        print("%s %s: %s: %s %s (%.3g s) %s" % words)


def main():
    parser = argparse.ArgumentParser()
    for name in ("problems", "build", "program", "out"):
        parser.add_argument(name)
    parser.add_argument("--engine", action="append")
    parser.add_argument("--problem", action="append")
    parser.add_argument("--settings", default="one", choices=("one", "best"))
    parser.add_argument("--patience", type=float, default=100, help="processor seconds of a scene before the engine is stopped")
    parser.add_argument("--list", action="store_true", help="print the engines that are there, and run nothing")
    given = parser.parse_args()
    found = engines(given.build, given.program)
    if given.list:
        print("\n".join(found))
        return
    for name in given.engine or found:
        process = Process(found[name], given.patience)
        for folder in given.problem or sorted(os.listdir(given.problems)):
            if os.path.exists(os.path.join(given.problems, folder, "blocks.json")):
                run_problem(process, Problem.read(os.path.join(given.problems, folder)), given.settings, given.out)
                sys.stdout.flush()
        process.close()


if __name__ == "__main__":
    main()
