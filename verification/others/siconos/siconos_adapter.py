"""Siconos 4.4 (rigid, nonsmooth: Moreau-Jean, Coulomb's cone), contact points from its Bullet. Settings: dt; inside (m, margin
within a shape); box (1: native boxes); tolerance and iterations of the solver; solver (0 NSGS, 1 Newton); theta; sat and clip (1:
contact points by separating axes, by clipping of faces)"""
import os
import sys
import time

import numpy as np
import siconos.kernel as kernel
import siconos.numerics as numerics
from siconos.mechanics.collision import (RigidBodyDS, SiconosBox, SiconosContactor, SiconosContactorSet,
                                         SiconosConvexHull)
from siconos.mechanics.collision.bullet import SiconosBulletCollisionManager, SiconosBulletOptions

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), ".."))
from scene import force_at, gravity_at, row, run_scenes, turned


def make_manager(scene, setting, kept):
    options = SiconosBulletOptions()
    options.perturbationIterations = options.minimumPointsPerturbationThreshold = 0
    options.enableSatConvex = bool(setting("sat", 0))
    options.enablePolyhedralContactClipping = bool(setting("clip", 0))
    manager = SiconosBulletCollisionManager(options)
    law = kernel.NewtonImpactFrictionNSL(0.0, 0.0, scene["friction"], 3)
    manager.insertNonSmoothLaw(law, 0, 0)
    kept += [options, law]
    return manager


def contactor(block, setting, kept):
    if setting("box", 1) and block["box"] is not None:
        shape = SiconosBox(*block["box"])
    else:
        shape = SiconosConvexHull(np.array(block["vertices"]))
    shape.setInsideMargin(setting("inside", 1e-5))
    shape.setOutsideMargin(0)
    contactors = SiconosContactorSet()
    contactors.append(SiconosContactor(shape))
    kept += [shape, contactors]
    return contactors


def add_blocks(scene, setting, nsds, manager, kept):
    free = []
    for b in scene["blocks"]:
        pose = [*b["centre"], *b["turn"]]
        contactors = contactor(b, setting, kept)
        if b["fixed"]:
            manager.insertStaticContactorSet(contactors, pose)
            continue
        back = [b["turn"][0], *-b["turn"][1:]]  # spin about the block's own axes
        body = RigidBodyDS(pose, [*b["velocity"], *turned(back, b["spin"])], b["mass"], np.diag(b["moments"]))
        body.setUseContactorInertia(False)
        body.setContactors(contactors)
        body.setFExtPtr(b["mass"] * gravity_at(scene, 0))
        body.setIsMextExpressedInInertialFrame(True)
        nsds.insertDynamicalSystem(body)
        free.append((b, body))
    return free


def make_simulation(nsds, manager, setting, dt, kept):
    theta = kernel.MoreauJeanOSI(setting("theta", 0.50001))
    theta.setConstraintActivationThreshold(0.0)
    solver = kernel.solver_options_create(
        [numerics.SICONOS_FRICTION_3D_NSGS, numerics.SICONOS_FRICTION_3D_NSN_AC][int(setting("solver", 0))])
    solver.iparam[numerics.SICONOS_IPARAM_MAX_ITER] = int(setting("iterations", 1000))
    solver.dparam[numerics.SICONOS_DPARAM_TOL] = setting("tolerance", 1e-8)
    problem = kernel.FrictionContact(3, solver)
    problem.setMaxSize(30000)
    problem.setMStorageType(numerics.NM_SPARSE_BLOCK)
    problem.setKeepLambdaAndYState(True)
    simulation = kernel.TimeStepping(nsds, kernel.TimeDiscretisation(0, dt))
    simulation.insertIntegrator(theta)
    simulation.insertNonSmoothProblem(problem)
    simulation.insertInteractionManager(manager)
    simulation.setNewtonOptions(kernel.SICONOS_TS_LINEAR)
    simulation.setNewtonMaxIteration(1)
    kept += [theta, solver, problem]
    return simulation


def run(scene, setting):
    dt, kept = setting("dt", 0.002), []  # kept: what the engine points at
    nsds = kernel.NonSmoothDynamicalSystem(0, scene["duration"] + 10 * dt)
    manager = make_manager(scene, setting, kept)
    free = add_blocks(scene, setting, nsds, manager, kept)
    simulation = make_simulation(nsds, manager, setting, dt, kept)
    rows = []

    def show(moment):
        for b, body in free:
            q, v = np.array(body.q()), np.array(body.twist())
            rows.append(row(moment, b["name"], q[:3], q[3:7], v[:3], turned(q[3:7], v[3:6])))

    steps, every = round(scene["duration"] / dt), max(1, round(scene["output"] / dt))
    spent = 0.0
    show(0)
    for i in range(1, steps + 1):
        gravity, begun = gravity_at(scene, i * dt), time.process_time()
        for b, body in free:
            force = force_at(scene, b["name"], i * dt)
            body.setFExtPtr(b["mass"] * gravity + force[:3])  # copies: set at every step
            if np.any(force[3:]):
                body.setMExtPtr(force[3:])
        simulation.computeOneStep()
        simulation.nextStep()
        simulation.clearNSDSChangeLog()
        spent += time.process_time() - begun
        if i % every == 0 or i == steps:
            show(i * dt)
    return rows + ["cpu %.6f steps %d" % (spent, steps)]


if __name__ == "__main__":
    run_scenes(run)
