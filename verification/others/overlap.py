"""How far blocks overlap, from their poses alone: so no engine has to report it, and all are measured alike."""
import numpy as np
from scipy.optimize import linprog

from problem import matrix_of

NEAR = 1e-3  # m, between the bounds of blocks that may touch


def overlap(first, second):
    """m, of two convex blocks given by planes (n, d: n x <= d): twice the depth of the deepest point under all planes, the
    overlap that the program itself computes; negative: the gap's measure"""
    planes = np.concatenate([first, second])
    middle = np.mean([np.linalg.lstsq(p[:, :3], p[:, 3], rcond=None)[0] for p in (first, second)], axis=0)
    limits = planes[:, 3] - planes[:, :3] @ middle
    for method in ("highs-ds", "highs-ipm"):
        found = linprog([0, 0, 0, -1], A_ub=np.column_stack([planes[:, :3], np.ones(len(planes))]), b_ub=limits,
                        bounds=[(None, None)] * 4, method=method)
        if found.status == 0:
            break
    else:
        raise ArithmeticError("overlap of two blocks: " + found.message)
    # The solver's point is good to 1e-7 m. The shares of the planes that hold it balance each other, so their mean depth does
    # not depend on the point, and its error is the product of both.
    shares = -found.ineqlin.marginals
    return 2 * float(shares @ (limits - planes[:, :3] @ found.x[:3]) / shares.sum())


def placed(block, pose):
    """planes in the world, and the bounds, of a block at a pose (place, quaternion w x y z)"""
    axes, centre = matrix_of(pose[3:7]), np.array(pose[:3], float)
    own = np.array([f["plane"] for f in block["faces"]], float)
    normals = own[:, :3] @ axes.T
    corners = centre + np.array(block["vertices"]) @ axes.T
    return np.column_stack([normals, own[:, 3] + normals @ centre]), corners.min(0), corners.max(0)


def largest_overlap(blocks, poses):
    """m, of all pairs with a free block, not below zero; None: no pair is near. poses: of the free blocks, by name"""
    found = [placed(b, poses.get(b["name"], [*b["centre"], *b["turn"]])) for b in blocks]
    low, high = (np.array([part[k] for part in found]) for k in (1, 2))
    fixed = np.array([b["fixed"] for b in blocks])
    largest = None
    for i in range(len(blocks)):
        near = np.all((low[i] <= high[:i] + NEAR) & (high[i] + NEAR >= low[:i]), axis=1) & ~(fixed[i] & fixed[:i])
        for j in np.flatnonzero(near):
            largest = max(largest or 0.0, overlap(found[i][0], found[j][0]))
    return largest
