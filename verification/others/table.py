"""The table of engines and problems from `voussoir judge`: OUT/results.md, others.html; and error_against_cost.svg from the sweeps.
usage: table.py JUDGEMENT.csv PROBLEMS BUILD PROGRAM OUT"""
import csv
import glob
import html
import json
import os
import sys

from choose import judged
from engines import HERE, engines
from figure import draw
from run import OVERLAP
from sweep import kept_rows, setting_text


HEADS = (("One setting for everything", ""), ("The best setting of each problem", "_best"))
INTRODUCTION = """# Results of the other engines

Written by `make others`. Value, verdict (the distance from the right answer if it fails), processor seconds of all trials.
*Cannot state* and *stopped* have their reasons in the answers' notes and in the list below.

"""


class Cell:
    """what one code says about one quantity"""

    def __init__(self, text, verdict, seconds, note):
        self.text, self.verdict, self.seconds, self.note = text, verdict, seconds, note

    def words(self):
        if self.verdict in ("cannot state", "not run", "stopped"):
            return self.verdict
        return "%s, %s%s" % (self.text, self.verdict, ", %s s" % self.seconds if self.seconds else "")


def cell(row):
    """of a line of judgement.csv"""
    if row["verdict"] == "FAILED":
        verdict = "FAIL %+.3g" % float(row["error"])
    elif row["verdict"] == "not run" and row["note"]:
        verdict = "stopped"  # the engine, with the reason in the note
    else:
        verdict = {"passed": "pass", "not asked": "not judged"}.get(row["verdict"], row["verdict"])
    return Cell("%.6g" % float(row["value"]) if row["value"] else "", verdict, row["seconds"], row["note"])


def judged_rows(file):
    """of judgement.csv: [(problem, quantity, unit, {code: Cell})], the codes without their versions"""
    rows = {}
    for row in csv.DictReader(file):
        found = rows.setdefault((row["problem"], row["quantity"], row["unit"]), {})
        found[row["code"].split()[0]] = cell(row)
    return [(*key, found) for key, found in rows.items()]


def column(code):
    return code.removesuffix("_best")


def markdown(head, rows, codes):
    lines = ["## " + head, "", "| problem | quantity | " + " | ".join(map(column, codes)) + " |", "|---|---|" + "---|" * len(codes)]
    for problem, name, unit, found in rows:
        cells = [found[c].words() if c in found else "not run" for c in codes]
        lines.append("| %s | %s, %s | %s |" % (problem, name, unit, " | ".join(cells)))
    return "\n".join(lines) + "\n\n"


def overlaps_of(out):
    """{problem: {code: m}}, from the heads of the answers; those of one setting and of the best alike"""
    found = {}
    for path in sorted(glob.glob(os.path.join(out, "*", "*", "answer.csv"))):
        code, problem = path.split(os.sep)[-3:-1]
        with open(path, encoding="utf-8") as file:
            for line in file:
                if line.startswith(OVERLAP):
                    found.setdefault(problem, {})[code] = float(line.removeprefix(OVERLAP).split()[0])
    return found


def overlaps_text(found, codes):
    lines = ["## Largest overlap, m", "", "Twice the depth of the deepest point under all planes of two blocks, at the end of the trials in which the blocks "
             "stand: one setting for everything / the best setting.", "",
             "| problem | " + " | ".join(codes) + " |", "|---|" + "--:|" * len(codes)]
    for problem, values in sorted(found.items()):
        cells = [" / ".join("%.1e" % values[c] if c in values else "-" for c in (code, code + "_best")) for code in codes]
        lines.append("| %s | %s |" % (problem, " | ".join("" if c == "- / -" else c for c in cells)))
    return "\n".join(lines) + "\n\n"


def reasons_text(rows, codes):
    """why an engine stopped or cannot state a problem, each reason once"""
    found = {}
    for problem, _, _, answers in rows:
        for code in codes:
            if code in answers and answers[code].verdict in ("stopped", "cannot state"):
                found.setdefault((column(code), answers[code].verdict, answers[code].note), {})[problem] = None
    lines = ["- %s, %s: %s: %s" % (code, ", ".join(problems), verdict, note) for (code, verdict, note), problems in found.items()]
    return "\n".join(["## Reasons", ""] + lines) + "\n\n"


def settings_table(known):
    lines = ["## Settings for everything", "", "| engine | setting |", "|---|---|"]
    for name, engine in known.items():
        with open(os.path.join(HERE, engine.folder, "settings.json"), encoding="utf-8") as file:
            lines.append("| %s | %s |" % (name, setting_text({**json.load(file)["one"], **engine.extra})))
    return "\n".join(lines) + "\n"


def page(head, rows, codes):
    lines = ["<h3>%s</h3>" % head, "<table class=\"others\">", "<tr><th>problem</th><th>quantity</th>%s</tr>" % "".join("<th>%s</th>" % column(c) for c in codes)]
    for problem, name, unit, found in rows:
        cells = []
        for c in codes:
            one = found.get(c, Cell("", "not run", "", ""))
            kind = one.verdict.split()[0].lower()
            cells.append("<td class=\"%s\" title=\"%s\">%s</td>" % (kind, html.escape(one.note, True), html.escape(one.words())))
        lines.append("<tr><td>%s</td><td>%s, %s</td>%s</tr>" % (problem, html.escape(name), unit, "".join(cells)))
    return "\n".join(lines + ["</table>", ""])


def counts(rows, codes):
    """one line for each code: how many of its quantities have each verdict"""
    lines = []
    for code in codes:
        verdicts = [found[code].verdict for _, _, _, found in rows if code in found]
        failed = sum(v.startswith("FAIL") for v in verdicts)
        others = ", ".join("%d %s" % (verdicts.count(v), v) for v in ("cannot state", "stopped", "not run", "not judged"))
        lines.append("%s: %d pass, %d fail, %s" % (code, verdicts.count("pass"), failed, others))
    return lines


def points_of_sweeps(problems, known):
    """{problem: {engine: [(seconds, largest error in tolerances)]}}"""
    points = {}
    for name, engine in known.items():
        if engine.extra:
            continue  # the same sweep with other joints
        for problem, tried in judged(kept_rows(os.path.join(HERE, engine.folder, "sweep.tsv")), problems, engine).items():
            points.setdefault(problem, {})[name] = [(t.seconds, t.largest) for t in tried.values() if t.seconds > 0]
    return points


def main():
    judgement, problems, build, program, out = sys.argv[1:]
    known = engines(build, program)
    with open(judgement, encoding="utf-8", newline="") as file:
        rows = judged_rows(file)
    codes = [c + suffix for c in known for suffix in ("", "_best") if any(c + suffix in row[3] for row in rows)]
    for name, write, begin in (("results.md", markdown, INTRODUCTION), ("others.html", page, "")):
        with open(os.path.join(out, name), "w", encoding="utf-8") as file:
            file.write(begin)
            for head, suffix in HEADS:
                shown = [c for c in codes if c.endswith("_best") == bool(suffix)]
                file.write(write(head, rows, shown) if shown else "")
            if write is markdown:
                file.write(overlaps_text(overlaps_of(out), [c for c in codes if not c.endswith("_best")]))
                file.write(reasons_text(rows, codes) + settings_table(known))
    with open(os.path.join(out, "error_against_cost.svg"), "w", encoding="utf-8") as file:
        file.write(draw(points_of_sweeps(problems, known)))
    print("\n".join(counts(rows, codes)))


if __name__ == "__main__":
    main()
