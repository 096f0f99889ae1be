"""Tries the settings of ENGINE/grid.json on problems and keeps every result in ENGINE/sweep.tsv; a line that is there is not run
again. The grid has a list for all problems, lists of single problems in its place, and under `more` in addition to it. usage: sweep.py PROBLEMS BUILD PROGRAM ENGINE [PROBLEM…]"""
import itertools
import json
import os
import sys

from answer import answers
from engines import HERE, Process, engines
from problem import Problem
from run import value_text

HEAD = ["problem", "setting", "quantity", "unit", "value", "seconds", "note"]


def settings_in(grid):
    """each table of the list in every combination of its lists of values"""
    for table in grid:
        values = [v if isinstance(v, list) else [v] for v in table.values()]
        for combination in itertools.product(*values):
            yield dict(zip(table, combination))


def setting_text(settings):
    return " ".join("%s=%g" % s for s in settings.items())


def kept_rows(path):
    """the lines of a sweep.tsv, as tables"""
    if not os.path.exists(path):
        return []
    with open(path, encoding="utf-8") as file:
        return [dict(zip(HEAD, line.rstrip("\n").split("\t"))) for line in file.readlines()[1:]]


def main():
    problems, build, program, name, *wanted = sys.argv[1:]
    engine = engines(build, program)[name]
    with open(os.path.join(HERE, engine.folder, "grid.json"), encoding="utf-8") as file:
        grid = json.load(file)
    path = os.path.join(HERE, engine.folder, "sweep.tsv")
    done = {(row["problem"], row["setting"]) for row in kept_rows(path)}
    new = not os.path.exists(path)
    with open(path, "a", encoding="utf-8") as file:
        if new:
            file.write("\t".join(HEAD) + "\n")
        for folder in wanted or sorted(os.listdir(problems)):
            if not os.path.exists(os.path.join(problems, folder, "blocks.json")):
                continue
            problem, process = Problem.read(os.path.join(problems, folder)), Process(engine, grid.get("patience_s", 60))
            if engine.reason(problem.needs()):
                continue
            for settings in settings_in(grid.get(folder, grid["all"]) + grid.get("more", {}).get(folder, [])):
                if (folder, setting_text(settings)) in done:
                    continue
                for a in answers(problem, process, {**settings, **engine.extra}):
                    if not isinstance(a.value, str):
                        file.write("\t".join([folder, setting_text(settings), a.quantity, a.unit, value_text(a.value),
                                              "%.3g" % a.seconds, a.note]) + "\n")
                        file.flush()
            process.close()


if __name__ == "__main__":
    main()
