"""Checks proofs of load factors (proof.json.gz, app/limit/limit_proof.hpp) in fractions, without any code of Voussoir; with
--tamper also that tampered copies of the small ones are refused.

    check_limit_proof.py [--tamper] FILE…       exit code 1: a bound is not proven, or a tampered proof was accepted

Exactly: forces are in their cones and balance the loads; velocities open all joints by tan(friction) of their slip, and
their power gives the upper bound. In doubles, to 1e-9 of the size: loads, friction and cohesion are the stated ones, and
the joints are all areas in which faces of two blocks lie on each other. The plane is a slice of space, 1 size thick.
"""
import copy, gzip, itertools, json, math, random, sys
from fractions import Fraction as Q

ROUNDING = 1e-9                             # of the size, or of the number itself
TURNED = 1e-6                               # a normal, of faces whose vertices are rounded
TINY = 1e-9                                 # of the smaller face's box: an area below it is none


def lift(v): return list(v) + [0] * (3 - len(v))
def turn(v): return list(v) if len(v) == 3 else [0, 0] + list(v)
def add(a, b, t=1): return [x + t * y for x, y in zip(a, b)]
def dot(a, b): return sum(x * y for x, y in zip(a, b))
def cross(a, b): return [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
def size(a): return math.sqrt(dot(a, a))
def exact(v): return [Q(x) for x in v]
def near(a, b, scale): return abs(a - b) <= ROUNDING * scale


def root(q, up):
    """the square root of a fraction to 2^-200, rounded up or down"""
    return Q(math.isqrt(q.numerator * 4**200 // q.denominator) + up, 2**200)


def held_free(body):
    free = body["free"]
    return free if len(free) == 6 else [free[0], free[1], False, False, False, free[2]]


def forces_hold(proof):
    lower, unit, left = Q(proof["lower"]), Q(2) ** proof["force_exponent"], {}
    for b, body in enumerate(proof["bodies"]):
        if body:
            parts = [exact(lift(body[k]["force_N"]) + turn(body[k]["moment_Nm"])) for k in ("dead", "live")]
            left[b] = [add(parts[0], parts[1], lower), exact(lift(body["centroid_m"]))]
    for face in proof["faces"]:
        n, tangent = exact(lift(face["normal"])), Q(face["tangent"])
        nn = dot(n, n)
        for p, c, f in zip(face["corners_m"], face["cohesion_N"], face["forces"]):
            p, f = exact(lift(p)), lift([int(x, 16) * unit for x in f])
            fn = dot(f, n)
            most = tangent * fn + (Q(c) * root(nn, 0) if c else 0)
            if fn < 0 or dot(f, f) * nn - fn * fn > most * most:
                return False
            for b, sign in zip(face["bodies"], (-1, 1)):
                left[b][0] = add(left[b][0], f + cross(add(p, left[b][1], -1), f), sign)
    return all(not free or r == 0 for b in left for r, free in zip(left[b][0], held_free(proof["bodies"][b])))


def velocities_hold(proof):
    against, power, moving = Q(0), Q(0), {}
    for b, body in enumerate(proof["bodies"]):
        if body:
            v, w = exact(lift(body["velocity"])), exact(turn(body["spin_1_m"]))
            if any(x != 0 and not free for x, free in zip(v + w, held_free(body))):
                return False
            moving[b] = (v, w, exact(lift(body["centroid_m"])))
            against -= dot(exact(lift(body["dead"]["force_N"]) + turn(body["dead"]["moment_Nm"])), v + w)
            power += dot(exact(lift(body["live"]["force_N"]) + turn(body["live"]["moment_Nm"])), v + w)
    for face in proof["faces"]:
        n, tangent = exact(lift(face["normal"])), Q(face["tangent"])
        nn = dot(n, n)
        for p, c in zip(face["corners_m"], face["cohesion_N"]):
            a, b = [add(moving[b][0], cross(moving[b][1], add(exact(lift(p)), moving[b][2], -1))) for b in face["bodies"]]
            u = add(b, a, -1)
            un = dot(u, n)
            slip = dot(u, u) * nn - un * un
            if un < 0 or tangent * tangent * slip > un * un:
                return False
            against += Q(c) * root(slip / nn, 1) if c and slip else 0
    return power > 0 and against <= Q(proof["upper"]) * power


def loads_hold(proof):
    if not any(proof["loads"]["dead"]["acceleration_m_s2"] == a for a in (proof["gravity_m_s2"], [0] * proof["dimension"])):
        return False
    for kind, parts in proof["loads"].items():
        for b, body in enumerate(proof["bodies"]):
            if not body:
                continue
            force, moment = [body["mass_kg"] * x for x in lift(parts["acceleration_m_s2"])], [0, 0, 0]
            for other in parts["others"]:
                if other["body"] == b:
                    arm = add(lift(other["point_m"]), lift(body["centroid_m"]), -1) if "point_m" in other else [0, 0, 0]
                    force = add(force, lift(other["force_N"]))
                    moment = add(moment, add(turn(other.get("moment_Nm", [0])), cross(arm, lift(other["force_N"]))))
            scale, stated = size(force), body[kind]
            if not all(near(x, y, scale) for x, y in zip(lift(stated["force_N"]), force)):
                return False
            if not all(near(x, y, scale * proof["size"] + size(moment)) for x, y in zip(turn(stated["moment_Nm"]), moment)):
                return False
    return True


def area_of(polygon):
    """twice the area as a vector, and the centroid"""
    o, total, middle = polygon[0], [0, 0, 0], [0, 0, 0]
    fan = [cross(add(p, o, -1), add(q, o, -1)) for p, q in zip(polygon[1:], polygon[2:])]
    total = [sum(t[k] for t in fan) for k in range(3)]
    weights = [dot(t, total) for t in fan]
    for w, p, q in zip(weights, polygon[1:], polygon[2:]):
        middle = add(middle, add(add(o, p), q), w / (3 * sum(weights)) if sum(weights) else 0)
    return total, middle


def joints_hold(proof):
    for face in proof["faces"]:
        properties, c = proof["properties"][face["properties"]], face["cohesion_Pa"]
        if face["friction_rad"] != properties["friction_rad"] or c not in (0, properties["cohesion_Pa"]):
            return False
        if not abs(face["tangent"] - math.tan(face["friction_rad"])) <= 1e-14 * face["tangent"]:
            return False
        total, middle = area_of(polygon_of(face["corners_m"], proof))
        whole = c * size(total) / 2 / (proof["size"] if proof["dimension"] == 2 else 1)
        shares = [x / whole for x in face["cohesion_N"]] if whole else [0]
        place = [sum(s * x for s, x in zip(shares, axis)) for axis in zip(*face["corners_m"])] if whole else middle
        if not whole and any(face["cohesion_N"]) or whole and not near(sum(shares), 1, 1) or min(shares) < 0:
            return False
        if not all(near(x, y, proof["size"]) for x, y in zip(place, middle[:proof["dimension"]])):
            return False
    return True


def polygon_of(points, proof):
    """of the plane: as high as the scene is large, in both directions"""
    if proof["dimension"] == 3:
        return [list(p) for p in points]
    h = proof["size"] / 2
    return [[*points[0], -h], [*points[1], -h], [*points[1], h], [*points[0], h]]


def outer_faces(body, proof):
    found = []
    for part in body["parts"]:
        middle = [sum(axis) / len(part["vertices_m"]) for axis in zip(*part["vertices_m"])]
        for loop in part["faces"]:
            polygon = polygon_of([part["vertices_m"][i] for i in loop], proof)
            total, centre = area_of(polygon)
            if size(total) > 0:
                n = [x / size(total) for x in total]
                outward = dot(n, add(centre, lift(middle), -1)) > 0
                box = [(min(axis), max(axis)) for axis in zip(*polygon)]
                found.append((polygon if outward else polygon[::-1], n if outward else [-x for x in n], box))
    return found


def solid_holds(body, proof):
    """mass and centroid are those of its parts: simplices from a vertex"""
    d, volume, moment = proof["dimension"], 0, [0, 0, 0]
    for part in body["parts"]:
        vertices = [lift(v) for v in part["vertices_m"]]
        for loop in part["faces"]:
            points, o = [add(vertices[i], vertices[0], -1) for i in loop], vertices[0]
            for p, q in [points] if d == 2 else zip(points[1:], points[2:]):
                v = cross(p, q)[2] / 2 if d == 2 else dot(points[0], cross(p, q)) / 6
                corners = [p, q] if d == 2 else [points[0], p, q]
                volume += v
                moment = add(moment, add(o, [sum(axis) / (d + 1) for axis in zip(*corners)]), v)
    return (volume != 0 and near(abs(volume) * body["density_kg_m3"], body["mass_kg"], body["mass_kg"])
            and all(near(x / volume, y, proof["size"]) for x, y in zip(moment, lift(body["centroid_m"]))))


def beyond(polygon, point, p, q, n):
    """how far a point is inside of the edge from p to q of a face with this normal"""
    along = add(q, p, -1)
    return dot(cross(n, along), add(point, p, -1)) / size(along) if size(along) else 0


def on_face(points, face, tolerance):
    polygon, n, _ = face
    return all(abs(dot(n, add(x, polygon[0], -1))) <= tolerance for x in points) and all(
        beyond(polygon, x, p, q, n) >= -tolerance for p, q in zip(polygon, polygon[1:] + polygon[:1]) for x in points)


def overlap(a, b):
    """the part of face a above and below face b, which looks the other way"""
    polygon, other = a[0], b[0][::-1]
    for p, q in zip(other, other[1:] + other[:1]):
        inside = [beyond(other, x, p, q, a[1]) for x in polygon]
        cut = []
        for x, y, s, t in zip(polygon, polygon[1:] + polygon[:1], inside, inside[1:] + inside[:1]):
            cut += ([x] if s >= 0 else []) + ([add(x, add(y, x, -1), s / (s - t))] if (s >= 0) != (t >= 0) else [])
        polygon = cut
    return polygon


def boxes_meet(a, b, tolerance):
    return all(lo <= top + tolerance and low <= hi + tolerance for (lo, hi), (low, top) in zip(a, b))


def geometry_holds(proof):
    tolerance = ROUNDING * proof["size"]
    bodies = {b: outer_faces(body, proof) for b, body in enumerate(proof["bodies"]) if body}
    if not all(solid_holds(proof["bodies"][b], proof) for b in bodies):
        return False
    listed = {}
    for face in proof["faces"]:
        polygon, n = polygon_of(face["corners_m"], proof), lift(face["normal"])
        sides = [[k for k, own in enumerate(bodies[b]) if size(add(own[1], n, -sign)) < TURNED and on_face(polygon, own, tolerance)]
                 for b, sign in zip(face["bodies"], (1, -1))]
        if face["bodies"][0] == face["bodies"][1] or not sides[0] or not sides[1]:
            return False
        for i, j in itertools.product(*sides):
            key = frozenset([(face["bodies"][0], i), (face["bodies"][1], j)])
            listed[key] = listed.get(key, 0) + size(area_of(polygon)[0]) / 2
    hulls = {b: [(min(f[2][k][0] for f in faces), max(f[2][k][1] for f in faces)) for k in range(3)] for b, faces in bodies.items()}
    order = sorted(hulls, key=lambda b: hulls[b][0][0])
    for place, a in enumerate(order):
        for b in itertools.takewhile(lambda b: hulls[b][0][0] <= hulls[a][0][1] + tolerance, order[place + 1:]):
            if not boxes_meet(hulls[a], hulls[b], tolerance) or not any(held_free(proof["bodies"][a]) + held_free(proof["bodies"][b])):
                continue
            for (i, f), (j, g) in itertools.product(*[[(k, f) for k, f in enumerate(bodies[x]) if boxes_meet(f[2], hulls[y], tolerance)]
                                                      for x, y in ((a, b), (b, a))]):
                if dot(f[1], g[1]) > -0.9 or not boxes_meet(f[2], g[2], tolerance):
                    continue
                common = overlap(f, g)
                if len(common) < 3 or any(abs(dot(g[1], add(x, g[0][0], -1))) > tolerance for x in common):
                    continue
                edges = sum(size(add(p, q, -1)) for p, q in zip(common, common[1:] + common[:1]))
                least = TINY * min(sum((hi - lo)**2 for lo, hi in x[2]) for x in (f, g)) + 4 * tolerance * edges
                if abs(size(area_of(common)[0]) / 2 - listed.get(frozenset([(a, i), (b, j)]), 0)) > least:
                    return False
    return True


def is_proven(proof):
    corners = [lift(p) for face in proof["faces"] for p in face["corners_m"]]
    proof["size"] = corners and max(max(axis) - min(axis) for axis in zip(*corners))
    low, up = proof["lower"], proof["upper"]
    return (bool(corners) and (low is not None or up is not None) and (low is None or up is None or low <= up)
            and all(proof["dimension"] <= len(f["corners_m"]) == len(f["cohesion_N"]) == len(f.get("forces", f["corners_m"])) for f in proof["faces"])
            and joints_hold(proof) and loads_hold(proof) and (low is None or forces_hold(proof))
            and (up is None or velocities_hold(proof)) and geometry_holds(proof))


def tampered(proof, choice):
    """a copy in which one thing that matters is wrong; None: the proof has nothing of that kind"""
    wrong, d = copy.deepcopy(proof), proof["dimension"]
    face = choice.choice(wrong["faces"])
    k, change = choice.randrange(len(face["corners_m"])), choice.choice([-1, 1]) * 10 ** choice.uniform(-6, -1)
    side, axis = choice.randrange(2), choice.randrange(d)
    body, sign = wrong["bodies"][face["bodies"][side]], (-1, 1)[side]
    kind = choice.choice(KINDS)
    if not all(body["free"]) and kind in ("force", "push", "forces", "heavier", "load", "velocity", "centroid", "corner", "moved"):
        return kind, None
    if kind in ("force", "push", "forces", "lower") and proof["lower"] is None or kind in ("upper", "velocity") and proof["upper"] is None:
        return kind, None
    if kind == "force":         # by its last digit
        face["forces"][k][axis] = format(int(face["forces"][k][axis], 16) + 1, "x")
    elif kind == "push":        # every corner presses more
        face["forces"] = [[format(int(x, 16) + int(n * 2**20), "x") for x, n in zip(f, face["normal"])] for f in face["forces"]]
    elif kind == "forces":
        face["forces"] = [[format(-int(x, 16), "x") for x in f] for f in face["forces"]]
    elif kind == "lower":
        wrong["lower"] += abs(change) * 1e-6
    elif kind == "upper":
        wrong["upper"] -= abs(change) * 1e-6 * (1 + abs(wrong["upper"]))
    elif kind == "velocity":    # the joint closes
        body["velocity"] = [v - sign * n * 3 for v, n in zip(body["velocity"], face["normal"])]
    elif kind == "tangent":
        face["tangent"] = face["tangent"] * (1 + abs(change)) + 1e-12
    elif kind == "friction":
        face["friction_rad"] += abs(change)
        face["tangent"] = math.tan(face["friction_rad"])
    elif kind == "cohesion":
        face["cohesion_Pa"] += 1
    elif kind == "share":
        face["cohesion_N"][k] += abs(change) * (1 + face["cohesion_N"][k])
    elif kind == "mass":
        body["mass_kg"] *= 1 + change
    elif kind == "heavier":     # and the loads with it
        for part in (body["dead"]["force_N"], body["live"]["force_N"]):
            part[:] = [x * (1 + change) for x in part]
        body["mass_kg"] *= 1 + change
        body["density_kg_m3"] *= 1 + change
    elif kind == "load":
        body[choice.choice(["dead", "live"])]["force_N"][axis] += change * body["mass_kg"]
    elif kind == "acceleration":
        wrong["loads"][choice.choice(["dead", "live"])]["acceleration_m_s2"][axis] += change
    elif kind == "corner":      # with its force
        for of_corners in ("corners_m", "cohesion_N", "forces"):
            face.get(of_corners, [0] * 9).pop(k)
    elif kind == "moved":
        face["corners_m"][k] = add(face["corners_m"][k], [change * proof["size"] if i == axis else 0 for i in range(d)])
    elif kind == "face":
        wrong["faces"].remove(face)
    elif kind == "twice":       # a joint that is not there
        wrong["faces"].append(dict(face, forces=[["0"] * d] * len(face["corners_m"])))
    elif kind == "normal":
        face["normal"] = add(face["normal"], [change + math.copysign(1e-5, change) if i == axis else 0 for i in range(d)])
    elif kind == "sides":
        face["bodies"].reverse()
    elif kind == "centroid":
        body["centroid_m"][axis] += change * proof["size"]
    elif kind == "vertex":
        choice.choice(choice.choice(body["parts"])["vertices_m"])[axis] += change * proof["size"]
    return kind, wrong


KINDS = ("force push forces lower upper velocity tangent friction cohesion share mass heavier load acceleration corner moved "
         "face twice normal sides centroid vertex").split()
MOST_CORNERS = 120  # of a proof that is tampered with
proofs, unproven = {}, []
names = [name for name in sys.argv[1:] if name != "--tamper"]
for name in names:
    with (gzip.open if name.endswith(".gz") else open)(name) as file:
        proofs[name] = json.load(file)
    if not is_proven(proofs[name]):
        unproven.append(name)
print(f"{len(proofs)} proofs of load factors, {len(unproven)} not proven {unproven}")
if "--tamper" not in sys.argv:
    sys.exit(1 if unproven else 0)
small = [p for p in proofs.values() if sum(len(f["corners_m"]) for f in p["faces"]) <= MOST_CORNERS and is_proven(p)]
choice, refused, accepted = random.Random(1), {kind: 0 for kind in KINDS}, []
while small and sum(refused.values()) + len(accepted) < 1000:
    kind, wrong = tampered(choice.choice(small), choice)
    if wrong is not None and is_proven(wrong):
        accepted.append(kind)
    elif wrong is not None:
        refused[kind] += 1
print(f"{sum(refused.values())} of 1000 tampered proofs refused {accepted[:5]}: {refused}")
sys.exit(1 if unproven or accepted or not small else 0)
