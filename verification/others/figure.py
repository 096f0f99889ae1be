"""Error against cost of every setting of the sweeps, a panel for each problem, as SVG by hand: no library is needed."""
import math

COLOURS = {"bullet": "#d55e00", "ode": "#0072b2", "box2d": "#009e73", "mujoco": "#cc79a7", "rapier": "#e69f00",
           "jolt": "#56b4e9", "siconos": "#7f4fc9", "voussoir": "#000000"}
WIDTH, HEIGHT, LEFT, TOP, GAP = 250, 190, 62, 56, 46  # of a panel, and around it
LEAST, MOST = 1e-2, 300.0  # tolerances drawn; smaller errors are drawn at LEAST


def decade_marks(low, high):
    return [10.0**k for k in range(math.ceil(math.log10(low) - 1e-9), math.floor(math.log10(high) + 1e-9) + 1)]


def panel(problem, engines, x, y):
    seconds = [max(s, 1e-4) for points in engines.values() for s, _ in points]
    low, high = 10**math.floor(math.log10(min(seconds))), 10**math.ceil(math.log10(max(seconds) * 1.001))
    across = lambda s: x + WIDTH * math.log(max(s, 1e-4) / low) / math.log(high / low)
    up = lambda e: y + HEIGHT * (1 - math.log(min(max(e, LEAST), MOST) / LEAST) / math.log(MOST / LEAST))
    lines = ['<rect x="%.1f" y="%.1f" width="%d" height="%d" fill="#fff" stroke="#444"/>' % (x, y, WIDTH, HEIGHT),
             '<rect x="%.1f" y="%.1f" width="%d" height="%.1f" fill="#dcf1e9"/>' % (x, up(1), WIDTH, y + HEIGHT - up(1)),
             '<text x="%.1f" y="%.1f" font-size="13" font-weight="bold">%s</text>' % (x, y - 7, problem.replace("_", " "))]
    for mark in decade_marks(low, high):
        lines.append('<path d="M%.1f %.1fv5" stroke="#444"/><text x="%.1f" y="%.1f" text-anchor="middle">%g</text>' % (
            across(mark), y + HEIGHT, across(mark), y + HEIGHT + 17, mark))
    for mark in decade_marks(LEAST, MOST):
        lines.append('<path d="M%.1f %.1fh-5" stroke="#444"/><text x="%.1f" y="%.1f" text-anchor="end">%s%g</text>' % (
            x, up(mark), x - 8, up(mark) + 4, "≤ " if mark == LEAST else "", mark))
    for name, points in engines.items():
        for s, e in sorted(set(points)):
            lines.append('<circle cx="%.1f" cy="%.1f" r="3.2" fill="%s" fill-opacity="0.75"/>' % (across(s), up(e), COLOURS.get(name, "#888")))
    return lines


def draw(problems, columns=3):
    """problems: {name: {engine: [(seconds, error in tolerances)]}}"""
    names = sorted(problems)
    rows = max(1, math.ceil(len(names) / columns))
    width, height = LEFT + columns * (WIDTH + LEFT), TOP + rows * (HEIGHT + GAP) + 14
    used = [e for e in COLOURS if any(e in found for found in problems.values())]
    lines = ['<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 %d %d" width="%d" height="%d" font-family="sans-serif" '
             'font-size="11">' % (width, height, width, height),
             '<rect width="%d" height="%d" fill="#fff"/>' % (width, height)]
    for k, engine in enumerate(used):
        lines.append('<circle cx="%d" cy="18" r="5" fill="%s"/><text x="%d" y="22">%s</text>' % (
            LEFT + 90 * k, COLOURS[engine], LEFT + 90 * k + 9, engine))
    for k, name in enumerate(names):
        lines += panel(name, problems[name], LEFT + (k % columns) * (WIDTH + LEFT), TOP + (k // columns) * (HEIGHT + GAP))
    lines.append('<text x="%d" y="%d" text-anchor="middle">processor seconds of the steps of all trials</text>' % (width // 2, height - 8))
    lines.append('<text transform="translate(13 %d) rotate(-90)" text-anchor="middle">largest error of a problem, in tolerances</text>' % (height // 2))
    return "\n".join(lines + ["</svg>", ""])
