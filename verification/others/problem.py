"""A problem's blocks.json, and the scene that it states at one value of its search parameter. SI units, degrees in files."""
import json
import math
import os

import numpy as np


class CannotState(Exception):
    """what the problem asks has no words in the scene text of the engines"""


def turn_matrix(axis, angle_deg):
    """Rodrigues' rotation about an axis through the origin"""
    x, y, z = np.array(axis, float) / np.linalg.norm(axis)
    k = np.array([[0, -z, y], [z, 0, -x], [-y, x, 0]])
    a = math.radians(angle_deg)
    return np.eye(3) + math.sin(a) * k + (1 - math.cos(a)) * (k @ k)


def matrix_of(q):
    """of the quaternion w x y z, normalised"""
    w, x, y, z = np.array(q, float) / np.linalg.norm(q)
    return np.array([[1 - 2 * (y * y + z * z), 2 * (x * y - w * z), 2 * (x * z + w * y)],
                     [2 * (x * y + w * z), 1 - 2 * (x * x + z * z), 2 * (y * z - w * x)],
                     [2 * (x * z - w * y), 2 * (y * z + w * x), 1 - 2 * (x * x + y * y)]])


def quaternion_of(m):
    """w x y z of a rotation matrix: the eigenvector of the largest eigenvalue of Bar-Itzhack's matrix (2000)"""
    k = np.array([[m[0, 0] - m[1, 1] - m[2, 2], m[1, 0] + m[0, 1], m[2, 0] + m[0, 2], m[2, 1] - m[1, 2]],
                  [m[1, 0] + m[0, 1], m[1, 1] - m[0, 0] - m[2, 2], m[2, 1] + m[1, 2], m[0, 2] - m[2, 0]],
                  [m[2, 0] + m[0, 2], m[2, 1] + m[1, 2], m[2, 2] - m[0, 0] - m[1, 1], m[1, 0] - m[0, 1]],
                  [m[2, 1] - m[1, 2], m[0, 2] - m[2, 0], m[1, 0] - m[0, 1], m[0, 0] + m[1, 1] + m[2, 2]]])
    x, y, z, w = np.linalg.eigh(k)[1][:, 3]
    return np.array([w, x, y, z]) * (1 if w >= 0 else -1)


def mass_properties(vertices, faces, density):
    """mass, centre and inertia about the centre, by tetrahedra from the mean vertex over the triangles of the faces"""
    points = np.array(vertices, float)
    inner = points.mean(0)
    volume, first, second = 0.0, np.zeros(3), np.zeros((3, 3))
    for corners in faces:
        for k in range(1, len(corners) - 1):
            a, b, c = (points[corners[i]] - inner for i in (0, k, k + 1))
            v = np.dot(a, np.cross(b, c)) / 6
            rows = np.array([a, b, c, a + b + c])
            volume += v
            first += v * (a + b + c) / 4
            second += v / 20 * (rows.T @ rows)
    centre = first / volume
    second -= volume * np.outer(centre, centre)
    inertia = (np.trace(second) * np.eye(3) - second) * density
    return volume * density, centre + inner, inertia


def principal(inertia, near):
    """moments and axes (columns, right-handed), in the order and sense nearest to the matrix `near`"""
    moments, axes = np.linalg.eigh(inertia)
    order, free = [], [0, 1, 2]
    for k in range(3):
        best = max(free, key=lambda j: abs(near[:, k] @ axes[:, j]))
        free.remove(best)
        order.append(best)
    moments, axes = moments[order], axes[:, order]
    for k in range(2):
        axes[:, k] *= 1 if near[:, k] @ axes[:, k] >= 0 else -1
    axes[:, 2] = np.cross(axes[:, 0], axes[:, 1])
    return moments, axes


def plane_of(vertices, corners):
    """outward unit normal and offset of a face, by Newell's sum over its corners"""
    p = np.array([vertices[i] for i in corners])
    normal = np.cross(p - p[0], np.roll(p, -1, 0) - p[0]).sum(0)
    normal /= np.linalg.norm(normal)
    return [*normal, float(np.mean(p @ normal))]


def word(name):
    """a block's name as one word of the scene text"""
    return name.replace(" ", "_")


def turned_table(table, turn):
    """rows of time and vector, the vectors turned"""
    return [[row[0], *(turn @ np.array(row[1:]))] for row in table]


def engine_block(b, vertices):
    """a block of blocks.json in the words of scene.py; vertices: world, or None as stated"""
    axes, moments, centre, mass, box = (matrix_of(b["quaternion_wxyz"]), b["moments_kg_m2"], b["centre_m"],
                                        b["mass_kg"], b["box_m"])
    inside = b["vertices_in_axes_m"]
    if vertices is not None:
        mass, centre, inertia = mass_properties(vertices, [f["corners"] for f in b["faces"]], b["density_kg_m3"])
        moments, axes = principal(inertia, axes)
        inside = [axes.T @ (np.array(v) - centre) for v in vertices]
        box = 2 * np.abs(inside[0]) if box is not None else None
    faces = [dict(plane=plane_of(inside, f["corners"]), corners=f["corners"]) for f in b["faces"]]
    return dict(name=word(b["name"]), fixed=b["fixed"], mass=mass, density=b["density_kg_m3"], centre=np.array(centre, float),
                turn=quaternion_of(axes), moments=np.array(moments, float), velocity=b.get("velocity_m_s") or [0, 0, 0],
                spin=b.get("spin_rad_s") or [0, 0, 0], box=box, vertices=np.array(inside, float), faces=faces)


def bonded_faces(blocks, joint):
    """faces of free blocks that lie on a face of a fixed one, as four springs at the face's radii of gyration (scene.hpp): a spring
    has a quarter of the area's stiffness. The faces are rectangles."""
    kn, ks, _, tension = joint
    found = []
    for b in (b for b in blocks if not b["fixed"]):
        corners = b["centre"] + b["vertices"] @ matrix_of(b["turn"]).T
        for other in (o for o in blocks if o["fixed"]):
            walls = other["centre"] + other["vertices"] @ matrix_of(other["turn"]).T
            for f in b["faces"]:
                p, (*normal, offset) = corners[f["corners"]], plane_of(corners, f["corners"])
                touches = any(np.allclose([*np.negative(plane[:3]), -plane[3]], [*normal, offset], atol=1e-9)
                              for plane in (plane_of(walls, g["corners"]) for g in other["faces"]))
                if not touches:
                    continue
                edges = [p[1] - p[0], p[3] - p[0]] if len(p) == 4 else [np.ones(3), np.ones(3)]
                if abs(edges[0] @ edges[1]) > 1e-9 * np.linalg.norm(edges[0]) * np.linalg.norm(edges[1]):
                    raise CannotState("a bonded face that is not a rectangle")
                area = np.linalg.norm(np.cross(*edges))
                points = [p.mean(0) + (s * edges[1] + t * edges[0]) / math.sqrt(12) for s in (-1, 1) for t in (-1, 1)]
                found.append(dict(block=b["name"], fixed=other["name"], kn=kn * area / 4, ks=ks * area / 4, area=area,
                                  strength=tension, normal=-np.array(normal), points=points))
    return found


class Problem:
    def __init__(self, stated):
        self.stated = stated
        self.name, self.search, self.criterion = stated["name"], stated.get("search"), stated.get("criterion")
        self.asked = stated["asked"]

    @staticmethod
    def read(folder):
        with open(os.path.join(folder, "blocks.json"), encoding="utf-8") as file:
            return Problem(json.load(file))

    def is_plane(self):
        """whether a section y = constant says everything: prisms along y, and nothing acts along y"""
        s = self.stated
        vectors = [g["g_m_s2"] for g in s["gravity"]] + [b["velocity_m_s"] for b in s["blocks"]]
        spins = [b["spin_rad_s"] for b in s["blocks"]]
        tilts = [abs(f["normal"][1]) for b in s["blocks"] for f in b["faces"]]
        return not s.get("positions") and all(v[1] == 0 for v in vectors) and all(
            w[0] == 0 and w[2] == 0 for w in spins) and all(t < 1e-12 or t > 1 - 1e-12 for t in tilts)

    def variants(self):
        """the problem itself with the quantities that no variant answers, then each variant as a problem of its own"""
        stated = self.stated.get("variants") or []
        taken = {q for v in stated for q in v["quantities"]}
        parts = [Problem(dict(self.stated, asked=[a for a in self.asked if a["quantity"] not in taken]))]
        for v in stated:
            changed = {k: v[k] for k in ("gravity", "duration_s", "search", "criterion") if k in v}
            blocks = [dict(b, velocity_m_s=v.get("velocities_m_s", {}).get(b["name"], b["velocity_m_s"]))
                      for b in self.stated["blocks"]]
            parts.append(Problem(dict(self.stated, **changed, blocks=blocks,
                                      asked=[a for a in self.asked if a["quantity"] in v["quantities"]])))
        return parts

    def needs(self):
        """what an engine must be able to state, as words of engines.py"""
        found, joints = set(), self.stated["joints"]
        if not self.is_plane():
            found.add("space")
        if any((j.get("cohesion_Pa") or 0) > 0 or (j.get("tension_Pa") or 0) > 0 for j in joints):
            found.add("bond")
        if len({j["friction_deg"] for j in joints}) > 1:
            found.add("several frictions")
        if self.stated.get("bolts") and not self.stated.get("loads"):
            found.add("bolts")
        return found

    def scene(self, value=None, position=None, stiffness="stiff"):
        """The scene at a value of the search parameter (None: as stated), in one of the problem's positions, with the joints'
        "stiff" or "stated" stiffness: duration, output, friction (a coefficient), gravity (rows of time and vector), forces
        {block: force and moment}, shares (rows of time and share of them), joint (kn, ks, cohesion, tension), plane, bolts,
        blocks, welds (bonded faces)"""
        s = self.stated
        friction = max((j["friction_deg"] for j in s["joints"]), default=0.0)
        gravity = [[g["time_s"], *g["g_m_s2"]] for g in s["gravity"]]
        joint, moved = self.joint(stiffness), {}
        acts = self.search["acts"] if self.search and value is not None else {"kind": None}
        if acts["kind"] == "friction":
            friction = value
        elif acts["kind"] == "tension":
            joint[3] = value
        elif acts["kind"] == "gravity direction":
            gravity = turned_table(gravity, turn_matrix(acts["axis"], value))
        elif acts["kind"] == "vertices":
            moved = {word(name): (value - acts["at"]) * np.array(change) for name, change in acts["change"].items()}
        elif acts["kind"] is not None:
            raise CannotState("a search that changes " + acts["kind"])
        blocks = [engine_block(b, np.array(b["vertices_m"]) + moved[word(b["name"])] if word(b["name"]) in moved else None)
                  for b in s["blocks"]]
        if position is not None:
            turn = matrix_of(position["turn_wxyz"])
            gravity = turned_table(gravity, turn)
            for b in blocks:
                b["turn"] = quaternion_of(turn @ matrix_of(b["turn"]))
                for key in ("centre", "velocity", "spin"):
                    b[key] = turn @ np.array(b[key])
        forces, shares = self.forces(blocks)
        return dict(duration=s["duration_s"], output=s["output_s"], friction=math.tan(math.radians(friction)),
                    gravity=gravity, forces=forces, shares=shares, joint=joint, plane=s["dimension"] == 2,
                    bolts=s.get("bolts") or [], blocks=blocks,
                    welds=bonded_faces(blocks, joint) if joint[2] > 0 or joint[3] > 0 else [])

    def joint(self, stiffness):
        """kn, ks, cohesion, tension of the joints, which engines with one joint state alike"""
        for j in self.stated["joints"]:
            springs = j[stiffness] or j["stiff"]
            return [springs["kn_Pa_per_m"], springs["ks_Pa_per_m"], j["cohesion_Pa"], j["tension_Pa"]]
        return [1e9, 1e9, 0.0, 0.0]  # nothing touches

    def forces(self, blocks):
        """of the loads, at full size: force, and moment at the centre, of each block; and their common growth"""
        forces, shares = {}, []
        for load in self.stated.get("loads") or []:
            block = next(b for b in blocks if b["name"] == word(load["block"]))
            force, arm = np.array(load["force_N"], float), np.array(load["point_m"], float) - block["centre"]
            forces[block["name"]] = forces.get(block["name"], np.zeros(6)) + np.array([*force, *np.cross(arm, force)])
            table = [list(row) for row in zip(load["times_s"], load["factors"])]
            if shares and shares != table:
                raise CannotState("loads that grow differently")
            shares = table
        return forces, shares
