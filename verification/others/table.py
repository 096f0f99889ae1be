"""The table of engines and problems: OUT/others.md, others.html, others.csv, and error_against_cost.svg from the sweeps. Judges by
reference.json of PROBLEMS. usage: table.py PROBLEMS BUILD PROGRAM OUT"""
import csv
import html
import os
import sys

from choose import judged
from engines import HERE, engines
from score import error, read_reference, target
from figure import draw
from sweep import kept_rows


HEADS = (("One setting for everything", ""), ("The best setting of each problem", "_best"))


class Cell:
    """what one code says about one quantity"""

    def __init__(self, text, verdict, seconds, note):
        self.text, self.verdict, self.seconds, self.note = text, verdict, seconds, note

    def words(self):
        if self.verdict in ("cannot state", "not run"):
            return self.verdict
        return "%s, %s%s" % (self.text, self.verdict, ", %s s" % self.seconds if self.seconds else "")


def read_answers(path):
    """(model, setting, {quantity: row}) of an answer.csv"""
    if not os.path.exists(path):
        return None
    head, lines = {}, []
    with open(path, encoding="utf-8", newline="") as file:
        for line in file:
            if line.startswith("# "):
                key, _, value = line[2:].strip().partition(": ")
                head[key] = value
            else:
                lines.append(line)
    return head["model"], head.get("setting", ""), {row["quantity"]: row for row in csv.DictReader(lines)}


def cell(row, quantity, model):
    if row is None or row["value"] == "":
        note = row["note"] if row else ""
        return Cell("", "stopped" if note else "not run", "", note)
    if row["value"] == "cannot state":
        return Cell("", "cannot state", "", row["note"])
    value, bounds = float(row["value"]), target(quantity, model) if quantity else None
    if bounds is None:
        return Cell("%.6g" % value, "not judged", row["seconds"], row["note"])
    distance, tolerance = error(value, bounds)
    verdict = "pass" if abs(distance) <= tolerance else "FAIL %+.3g" % distance
    return Cell("%.6g" % value, verdict, row["seconds"], row["note"])


def cells_of(problems, out, codes):
    """[(problem, quantity, unit, {code: Cell})], and the codes' settings {code: {problem: text}}"""
    rows, settings = [], {}
    for problem in sorted(os.listdir(problems)):
        references = read_reference(os.path.join(problems, problem))
        answers = {code: read_answers(os.path.join(out, code, problem, "answer.csv")) for code in codes}
        names = {}
        for code, answer in answers.items():
            if answer:
                settings.setdefault(code, {})[problem] = answer[1]
                names.update({name: row["unit"] for name, row in answer[2].items()})
        for name, unit in names.items():
            found = {code: cell(a[2].get(name), references.get(name), a[0]) for code, a in answers.items() if a}
            rows.append((problem, name, unit, found))
    return rows, settings


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
    """one line for each code: passed, failed, stopped, cannot state"""
    lines = []
    for code in codes:
        verdicts = [found[code].verdict.split()[0] for _, _, _, found in rows if code in found]
        lines.append("%s: %d pass, %d fail, %d stopped, %d cannot state, %d not judged, %d not run" % (
            code, *(verdicts.count(v) for v in ("pass", "FAIL", "stopped", "cannot")), verdicts.count("not"),
            len(rows) - len(verdicts)))
    return lines


def points_of_sweeps(problems, known):
    """{problem: {engine: [(seconds, largest error in tolerances)]}}"""
    points = {}
    for name, engine in known.items():
        if engine.extra:
            continue  # the same sweep with other joints
        for problem, tried in judged(kept_rows(os.path.join(HERE, engine.folder, "sweep.tsv")), problems, engine.model).items():
            points.setdefault(problem, {})[name] = [(t.seconds, t.largest) for t in tried.values()]
    return points


def main():
    problems, build, program, out = sys.argv[1:]
    known = engines(build, program)
    codes = [c + suffix for c in known for suffix in ("", "_best") if os.path.isdir(os.path.join(out, c + suffix))]
    rows, settings = cells_of(problems, out, codes)
    for name, write in (("others.md", markdown), ("others.html", page)):
        with open(os.path.join(out, name), "w", encoding="utf-8") as file:
            for head, suffix in HEADS:
                shown = [c for c in codes if c.endswith("_best") == bool(suffix)]
                file.write(write(head, rows, shown) if shown else "")
    with open(os.path.join(out, "others.csv"), "w", encoding="utf-8", newline="") as file:
        table = csv.writer(file, lineterminator="\n")
        table.writerow(["problem", "quantity", "unit", "code", "value", "verdict", "seconds", "setting", "note"])
        for problem, name, unit, found in rows:
            for code, one in found.items():
                table.writerow([problem, name, unit, code, one.text, one.verdict, one.seconds, settings[code][problem], one.note])
    with open(os.path.join(out, "error_against_cost.svg"), "w", encoding="utf-8") as file:
        file.write(draw(points_of_sweeps(problems, known)))
    print("\n".join(counts(rows, codes)))


if __name__ == "__main__":
    main()
