"""How a result is measured: paths of blocks, the criterion of failure, the bisection. No engine is needed."""
import numpy as np


class Path:
    """rows of one block: time, centre (3), quaternion w x y z (4), velocity (3), spin (3)"""

    def __init__(self, rows):
        self.rows = np.array(rows, float)

    def at(self, time):
        return self.rows[np.argmin(np.abs(self.rows[:, 0] - time))]

    def place(self, time):
        return self.at(time)[1:4]

    def moved(self, begin, end):
        return float(np.linalg.norm(self.place(end) - self.place(begin)))


def accelerates(paths, c):
    """More displacement in the later of two intervals than in the earlier by more than the excess, or far away. A steady
    creep does not count: some engines creep at any load."""
    path, (a, b, end) = paths[c["block"].replace(" ", "_")], c["times_s"]
    return path.moved(b, end) - path.moved(a, b) > c["excess_m"] or path.moved(0, end) > c["far_m"]


def gets_faster(paths, c):
    """The block was sent off: it covers more in the later interval than in the earlier one. One that covers less than
    stopped_m in the later interval has stopped: its two paths are noise, and either may be the longer."""
    if "stopped_m" not in c:
        raise ValueError("blocks.json: criterion: \"gets faster\" lacks stopped_m (m), the path below which a block has stopped; "
                         "write the problems again (make problems)")
    path, (a, b, end) = paths[c["block"].replace(" ", "_")], c["times_s"]
    return path.moved(b, end) > max(path.moved(a, b), c["stopped_m"])


def falls(paths, c):
    """the block, or any block, ends far from its start"""
    named = paths.values() if c["block"] == "any block" else [paths[c["block"].replace(" ", "_")]]
    return any(path.moved(0, path.rows[-1, 0]) > c["far_m"] for path in named)


CRITERIA = {"accelerates": accelerates, "gets faster": gets_faster, "falls": falls}


def failed(paths, criterion):
    return bool(CRITERIA[criterion["kind"]](paths, criterion))


class Bracket:
    """of a search: the middle, half the width, and a note if no change was found between the limits"""

    def __init__(self, value, half_width, note=""):
        self.value, self.half_width, self.note = value, half_width, note


def bisect(fails, search):
    """fails(value) between search's limits; the side that fails is search's fails_at"""
    weak, strong = search["lower"], search["upper"]
    if search["fails_at"] == "upper":
        weak, strong = strong, weak
    if fails(strong):
        return Bracket(strong, 0, "fails at every value up to the limit of the search")
    if not fails(weak):
        return Bracket(weak, 0, "fails at no value down to the limit of the search")
    while abs(strong - weak) > search["tolerance"]:
        middle = (weak + strong) / 2
        if fails(middle):
            weak = middle
        else:
            strong = middle
    return Bracket((weak + strong) / 2, abs(strong - weak) / 2)
