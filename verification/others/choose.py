"""Chooses the settings of ENGINE/settings.json from ENGINE/sweep.tsv, by the rule in README.md. usage: choose.py PROBLEMS BUILD
PROGRAM ENGINE…"""
import json
import os
import sys

from engines import HERE, engines
from problem import Problem
from score import MOST, read_reference, target, tolerances
from sweep import kept_rows


DEAR = "rock_mass"


def settings_of_text(text):
    return {key: float(value) for key, value in (word.split("=") for word in text.split())}


class Tally:
    """of a problem's quantities: the sum of errors in tolerances, in which one within its tolerance counts nothing; the largest error;
    seconds"""

    def __init__(self):
        self.sum, self.largest, self.runs = 0.0, 0.0, set()

    def add(self, error, seconds):
        self.sum += error if error > 1 else 0.0
        self.largest = max(self.largest, error)
        self.runs.add(seconds)  # quantities of one run have its seconds

    @property
    def seconds(self):
        return sum(self.runs)


def judged(rows, problems, engine):
    """{problem: {setting: Tally}}"""
    found, references, models = {}, {}, {}
    for row in rows:
        problem = row["problem"]
        if problem not in references:
            references[problem] = read_reference(os.path.join(problems, problem))
            models[problem] = engine.model_for(Problem.read(os.path.join(problems, problem)).needs())
        quantity = references[problem].get(row["quantity"])
        bounds = target(quantity, models[problem]) if quantity else None
        if bounds:
            error = tolerances(float(row["value"]) if row["value"] else None, bounds)
            found.setdefault(problem, {}).setdefault(row["setting"], Tally()).add(error, float(row["seconds"] or 0))
    return found


def choose(found):
    """(setting for everything, {problem: best setting}); of equals the quickest. The rock mass, of which few settings can be
    tried, has no part in the first: else it alone would decide which settings are candidates."""
    best = {problem: min(tried, key=lambda s: (tried[s].sum, tried[s].seconds)) for problem, tried in found.items()}
    small = [tried for problem, tried in found.items() if problem != DEAR]
    everywhere = {s for tried in small for s in tried}
    most = max(sum(s in tried for tried in small) for s in everywhere)
    common = [s for s in everywhere if sum(s in tried for tried in small) == most]

    def cost(setting):
        tried = [t[setting] for t in small if setting in t]
        return sum(t.sum for t in tried), sum(t.seconds for t in tried)

    return min(sorted(common), key=cost), best


def main():
    problems, build, program, *names = sys.argv[1:]
    known = engines(build, program)
    for name in names:
        folder = os.path.join(HERE, known[name].folder)
        found = judged(kept_rows(os.path.join(folder, "sweep.tsv")), problems, known[name])
        one, best = choose(found)
        with open(os.path.join(folder, "settings.json"), "w", encoding="utf-8") as file:
            json.dump({"one": settings_of_text(one), "best": {p: settings_of_text(s) for p, s in sorted(best.items())}}, file,
                      indent=1)
            file.write("\n")
        largest = ", ".join("%s %.3g" % (p, t[one].largest) for p, t in sorted(found.items()) if one in t)
        print("%s: one setting: %s (largest error in tolerances, at most %g: %s)" % (name, one, MOST, largest))


if __name__ == "__main__":
    main()
