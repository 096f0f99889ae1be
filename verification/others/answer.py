"""The quantities of a problem from an engine: which scenes are run, what is read from their paths."""
import math

import numpy as np

from measure import Path, bisect, failed
from overlap import largest_overlap
from problem import matrix_of, word
from scene import scene_text

STATED = "the engine's contacts are rigid, or soft by numbers without a unit: no stiffness per area to state"


class Answer:
    """a value with its seconds and note; value None: the engine failed; a string: `cannot state`"""

    def __init__(self, quantity, unit, value, seconds, note="", overlap=None):
        self.quantity, self.unit, self.value, self.seconds, self.note = quantity, unit, value, seconds, note
        self.overlap = overlap  # m, the largest at the end of a trial; None: nothing touched


class EngineFailure(Exception):
    pass


class Trial:
    """runs scenes of one problem in one engine with one setting, adds up the seconds of their steps, keeps the largest overlap"""

    def __init__(self, process, settings):
        self.process, self.settings, self.seconds, self.overlap = process, settings, 0.0, None

    def paths(self, scene, stands=lambda paths: True):
        """the overlap is measured at the end, if the blocks stand then: in a heap of fallen ones it says nothing"""
        engine = self.process.engine
        run = self.process.run(scene_text(scene, self.settings, engine.model == "joint stiffness", engine.welds))
        self.seconds += run.seconds
        paths = {name: Path(rows) for name, rows in run.rows.items()}
        if run.failure:
            raise EngineFailure(run.failure)
        if any(not np.isfinite(p.rows).all() for p in paths.values()):
            raise EngineFailure("a position that is not a number")
        if stands(paths):
            found = largest_overlap(scene["blocks"], {name: path.rows[-1, 1:8] for name, path in paths.items()})
            self.overlap = found if self.overlap is None else max(self.overlap, found or 0.0)
        return paths


def searched(problem, trial, stiffness):
    def fails(value):
        paths = trial.paths(problem.scene(value, stiffness=stiffness), lambda found: not failed(found, problem.criterion))
        return failed(paths, problem.criterion)

    bracket = bisect(fails, problem.search)
    return bracket.value, bracket.note or "bracket +- %.3g" % bracket.half_width


def sliding_cube(problem, trial):
    found = {}
    for position in problem.stated["positions"]:
        path = trial.paths(problem.scene(position=position))["cube"]
        found[position["name"]] = path.moved(0, problem.stated["duration_s"])
    first = problem.stated["positions"][0]["name"]
    others = {name: v for name, v in found.items() if name != first}
    least, most = min(others, key=others.get), max(others, key=others.get)
    return {"path, as drawn": (found[first], ""),
            "path, least of the turned positions": (others[least], "turned: " + least),
            "path, greatest of the turned positions": (others[most], "turned: " + most)}


def free_rotation(problem, trial):
    block = problem.scene()["blocks"][0]
    rows = trial.paths(problem.scene())[block["name"]].rows
    start, moments = matrix_of(block["turn"]), np.diag(block["moments"])
    momenta, energies, spins = [], [], []
    for row in rows:
        axes, w = matrix_of(row[4:8]), row[11:14]
        inertia = axes @ moments @ axes.T
        momenta.append(inertia @ w)
        energies.append(w @ inertia @ w / 2)
        spins.append((axes @ start.T).T @ w)  # about the axes that were the world's at the start
    momenta, energies = np.array(momenta), np.array(energies)
    last = spins[-1]
    found = {"angular momentum, largest change": np.linalg.norm(momenta - momenta[0], axis=1).max() / np.linalg.norm(momenta[0]),
             "kinetic energy, largest change": np.abs(energies - energies[0]).max() / energies[0]}
    for name, value in zip(("long", "middle", "short"), last):
        found["angular velocity along the %s axis, 45 s" % name] = value
    return {name: (float(value), "") for name, value in found.items()}


def rocking(problem, trial):
    """the block leans about y; speeds are carried to the upright position by the energy of a turn about a corner"""
    b = next(b for b in problem.stated["blocks"] if not b["fixed"])
    scene = problem.scene()
    rows = trial.paths(scene)[word(b["name"])].rows
    long = int(np.argmax(b["box_m"]))
    axes = [matrix_of(row[4:8])[:, long] for row in rows]
    upwards = 1 if axes[0][2] > 0 else -1
    lean = np.array([math.atan2(upwards * a[0], upwards * a[2]) for a in axes]) * (1 if upwards * axes[0][0] > 0 else -1)
    spin = rows[:, 12]
    height, width = max(b["box_m"]), b["box_m"][0] if long == 2 else b["box_m"][2]
    half, alpha = math.hypot(height, width) / 2, math.atan2(width, height)
    about_y = int(np.argmax(np.abs(matrix_of(b["quaternion_wxyz"])[1])))
    inertia = b["moments_kg_m2"][about_y] + b["mass_kg"] * half**2
    hits = [k for k in range(1, len(lean)) if lean[k] <= 0 < lean[k - 1]]
    if not hits:
        raise EngineFailure("no impact within the duration")
    k = hits[0]
    time = rows[k - 1, 0] + (rows[k, 0] - rows[k - 1, 0]) * lean[k - 1] / (lean[k - 1] - lean[k])
    g = np.linalg.norm(scene["gravity"][-1][1:])

    def upright(i):
        lift = math.cos(alpha - abs(lean[i])) - math.cos(alpha)
        return math.sqrt(max(0.0, spin[i]**2 + 2 * b["mass_kg"] * g * half / inertia * lift))

    before, after = max(1, k - 4), min(len(rows) - 1, k + 20)
    return {"time of the first impact": (float(time), ""),
            "ratio of turning speeds, first impact": (upright(after) / upright(before), "")}


def bonded_beam(problem, trial):
    paths = trial.paths(problem.scene(stiffness="stated"))["beam"]
    first, last = paths.rows[0], paths.rows[-1]
    turn = matrix_of(last[4:8]) @ matrix_of(first[4:8]).T
    return {"rotation, stated joints": (math.atan2(turn[0, 2], turn[0, 0]), ""),
            "drop of the centre, stated joints": (float(first[3] - last[3]), "")}


def rock_mass(problem, trial):
    """The contact forces on the fixed blocks are, by the balance of momentum, the weight of the free ones less the change of
    their momentum: so no engine has to report contact forces. The joints are the stated ones, which either answer allows."""
    scene = problem.scene(stiffness="stated")
    paths, begin, end = trial.paths(scene), 3.0, 4.0
    masses = {b["name"]: b["mass"] for b in scene["blocks"] if not b["fixed"]}
    force = sum(masses.values()) * np.array(scene["gravity"][-1][1:])
    force = force - sum(m * (paths[n].at(end) - paths[n].at(begin))[8:11] for n, m in masses.items()) / (end - begin)
    away = sum(path.moved(0, end) > 0.05 for path in paths.values())
    note = "from the weight and the change of momentum"
    return {"weight on floor and walls": (-float(force[2]), note), "thrust on the walls, eastward": (float(force[0]), note),
            "thrust on the walls, northward": (float(force[1]), note), "blocks that left their place": (float(away), "")}


MEASURED = {"rock_mass": rock_mass, "sliding_cube": sliding_cube, "free_rotation": free_rotation, "rocking": rocking,
            "bonded_beam": bonded_beam}


def whole(problem, trial):
    """quantities that are read from runs without a search, those of a search"""
    measured = MEASURED.get(problem.name)
    return measured(problem, trial) if measured else {}


def answers(problem, process, settings):
    """every asked quantity, in the order of the problem"""
    engine, found, needs = process.engine, {}, problem.needs()
    reason = engine.reason(needs)
    for part in [] if reason else problem.variants():
        asked = {a["quantity"]: a["unit"] for a in part.asked}
        searches = {}  # one search for each stiffness
        runs = None
        for quantity in asked:
            stiffness = "stated" if quantity.endswith("stated joints") else "stiff"
            if stiffness == "stated" and engine.model_for(needs) == "rigid":
                found[quantity] = ("cannot state", 0.0, STATED)
                continue
            try:
                if part.search and ("critical" in quantity or "least t" in quantity):
                    if stiffness not in searches:
                        trial = Trial(process, settings)
                        searches[stiffness] = (*searched(part, trial, stiffness), trial)
                    value, note, trial = searches[stiffness]
                else:
                    if runs is None:
                        trial = Trial(process, settings)
                        runs = (whole(part, trial), trial)
                    if isinstance(runs, EngineFailure):
                        raise runs
                    (values, trial) = runs
                    if quantity not in values:
                        found[quantity] = ("cannot state", 0.0, "the adapter does not read this quantity")
                        continue
                    value, note = values[quantity]
                found[quantity] = (value, trial.seconds, note, trial.overlap)
            except EngineFailure as failure:
                runs = runs or failure  # not tried again for the next quantity
                found[quantity] = (None, 0.0, str(failure))
    if reason:
        return [Answer(a["quantity"], a["unit"], "cannot state", 0.0, reason) for a in problem.asked]
    return [Answer(a["quantity"], a["unit"], *found[a["quantity"]]) for a in problem.asked]
