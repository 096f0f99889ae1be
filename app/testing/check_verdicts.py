"""Checks the proofs in blocks_verdicts.json without any code of Voussoir, then that tampered copies are refused.

    check_verdicts.py FILE…          exit code 1: a verdict is not proven, or a tampered one was accepted

A motion v is proven by R = v - sum N n, N >= 0, n.v >= 0 and N n.v = 0: the projection of the load R onto the cone of
directions that close no face, which is unique. A direction of the cone proves that a block is removable, positive weights
with sum w n = 0 over normals that span the space that it is not.
"""
import copy, json, math, random, sys

CLOSING = 2e-9    # sine by which a face may be closed, and its rounding
ROUNDING = 1e-8   # of the load


def dot(a, b):
    return sum(x * y for x, y in zip(a, b))


def size(a):
    return math.sqrt(dot(a, a))


def close(a, b, scale):
    return abs(a - b) <= ROUNDING * scale


def spans(normals):
    rest, found = [list(n) for n in normals], 0
    while rest and max(map(size, rest)) > 1e-7:
        first = max(rest, key=size)
        unit = [x / size(first) for x in first]
        rest = [[x - dot(n, unit) * u for x, u in zip(n, unit)] for n in rest]
        found += 1
    return found == len(normals[0])


def is_proven(entry):
    verdict, surface = entry["verdict"], entry["surface_m2"]
    enclosed = abs(surface - entry["contact_area_m2"]) < 1e-9 * surface
    if verdict == "enclosed" or enclosed:
        return verdict == "enclosed" and enclosed
    faces, load = entry["faces"], entry["load_N"]
    normals, forces = [f["normal"] for f in faces], [f["normal_force_N"] for f in faces]
    scale = size(load)
    if not all(close(size(n), 1, 1) for n in normals) or not all(f >= 0 for f in forces):
        return False
    if not close(sum(f["area_m2"] for f in faces), entry["contact_area_m2"], surface):
        return False
    motion = entry.get("motion_N", [0] * len(load))
    pressed = [v - sum(f * n[k] for f, n in zip(forces, normals)) for k, v in enumerate(motion)]
    if verdict != "tapered" and not close(size([p - r for p, r in zip(pressed, load)]), 0, scale):
        return False
    if verdict == "tapered":
        weights = [f.get("weight", 0) for f in faces]
        total = [sum(w * n[k] for w, n in zip(weights, normals)) for k in range(len(load))]
        return bool(faces) and min(weights) > 0 and spans(normals) and close(size(total), 0, sum(weights))
    direction = entry.get("direction", motion)
    length = size(direction)
    if not length > 0 or any(dot(n, direction) < -CLOSING * length for n in normals):
        return False
    if verdict == "stable":
        return "motion_N" not in entry and close(length, 1, 1)
    if verdict not in ("slides", "falls", "lifts") or not close(length, entry.get("driving_N", 0), scale):
        return False
    if verdict == "slides" and not any(f > 0 for f in forces) or verdict != "slides" and any(f > 0 for f in forces):
        return False
    if any(f > 0 and dot(n, direction) > CLOSING * length for f, n in zip(forces, normals)):
        return False
    friction = sum(f * face["tan_friction"] for f, face in zip(forces, faces))
    cohesion = sum(f["cohesion_N"] for f in faces if abs(dot(f["normal"], direction)) <= 1e-9 * length)
    resistance = friction + cohesion + entry.get("bolts_N", 0)
    return (close(friction, entry["friction_N"], scale) and close(cohesion, entry["cohesion_N"], scale)
            and close(entry["factor"] * length, resistance, scale + resistance))


def tampered(entry, choice):
    """a copy in which one number or word that matters is wrong; None: the entry has nothing of that kind"""
    copied = copy.deepcopy(entry)
    wrong = 1 + choice.choice([-1, 1]) * 10 ** choice.uniform(-4, 0.5)
    kinds = ["verdict", "surface"] if entry["verdict"] == "enclosed" else ["verdict", "normal", "load", "proof", "factor"]
    kind = choice.choice(kinds)
    if kind == "verdict":
        words = ["enclosed", "tapered", "stable", "slides", "falls"]
        copied["verdict"] = choice.choice([w for w in words if w != entry["verdict"]])
    elif kind == "surface":
        copied["surface_m2"] *= wrong
    elif kind == "normal":
        face = choice.choice(copied["faces"])
        face["normal"] = [wrong * x for x in face["normal"]]
    elif kind == "load" and entry["verdict"] != "tapered":
        copied["load_N"] = [wrong * x for x in copied["load_N"]]
    elif kind == "proof" and entry["verdict"] == "tapered":
        choice.choice(copied["faces"])["weight"] *= wrong
    elif kind == "proof" and any(f["normal_force_N"] > 0 for f in copied["faces"]):
        choice.choice([f for f in copied["faces"] if f["normal_force_N"] > 0])["normal_force_N"] *= wrong
    elif kind == "factor" and entry.get("factor"):
        copied["factor"] *= wrong
    else:
        return None
    return copied


entries = [e for name in sys.argv[1:] for data in [json.load(open(name))] for e in data["verdicts"] + data["clusters"]]
unproven = [e["blocks"] for e in entries if not is_proven(e)]
print(f"{len(entries)} verdicts, {len(unproven)} not proven {unproven[:5]}")
choice, refused, accepted = random.Random(1), 0, []
interesting = [e for e in entries if e["verdict"] != "enclosed"]
while refused + len(accepted) < 1000:
    copied = tampered(choice.choice(choice.choice([entries, interesting])), choice)
    if copied is not None and is_proven(copied):
        accepted.append(copied["blocks"])
    elif copied is not None:
        refused += 1
print(f"{refused} of 1000 tampered verdicts refused {accepted[:5]}")
sys.exit(1 if unproven or accepted or not entries else 0)
