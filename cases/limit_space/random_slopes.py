#!/usr/bin/env python3
"""Random sliced slopes in space: critical friction by limit analysis, with dilation and without, beside distinct elements on
whole faces at two stiffnesses.

    random_slopes.py VOUSSOIR FOLDER KIND FIRST LAST     seeds; a line each, and FOLDER/random_slopes.csv

A face that dips to the east, cut by steep joints along and across it, and, by kind: `beds`, two beds that dip out of it;
`wedge`, two planes whose line plunges out of it; `columns`, a base and joints that dip steeply into it. The rock below the
lowest bed, either plane, the base is fixed. Elastic joints are soft by 1/k: their rigid limit is extrapolated."""
import csv, json, pathlib, random, subprocess, sys

STIFF = (1e9, 4e9)  # Pa/m
LONGEST = 40  # s of a run or an analysis


def slope(kind, seed):
    draw = random.Random(seed).uniform
    dip, step, text, fixed = draw(20, 40), draw(1.2, 2), [], ["bed0"]
    plane = lambda name, dip, direction, point: text.append(
        f'[[joints]]\nname = "{name}"\ndip = {dip:.4f}\ndip_direction = {direction % 360:.4f}\npoint = [{point[0]:.4f}, {point[1]:.4f}, {point[2]:.4f}]\n')
    face = draw(60, 80)
    if kind == "beds":
        for k in range(2):
            plane(f"bed{k}", dip + draw(-5, 5), 90 + draw(-20, 20), (2, 0, -4 + k * step))
    elif kind == "wedge":
        fixed = ["left", "right"]
        plane("left", draw(40, 60), 90 + draw(30, 50), (2, 0, -4))
        plane("right", draw(40, 60), 90 - draw(30, 50), (2, 0, -4))
    else:
        plane("bed0", draw(10, 25), 90 + draw(-10, 10), (2, 0, -4))
        for k in range(3):
            plane(f"column{k}", draw(68, 80), 270 + draw(-10, 10), (1 - 1.1 * k + draw(-0.2, 0.2), 0, -3))
    for k in range(0 if kind == "columns" else 2):
        plane(f"steep{k}", draw(65, 88), (90 if draw(0, 1) < 0.5 else 270) + draw(-15, 15), (-2.5 + 2.2 * k + draw(-0.5, 0.5), 0, -2))
    for k in range(1 + (draw(0, 1) < 0.5)):
        plane(f"cross{k}", draw(70, 88), (0 if draw(0, 1) < 0.5 else 180) + draw(-20, 20), (0, -0.8 + 1.6 * k + draw(-0.4, 0.4), -2))
    fix = "".join(f'[[fix]]\nbelow = ["{name}"]\n' for name in fixed)
    return f'''dimension = 3
gravity = [0, 0, -9.81]
density = 2600
statics = "newton"
[domain]
box = {{ min = [-5, -2, -6], max = [4, 2, 0] }}
[[domain.planes]]
name = "face"
dip = {face:.4f}
dip_direction = 90
point = [2, 0, -4]
keep = "below"
{"".join(text)}[slicing]
smallest_inscribed_radius = 0.05
[contact]
face = "integrated"
[[joint_properties]]
name = "rock"
normal_stiffness = 1e9
shear_stiffness = 1e8
friction_deg = 80
{fix}[[stage]]
name = "settle"
kind = "settle"
gravity_ramp_s = 0.1
[[stage]]
name = "critical"
kind = "reduce"
from_deg = 80
to_deg = 3
tolerance_deg = 0.1
[output]
frames = false
[accuracy]
error_bar = "bracket"
'''


def values(folder):
    path = folder / "results.json"
    return json.load(open(path))["values"] if path.exists() else {}


def call(program, *arguments):
    try:
        ended = subprocess.run([program, *map(str, arguments)], capture_output=True, text=True, timeout=LONGEST)
        return ended.stdout + ended.stderr
    except subprocess.TimeoutExpired:
        return f"longer than {LONGEST} s"


def judge(program, folder, kind, seed):
    folder.mkdir(parents=True, exist_ok=True)
    scene = folder / f"{seed}.toml"
    scene.write_text(slope(kind, seed))
    row = {"kind": kind, "seed": seed}
    said = call(program, "limit", scene, "--out", folder / f"{seed}_limit", "--overwrite")
    found = values(folder / f"{seed}_limit")
    for key in ("lower_bound", "least", "largest"):
        row[key] = found.get(f"critical_friction_{key}", {}).get("value")
    row["said"] = next((l[14:].strip() for l in said.splitlines() if l.startswith("  result")), said.strip()[-80:])
    row["twists"], row["self_stress"] = "twist" in said, "self-stress" in said
    for stiffness in STIFF:
        said = call(program, "run", scene, "--out", folder / f"{seed}_{stiffness:g}", "--overwrite", "--set",
                          f"joint_properties.rock.normal_stiffness={stiffness:g}", "--set", f"joint_properties.rock.shear_stiffness={stiffness / 10:g}")
        value = values(folder / f"{seed}_{stiffness:g}").get("critical_friction", {})
        row[f"run_{stiffness:g}"], row[f"bar_{stiffness:g}"] = value.get("value"), value.get("error_bar")
        row["blocks"] = next((l.split("moved")[0].strip() for l in said.splitlines() if "failed at" in l), "")
    soft, stiff = (row[f"run_{k:g}"] for k in STIFF)
    row["rigid"] = stiff + (stiff - soft) * STIFF[0] / (STIFF[1] - STIFF[0]) if soft is not None and stiff is not None else None
    return row


def main(program, folder, kind, first, last):
    folder = pathlib.Path(folder)
    rows = []
    for seed in range(int(first), int(last) + 1):
        row = judge(program, folder, kind, seed)
        rows.append(row)
        shown = {k: f"{v:.3f}" if isinstance(v, float) else v for k, v in row.items()}
        print(" ".join(f"{k}={v}" for k, v in shown.items() if k not in ("said", "blocks")), row["said"][:60], flush=True)
        with open(folder / "random_slopes.csv", "w", newline="") as file:
            table = csv.DictWriter(file, list(rows[0]))
            table.writeheader()
            table.writerows(rows)


main(*sys.argv[1:])
