#!/usr/bin/python3
"""The load factor of a proof file (proof.json.gz, app/limit/limit_proof.hpp) by other programs: CVXOPT's cone solver on the
same second-order cones, and GLPK's simplex method on cones of 16 sides around them (packages python3-cvxopt, python3-numpy).

    limit_load.py PROOF…        a line each: blocks, corners, and of each program its seconds and factor

Largest factor of the live load with Σ forces + dead + factor · live = 0 for each free body, |T| <= tangent N + cohesion at
each corner. Lengths in units of the model's size, forces in units of the mean weight."""
import gzip, json, sys, time
import cvxopt, cvxopt.glpk
import numpy as np

SIDES = 16
DENSE = 1000                                # corners: conelp's systems are dense, some minutes for as many


def lift(v): return np.array(list(v) + [0] * (3 - len(v)))
def turn(v): return np.array(v if len(v) == 3 else [0, 0] + list(v))


def free_of(body):
    free = body["free"]
    return free if len(free) == 6 else [free[0], free[1], False, False, False, free[2]]


def program(proof):
    """columns: N and two of T at each corner, then the factor; rows of the equilibrium, its right side, tangents, cohesions"""
    free = {b: body for b, body in enumerate(proof["bodies"]) if body and any(free_of(body))}
    place = {b: 6 * k for k, b in enumerate(free)}
    force = np.mean([np.linalg.norm(lift(b["dead"]["force_N"])) + np.linalg.norm(lift(b["live"]["force_N"])) for b in free.values()])
    length = np.mean([np.cbrt(b["mass_kg"] / b["density_kg_m3"]) for b in free.values()])
    rows, cols, values, tangents, cohesions = [], [], [], [], []

    def put(column, of_force, at):
        for b, sign in at:
            if b in place:
                arm = (of_force[1] - lift(free[b]["centroid_m"])) / length
                for k, x in enumerate([*(sign * of_force[0]), *(sign * np.cross(arm, of_force[0]))]):
                    if x:
                        rows.append(place[b] + k), cols.append(column), values.append(float(x))

    corner = 0
    for face in proof["faces"]:
        n = lift(face["normal"]) / np.linalg.norm(lift(face["normal"]))
        e = np.cross(n, np.eye(3)[np.argmin(abs(n))])
        e /= np.linalg.norm(e)
        for p, c in zip(face["corners_m"], face["cohesion_N"]):
            for k, axis in enumerate((n, e, np.cross(n, e))):
                put(3 * corner + k, (axis, lift(p)), zip(face["bodies"], (-1, 1)))
            tangents.append(face["tangent"]), cohesions.append(c / force)
            corner += 1
    right = np.zeros(6 * len(free))
    for b, body in free.items():
        def load(what): return [*lift(body[what]["force_N"]) / force, *turn(body[what]["moment_Nm"]) / (force * length)]
        right[place[b]:place[b] + 6] = [-x for x in load("dead")]
        for k, x in enumerate(load("live")):
            if x:
                rows.append(place[b] + k), cols.append(3 * corner), values.append(float(x))
    moves = [6 * k + i for k, body in enumerate(free.values()) for i in range(6) if free_of(body)[i]]
    balance = cvxopt.spmatrix(values, rows, cols, (6 * len(free), 3 * corner + 1))
    return len(free), corner, balance[moves, :], right[moves], tangents, cohesions


def by_cones(corners, balance, right, tangents, cohesions):
    """G x + s = h, s in cones (tangent N + cohesion, T)"""
    n = 3 * corners
    G = cvxopt.spmatrix([x for t in tangents for x in (-t, -1.0, -1.0)], range(n), range(n), (n, n + 1))
    h = cvxopt.matrix([x for c in cohesions for x in (c, 0.0, 0.0)])
    cost = cvxopt.matrix([0.0] * n + [-1.0])
    cvxopt.solvers.options.update(show_progress=False, abstol=1e-9, reltol=1e-9, feastol=1e-9)
    found = cvxopt.solvers.conelp(cost, G, h, {"l": 0, "q": [3] * corners, "s": []}, balance, cvxopt.matrix(right), kktsolver="chol")
    return found["status"], found["x"][n] if found["x"] else float("nan")


def by_sides(corners, balance, right, tangents, cohesions):
    """T·d <= tangent N + cohesion in 16 directions: the cones are inside, so the factor is no smaller"""
    n = 3 * corners
    rows, cols, values, h = [], [], [], []
    for c in range(corners):
        for k in range(SIDES):
            at = 2 * np.pi * k / SIDES
            for i, x in enumerate((-tangents[c], np.cos(at), np.sin(at))):
                rows.append(SIDES * c + k), cols.append(3 * c + i), values.append(float(x))
            h.append(float(cohesions[c]))
    G = cvxopt.spmatrix(values, rows, cols, (SIDES * corners, n + 1))
    cost = cvxopt.matrix([0.0] * n + [-1.0])
    status, x = cvxopt.glpk.lp(cost, G, cvxopt.matrix(h), balance, cvxopt.matrix(right), options=dict(msg_lev="GLP_MSG_OFF"))[:2]
    return status, x[n] if x else float("nan")


for path in sys.argv[1:]:
    proof = json.load(gzip.open(path))
    blocks, corners, balance, right, tangents, cohesions = program(proof)
    parts = [f"{blocks} blocks, {corners} corners; proof {proof['lower']} to {proof['upper']}"]
    for name, solve in (("conelp", by_cones), ("GLPK, 16 sides", by_sides)):
        if solve is by_cones and corners > DENSE:
            parts.append(f"{name} not run")
            continue
        begun = time.process_time()
        status, factor = solve(corners, balance, right, tangents, cohesions)
        parts.append(f"{name} {time.process_time() - begun:.2f} s, {factor:.9g} ({status})")
    print("; ".join(parts), flush=True)
