#!/usr/bin/python3
"""make_sketches.py --source REPOSITORY --build BUILD [--only CASE …]: a dimensioned sketch of each case's scene.toml, as sliced.

Writes BUILD/reports/sketches/CASE.svg: in the plane the blocks and the bolts that the scene states, in space elevation and plan, with the
extent of all blocks and of those that are free, in m. Many blocks in space are drawn as outlines, the nearer over the farther. A case
without scene.toml has the scene that [drawn] of views.toml names, or no sketch.
"""
import argparse
import csv
import pathlib
import subprocess
import tempfile
import tomllib

MOST_TRANSPARENT = 100  # blocks in space whose faces are all drawn
MOST_BLOCKS = 2000
WIDTH, HEIGHT, MARGIN = 330.0, 240.0, 46.0  # of a view, pixels; of the dimensions about it


def clipped(polygon, normal, offset):
    """the part of a convex polygon below a line"""
    kept = []
    for (ax, ay), (bx, by) in zip(polygon, polygon[1:] + polygon[:1]):
        a, b = normal[0] * ax + normal[1] * ay - offset, normal[0] * bx + normal[1] * by - offset
        if a <= 0:
            kept.append((ax, ay))
        if a * b < 0:
            kept.append((ax + (bx - ax) * a / (a - b), ay + (by - ay) * a / (a - b)))
    return kept


def in_plane(folder):
    """outlines of blocks by name: from half-planes"""
    parts = {}
    for row in csv.DictReader(open(folder / "block_planes.csv", encoding="utf-8")):
        key = (row["block"], row["part"])
        outline = parts.get(key, [(-1e6, -1e6), (1e6, -1e6), (1e6, 1e6), (-1e6, 1e6)])
        parts[key] = clipped(outline, (float(row["normal_x"]), float(row["normal_y"])), float(row["offset_m"]))
    return [(name, outline) for (name, _), outline in parts.items()]


def in_space(folder):
    """faces of blocks by name: from the OBJ file"""
    faces, name, corners = [], "", []
    for line in open(folder / "blocks.obj", encoding="utf-8"):
        kind, *words = line.split() or [""]
        if kind == "o":
            name = words[0]
        elif kind == "v":
            corners.append(tuple(float(word) for word in words))
        elif kind == "f":
            faces.append((name, [corners[int(word) - 1] for word in words]))
    return faces


def hull(points):
    """the convex hull of points in the plane"""
    points = sorted(set(points))

    def chain(points):
        kept = []
        for x, y in points:
            while len(kept) > 1 and ((kept[-1][0] - kept[-2][0]) * (y - kept[-2][1]) <=
                                     (kept[-1][1] - kept[-2][1]) * (x - kept[-2][0])):
                kept.pop()
            kept.append((x, y))
        return kept

    return chain(points)[:-1] + chain(reversed(points))[:-1]


def outlines(faces, free, seen):
    """one outline a block, of corners that `seen` puts into the view: fixed blocks, which may be walls before the others, then farther
    ones first; seen(corner) gives x, y and depth"""
    corners = {}
    for name, face in faces:
        corners.setdefault(name, []).extend(seen(corner) for corner in face)
    order = sorted(corners, key=lambda name: (name in free, -sum(depth for _, _, depth in corners[name]) / len(corners[name])))
    return [(name, hull([(x, y) for x, y, _ in corners[name]])) for name in order]


def free_blocks(folder):
    rows = list(csv.DictReader(open(folder / "blocks.csv", encoding="utf-8")))
    return {row["name"] or f"block-{row['body']}" for row in rows if row["fixed"] != "1"}, len(rows)


def extent(shapes):
    points = [point for _, shape in shapes for point in shape]
    return [(min(values), max(values)) for values in zip(*points)]


def dimension(length):
    return f"{length:.4g} m"


def scale_of(shapes):
    """pixels a metre; and the height in pixels"""
    (x0, x1), (y0, y1) = extent(shapes)
    scale = min(WIDTH / (x1 - x0), HEIGHT / (y1 - y0))
    return scale, (y1 - y0) * scale


def view(shapes, free, left, tall, title, kind="", bolts=()):
    """one view, within `tall` pixels: shapes at their scale, dimensions of all below and to the right, of the free ones above and to the
    left; kind: of the shapes, which are then drawn in their order; bolts: (from, to) of each"""
    (x0, x1), (y0, y1) = extent(shapes)
    scale, height = scale_of(shapes)
    width = (x1 - x0) * scale
    ox, oy = left + MARGIN + (WIDTH - width) / 2, MARGIN + (tall + height) / 2

    def at(x, y):
        return ox + (x - x0) * scale, oy - (y - y0) * scale

    text = []
    for name, shape in shapes if kind else sorted(shapes, key=lambda item: item[0] in free):
        points = " ".join(f"{x:.1f},{y:.1f}" for x, y in (at(*point) for point in shape))
        text.append(f'<polygon class="sketch-{"free" if name in free else "fixed"}{kind}" points="{points}"/>')

    for start, end in bolts:
        (ax, ay), (bx, by) = at(*start), at(*end)
        text.append(f'<path class="sketch-bolt" d="M{ax:.1f},{ay:.1f}L{bx:.1f},{by:.1f}"/>')

    def measure(a, b, words, turned=False):
        (ax, ay), (bx, by) = a, b
        mx, my = (ax + bx) / 2, (ay + by) / 2
        turn = f' transform="rotate(-90 {mx - 5:.1f} {my:.1f})"' if turned else ""
        text.append(f'<path class="sketch-measure" marker-start="url(#tick)" marker-end="url(#tick)" d="M{ax:.1f},{ay:.1f}L{bx:.1f},{by:.1f}"/>'
                    f'<text x="{mx - 5 * turned:.1f}" y="{my - 4 * (not turned):.1f}"{turn}>{words}</text>')

    measure((ox, oy + 24), (ox + width, oy + 24), dimension(x1 - x0))
    measure((ox + width + 26, oy), (ox + width + 26, oy - height), dimension(y1 - y0), True)
    moving = [shape for shape in shapes if shape[0] in free]
    if moving and len(moving) < len(shapes):
        (u0, u1), (v0, v1) = extent(moving)
        (ax, ay), (bx, by) = at(u0, v0), at(u1, v1)
        measure((ax, oy - height - 12), (bx, oy - height - 12), f"free: {dimension(u1 - u0)}")
        measure((ox - 14, ay), (ox - 14, by), f"free: {dimension(v1 - v0)}", True)
    text.append(f'<text x="{left + MARGIN + WIDTH / 2:.1f}" y="{2 * MARGIN + tall - 6:.1f}">{title}</text>')
    return "".join(text)


def sketch(program, scene):
    """the drawing, or why there is none"""
    bolts = []
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name) / "blocks"
        command = [program, "slice", scene, "--planes", "--out", folder]
        done = subprocess.run(command, capture_output=True, text=True, check=False)
        if done.returncode != 0:
            return None, (done.stderr.strip().splitlines() or ["no message"])[-1]
        free, count = free_blocks(folder)
        if count > MOST_BLOCKS:
            return None, f"{count} blocks"
        header = open(folder / "block_planes.csv", encoding="utf-8").readline()
        if "normal_z" in header:
            subprocess.run([*command, "--obj", "--overwrite"], capture_output=True, check=True)
            faces = in_space(folder)
            seen = (("elevation, seen to the north", lambda c: (c[0], c[2], c[1])), ("plan, north up", lambda c: (c[0], c[1], -c[2])))
            if count > MOST_TRANSPARENT:
                views = [(outlines(faces, free, way), title, " sketch-solid") for title, way in seen]
            else:
                views = [([(name, [way(corner)[:2] for corner in face]) for name, face in faces], title, "") for title, way in seen]
        else:
            views = [(in_plane(folder), "in the plane", "")]
            stated = tomllib.loads(scene.read_text(encoding="utf-8")).get("bolts", [])
            bolts = [(bolt["from"], bolt["to"]) for bolt in stated if "from" in bolt and "to" in bolt]
    step, tall = WIDTH + 2 * MARGIN, max(scale_of(shapes)[1] for shapes, _, _ in views)
    drawn = "".join(view(shapes, free, k * step, tall, title, kind, bolts) for k, (shapes, title, kind) in enumerate(views))
    return (f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {len(views) * step:.0f} {tall + 2 * MARGIN:.0f}" font-size="11" '
            'text-anchor="middle"><style>.sketch-fixed{fill:#e8eaed;fill-opacity:.5;stroke:#9aa4ae;stroke-width:.6}.sketch-free{fill:#f2c078;fill-opacity:.55;stroke:#7a5300;'
            'stroke-width:.9}.sketch-solid{fill-opacity:1;stroke-width:.3}.sketch-bolt{stroke:#0b5cad;stroke-width:2}.sketch-measure{fill:none;stroke:#1d2126;stroke-width:.8}</style><defs><marker id="tick" '
            'viewBox="-4 -4 8 8" markerWidth="8" markerHeight="8" orient="auto"><path d="M-3,3L3,-3" stroke="#1d2126"/></marker></defs>'
            f'{drawn}</svg>\n'), ""


def main():
    options = argparse.ArgumentParser()
    options.add_argument("--source", type=pathlib.Path, required=True)
    options.add_argument("--build", type=pathlib.Path, required=True)
    options.add_argument("--only", action="append", default=[])
    arguments = options.parse_args()
    out = arguments.build / "reports" / "sketches"
    out.mkdir(parents=True, exist_ok=True)
    drawn = 0
    with open(arguments.source / "reports" / "views.toml", "rb") as file:
        named = tomllib.load(file)["drawn"]
    for readme in sorted(arguments.source.glob("cases/*/README.md")):
        case = readme.parent.name
        scene = readme.parent / named.get(case, "scene.toml")
        if (arguments.only and case not in arguments.only) or not scene.exists():
            continue
        text, reason = sketch(arguments.build / "app" / "voussoir", scene)
        (out / f"{case}.svg").unlink(missing_ok=True)
        if text:
            (out / f"{case}.svg").write_text(text, encoding="utf-8")
            drawn += 1
        else:
            print(f"sketch of {case}: none, {reason}")
    print(f"sketches: {drawn} cases")


main()
