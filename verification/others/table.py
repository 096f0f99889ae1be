"""The table of engines and problems from `voussoir judge`: OUT/others.md, others.html; and error_against_cost.svg from the sweeps.
usage: table.py JUDGEMENT.csv PROBLEMS BUILD PROGRAM OUT"""
import csv
import html
import os
import sys

from choose import judged
from engines import HERE, engines
from figure import draw
from sweep import kept_rows


HEADS = (("One setting for everything", ""), ("The best setting of each problem", "_best"))


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
    for name, write in (("others.md", markdown), ("others.html", page)):
        with open(os.path.join(out, name), "w", encoding="utf-8") as file:
            for head, suffix in HEADS:
                shown = [c for c in codes if c.endswith("_best") == bool(suffix)]
                file.write(write(head, rows, shown) if shown else "")
    with open(os.path.join(out, "error_against_cost.svg"), "w", encoding="utf-8") as file:
        file.write(draw(points_of_sweeps(problems, known)))
    print("\n".join(counts(rows, codes)))


if __name__ == "__main__":
    main()
