"""Errors of answers against a problem's reference.json. Only the choice of settings and the table read references; the harness and the
adapters never do."""
import json
import os

MOST = 100.0  # tolerances: an error counts at most this much in a sum, or one lost problem would decide alone


def read_reference(folder):
    """by quantity; empty if the folder has none (a blind test)"""
    path = os.path.join(folder, "reference.json")
    if not os.path.exists(path):
        return {}
    with open(path, encoding="utf-8") as file:
        return {q["quantity"]: q for q in json.load(file)["quantities"]}


def target(quantity, model):
    """lower and upper reference and the tolerance beyond each, for a code of that model; None: the quantity is not judged"""
    stated = quantity.get("rigid" if model == "rigid" else "joints")
    if not stated:
        return None
    lower, upper = (stated["lower"], stated["upper"]) if model == "rigid" else (stated["value"], stated["value"])
    return [(bound, stated["absolute"] + stated["relative"] * abs(bound)) for bound in (lower, upper)]


def error(value, bounds):
    """signed distance from the interval of right answers, and the tolerance at that side"""
    (lower, below), (upper, above) = bounds
    if value < lower:
        return value - lower, below
    return (value - upper, above) if value > upper else (0.0, min(below, above))


def tolerances(value, bounds):
    """the error in tolerances, at most MOST; value None: the engine failed"""
    if value is None or value != value:
        return MOST
    distance, tolerance = error(value, bounds)
    return min(MOST, abs(distance) / tolerance) if tolerance > 0 else (0.0 if distance == 0 else MOST)
