"""Voussoir itself, by files: writes a scene.toml for each scene, runs `voussoir run`, reads history.csv. Settings: kn and ks
(Pa/m, instead of the joint's); implicit (1: implicit steps, where joints have no bonds and blocks no bolts); fraction (of the stable step,
explicit); damp (viscous_ratio of the joints' dashpots); points (1: contact points instead of integrated faces); space (1: plane problems as prisms in space). usage: voussoir_adapter.py PROGRAM"""
import csv
import math
import os
import resource
import subprocess
import sys
import tempfile

import numpy as np

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), ".."))
from scene import product, row, run_scenes, turned

QUANTITIES = ("displacement", "velocity", "rotation", "angular_velocity")
UNITS = dict(displacement="m", velocity="m_per_s", rotation="deg", angular_velocity="rad_per_s")


def numbers(values):
    return "[" + ", ".join("%.17g" % x for x in values) + "]"


def block_lines(b, plane):
    world = [b["centre"] + turned(b["turn"], v) for v in b["vertices"]]
    if plane:  # the section: x to the right, z upwards
        middle = b["centre"][1]
        world = [v[[0, 2]] for v in world if v[1] > middle]
        angles = [math.atan2(v[1] - b["centre"][2], v[0] - b["centre"][0]) for v in world]
        world = [world[k] for k in np.argsort(angles)]
    lines = ["[[blocks]]", 'name = "%s"' % b["name"], "density = %.17g" % b["density"],
             "vertices = [%s]" % ", ".join(numbers(v) for v in world)]
    if b["fixed"]:
        return lines + ["fixed = true"]
    if np.any(b["velocity"]):
        lines.append("velocity = " + numbers(b["velocity"][[0, 2]] if plane else b["velocity"]))
    if np.any(b["spin"]):
        lines.append("angular_velocity = " + ("%.17g" % -b["spin"][1] if plane else numbers(b["spin"])))
    return lines


def growth(table):
    """full vector and the time within which it grows along its own direction, which is all that a scene can state"""
    first, last = np.array(table[0][1:]), np.array(table[-1][1:])
    if len(table) == 1:
        return last, 0.0
    if len(table) > 2 or np.any(first):
        raise ValueError("gravity may only grow from zero along its own direction")
    return last, table[-1][0]


def pressed(scene, plane):
    """joints are bonded when they are first in compression: a stage that presses the free block by a thousandth of its weight"""
    free = next(b for b in scene["blocks"] if not b["fixed"])
    fixed = next(b for b in scene["blocks"] if b["fixed"])
    way = fixed["centre"] - free["centre"]
    push = 1e-2 * free["mass"] * way / np.linalg.norm(way)
    return ["[[stage]]", 'name = "press"', 'kind = "settle"', "gravity_to = 0", "bond = true",
            'force = [{ name = "push", bodies = ["%s"], force = %s }]' % (free["name"], numbers(push[[0, 2]] if plane else push))]


def is_bonded(scene):
    return scene["joint"][2] > 0 or scene["joint"][3] > 0


def implicit(scene, setting):
    """refused for bonds and bolts, which are then stepped explicitly"""
    return setting("implicit", 0) and not is_bonded(scene) and not scene["bolts"]


def scene_toml(scene, setting):
    plane = scene["plane"] and not setting("space", 0)
    gravity, ramp = growth(scene["gravity"])
    kn, ks, cohesion, tension = scene["joint"]
    kn, ks = setting("kn", kn), setting("ks", ks)
    lines = ["dimension = %d" % (2 if plane else 3)]
    if np.any(gravity):
        lines.append("gravity = " + numbers(gravity[[0, 2]] if plane else gravity))
    lines += ["[[joint_properties]]", 'name = "joint"', "normal_stiffness = %.17g" % kn, "shear_stiffness = %.17g" % ks,
              "friction_deg = %.17g" % math.degrees(math.atan(scene["friction"]))]
    bonded = is_bonded(scene)
    lines += ["cohesion = %.17g" % cohesion, "tension = %.17g" % tension, 'bonds = "by_stage"',
              "sub_contacts = 32"] if bonded else []
    for b in scene["blocks"]:
        lines += block_lines(b, plane)
        if not b["fixed"]:
            lines += ["[[monitors]]", 'name = "%s"' % b["name"], 'bodies = ["%s"]' % b["name"],
                      "quantities = [%s]" % ", ".join('"%s"' % q for q in QUANTITIES)]
    for name, v in scene["bolts"]:
        ends = [v[0:3:2], v[3:6:2]] if plane else [v[0:3], v[3:6]]
        lines += ["[[bolts]]", 'name = "%s"' % name, "from = " + numbers(ends[0]), "to = " + numbers(ends[1]),
                  "stiffness = %.17g" % v[6], "yield = %.17g" % v[7]]
    lines += [] if setting("points", 0) or bonded else ["[contact]", 'face = "integrated"']
    lines += ["[time]", "fraction = %g" % setting("fraction", 0.1), "[output]", "frames = false",
              "history_interval_s = %.17g" % scene["output"]]
    lines += pressed(scene, plane) if bonded else []
    lines += ["[[stage]]", 'name = "run"', 'kind = "run"',
              "duration_s = %.17g" % scene["duration"],
              *(['time = { integration = "implicit" }'] if implicit(scene, setting) else []), "damping = { local = 0, viscous_ratio = %g }" % setting("damp", 0.1)]
    lines += ["gravity_ramp_s = %.17g" % ramp] if ramp > 0 else []
    lines += ["gravity_to = 1"] if bonded and ramp > 0 else []
    lines += ["install = [%s]" % ", ".join('"%s"' % name for name, _ in scene["bolts"])] if scene["bolts"] else []
    return "\n".join(lines) + "\n", plane


def motion(line, b, plane):
    """the row of a block from a line of history.csv"""
    found = {}
    for q in QUANTITIES:
        axes = ([""] if q in ("rotation", "angular_velocity") else ["_x", "_y"]) if plane else ["_x", "_y", "_z"]
        v = [float(line["%s_%s%s_%s" % (b["name"], q, axis, UNITS[q])]) for axis in axes]
        if plane:  # counter-clockwise in x, z is a turn about -y
            v = [0, -v[0], 0] if len(v) == 1 else [v[0], 0, v[1]]
        found[q] = np.array(v)
    turn = np.radians(found["rotation"])
    angle = np.linalg.norm(turn)
    axis = turn / angle if angle > 0 else turn
    turn = product(np.array([math.cos(angle / 2), *(math.sin(angle / 2) * axis)]), b["turn"])
    return row(float(line["time_s"]), b["name"], b["centre"] + found["displacement"], turn, found["velocity"],
               found["angular_velocity"])


def run(scene, setting):
    if scene["forces"]:
        raise ValueError("this adapter states bolts, not forces")
    text, plane = scene_toml(scene, setting)
    with tempfile.TemporaryDirectory() as folder:
        path, out = os.path.join(folder, "scene.toml"), os.path.join(folder, "out")
        with open(path, "w", encoding="utf-8") as file:
            file.write(text)
        before = resource.getrusage(resource.RUSAGE_CHILDREN)
        done = subprocess.run([sys.argv[1], "run", path, "--out", out], capture_output=True, text=True)
        after = resource.getrusage(resource.RUSAGE_CHILDREN)
        spent = after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime
        history = os.path.join(out, "history.csv")
        if not os.path.exists(history):
            raise ValueError((done.stderr + done.stdout).strip()[-250:])
        with open(history, encoding="utf-8") as file:
            lines = list(csv.DictReader(file))
    began = float(lines[-1]["time_s"]) - scene["duration"]  # after a stage that presses
    lines = [dict(line, time_s=float(line["time_s"]) - began) for line in lines if float(line["time_s"]) >= began - 1e-12]
    free = [b for b in scene["blocks"] if not b["fixed"]]
    return [motion(line, b, plane) for line in lines for b in free] + ["cpu %.6f steps %d" % (spent, len(lines))]


if __name__ == "__main__":
    run_scenes(run)
