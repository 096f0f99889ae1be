"""The scene text of the adapters (scene.hpp describes it): written by the harness, read by the adapters in Python."""
import sys

import numpy as np


def numbers(values):
    return " ".join("%.17g" % x for x in values)


def scene_text(scene, settings, springs=False, welds=False):
    """scene: see Problem.scene. With springs, for codes that have joint stiffness, the joint (kn, ks, cohesion, tension), whether
    the problem is plane, and its bolts instead of the forces that replace them. With welds, for codes whose contacts cannot be
    bonded, bonded faces as springs (scene.hpp)."""
    lines = ["setting %s %.17g" % item for item in settings.items()]
    lines += ["%s %.17g" % (key, scene[key]) for key in ("duration", "output", "friction")]
    lines += ["gravity " + numbers(row) for row in scene["gravity"]]
    if springs:
        lines.append("joint " + numbers(scene["joint"]))
        lines += ["plane"] if scene["plane"] else []
        lines += ["bolt %s %s" % (b["name"], numbers([*b["from_m"], *b["to_m"], b["stiffness_N_per_m"], b["yield_N"]]))
                  for b in scene["bolts"]]
    if scene["forces"] and not (springs and scene["bolts"]):
        lines += ["share " + numbers(row) for row in scene["shares"]]
        lines += ["force %s %s" % (name, numbers(force)) for name, force in scene["forces"].items()]
    for b in scene["blocks"]:
        lines.append("block %s %s %s" % (b["name"], "fixed" if b["fixed"] else "free",
                                         numbers([b["mass"], *b["centre"], *b["turn"], *b["moments"]])))
        lines += ["%s %s" % (key, numbers(b[key])) for key in ("velocity", "spin")]
        lines.append("density %.17g" % b["density"])
        if b["box"] is not None:
            lines.append("box " + numbers(b["box"]))
        lines += ["vertex " + numbers(v) for v in b["vertices"]]
        lines += ["face %s %s" % (numbers(f["plane"]), " ".join(map(str, f["corners"]))) for f in b["faces"]]
    if welds:
        lines += ["weld %s %s %s" % (w["block"], w["fixed"], numbers([w["kn"], w["ks"], w["area"], w["strength"], *w["normal"],
                                                                      *np.ravel(w["points"])])) for w in scene["welds"]]
    return "\n".join(lines + ["end", ""])


def read_scene(lines):
    """the scene and its settings, from the lines before `end`"""
    scene, settings = dict(gravity=[], shares=[], forces={}, blocks=[], joint=None, plane=False, bolts=[]), {}
    for line in lines:
        word, *rest = line.split()
        if word == "setting":
            settings[rest[0]] = float(rest[1])
        elif word == "force":
            scene["forces"][rest[0]] = [float(x) for x in rest[1:]]
        elif word == "block":
            v = [float(x) for x in rest[2:]]
            scene["blocks"].append(dict(name=rest[0], fixed=rest[1] == "fixed", mass=v[0], centre=np.array(v[1:4]),
                                        turn=np.array(v[4:8]), moments=np.array(v[8:11]), box=None, vertices=[], faces=[]))
        elif word in ("gravity", "share"):
            scene["gravity" if word == "gravity" else "shares"].append([float(x) for x in rest])
        elif word == "joint":
            scene["joint"] = [float(x) for x in rest]
        elif word == "plane":
            scene["plane"] = True
        elif word == "bolt":
            scene["bolts"].append((rest[0], [float(x) for x in rest[1:]]))
        elif word == "vertex":
            scene["blocks"][-1]["vertices"].append([float(x) for x in rest])
        elif word == "face":
            scene["blocks"][-1]["faces"].append(dict(plane=[float(x) for x in rest[:4]], corners=[int(x) for x in rest[4:]]))
        elif word == "density":
            scene["blocks"][-1][word] = float(rest[0])
        elif word in ("velocity", "spin", "box"):
            scene["blocks"][-1][word] = np.array([float(x) for x in rest])
        elif word in ("duration", "output", "friction"):
            scene[word] = float(rest[0])
        else:
            raise ValueError("unknown word " + word)
    return scene, settings


def gravity_at(scene, time):
    table = np.array(scene["gravity"])
    return np.array([np.interp(time, table[:, 0], table[:, k]) for k in (1, 2, 3)])


def force_at(scene, name, time):
    """the force on a block besides gravity, and its moment about the centre, in world axes"""
    if name not in scene["forces"]:
        return np.zeros(6)
    table = np.array(scene["shares"])
    return np.interp(time, table[:, 0], table[:, 1]) * np.array(scene["forces"][name])


def turned(turn, vector):
    """vector turned by the quaternion w x y z"""
    axis, vector = np.array(turn[1:4]), np.array(vector, float)
    t = 2 * np.cross(axis, vector)
    return vector + turn[0] * t + np.cross(axis, t)


def product(p, q):
    """of two quaternions w x y z"""
    return np.array([p[0] * q[0] - np.dot(p[1:], q[1:]), *(p[0] * q[1:] + q[0] * p[1:] + np.cross(p[1:], q[1:]))])


def row(time, name, centre, turn, velocity, spin):
    return "%.9g %s %s" % (time, name, numbers([*centre, *turn, *velocity, *spin]))


def run_scenes(run):
    """the main function of an adapter: run(scene, setting) returns rows and the line of seconds"""
    lines = []
    for line in sys.stdin:
        if line.strip() != "end":
            lines.append(line)
            continue
        try:
            scene, settings = read_scene(lines)
            used = set()

            def setting(key, otherwise):
                used.add(key)
                return settings.get(key, otherwise)

            answer = run(scene, setting)
            if unknown := sorted(set(settings) - used):
                raise ValueError("this adapter has no setting " + unknown[0])
        except Exception as error:  # any engine may fail in its own way; the harness goes on with the next scene
            answer = ["failed " + str(error).replace("\n", " ")[:300]]
        lines = []
        print("\n".join(answer), flush=True)
