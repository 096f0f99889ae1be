#!/usr/bin/python3
"""The design points of the case's studies by another program, OpenTURNS, on closed forms written anew.

    openturns_referee.py VOUSSOIR FOLDER    the program, and the folder of the case; exits with 77 if OpenTURNS is not installed
"""
import json
import math
import re
import subprocess
import sys
import tempfile
from pathlib import Path

try:
    import openturns as ot
except ImportError:
    print("skipped: python3-openturns is not installed (cmake/install_packages.sh referees)")
    sys.exit(77)

ot.Log.Show(ot.Log.NONE)
degree = math.pi / 180
tolerance = 1e-7


def slab(friction, cohesion):
    """Factor of the slab of slab.toml: the joint is 10 m long and carries 10 x 4.5 m of rock at 32 degrees."""
    weight, area, dip = 2650 * 9.81 * 10 * 4.5, 10.0, 32 * degree
    return math.tan(friction * degree) / math.tan(dip) + cohesion * area / (weight * math.sin(dip))


def two_slabs(a, b):
    return min(math.tan(a * degree), math.tan(b * degree)) / math.tan(30 * degree)


def plane(dip, direction):
    """Upward normal in axes of east, north and up."""
    dip, direction = dip * degree, direction * degree
    return [math.sin(dip) * math.sin(direction), math.sin(dip) * math.cos(direction), math.cos(dip)]


def cross(a, b):
    return [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]


def dot(a, b):
    return sum(x * y for x, y in zip(a, b))


def wedge(dip_a, direction_a, dip_b, direction_b, friction_a, friction_b):
    """A dry wedge that slides along the line of its planes, or on one of them if the other would have to pull."""
    a, b = plane(dip_a, direction_a), plane(dip_b, direction_b)
    line = cross(a, b)
    size = math.sqrt(dot(line, line))
    line = [x / size for x in line]
    drive = abs(line[2])
    load = [-line[2] * x for x in line]  # the unit weight's part along the line
    across = [0 - load[0], 0 - load[1], -1 - load[2]]
    # normal forces: n_a a + n_b b + across = 0
    ab = dot(a, b)
    pa, pb = -dot(a, across), -dot(b, across)
    n_a, n_b = (pa - ab * pb) / (1 - ab * ab), (pb - ab * pa) / (1 - ab * ab)
    if n_a >= 0 and n_b >= 0:
        return (n_a * math.tan(friction_a * degree) + n_b * math.tan(friction_b * degree)) / drive
    dip, friction = (dip_a, friction_a) if n_b < 0 else (dip_b, friction_b)
    return math.tan(friction * degree) / math.tan(dip * degree)


def marginal(text):
    """"normal, mean 38, deviation 2.9" of the study's own file"""
    law, numbers = text.split(",")[0], dict(re.findall(r"(\w+) ([-+.\deE]+)", text))
    mean, deviation = float(numbers["mean"]), float(numbers["deviation"])
    if law == "lognormal":
        return ot.ParametrizedDistribution(ot.LogNormalMuSigma(mean, deviation, 0.0))
    assert law == "normal", law
    return ot.Normal(mean, deviation)


def distribution(found):
    marginals = [marginal(key["law"]) for key in found["keys"]]
    names = [key["key"] for key in found["keys"]]
    matrix = ot.CorrelationMatrix(len(names))
    for pair in found.get("correlation", []):
        i, j = pair["components"]
        matrix[i, j] = pair["of_normals"]
    for pair in found.get("correlation", []):  # Nataf's model: the values have Pearson's correlation as it is stated
        i, j = pair["components"]
        apart = abs(correlation_of_values(marginals[i], marginals[j], pair["of_normals"]) - pair["of_values"])
        assert apart < 1e-8, f"correlation of values is off by {apart:g}"
    return ot.ComposedDistribution(marginals, ot.NormalCopula(matrix))


def correlation_of_values(a, b, of_normals):
    """Pearson's, by Gauss's quadrature over the normals."""
    nodes, weights = ot.GaussProductExperiment(ot.Normal(2), [48, 48]).generateWithWeights()
    root, normal = math.sqrt(1 - of_normals * of_normals), ot.Normal()
    value = lambda law, z: law.computeQuantile(normal.computeCDF(z))[0]
    mean = 0
    for (z, w), weight in zip(nodes, weights):
        x = value(a, z) - a.getMean()[0]
        y = value(b, of_normals * z + root * w) - b.getMean()[0]
        mean += weight * x * y
    return mean / (a.getStandardDeviation()[0] * b.getStandardDeviation()[0])


def beta_by_referee(found, factor):
    joint = distribution(found)
    function = ot.PythonFunction(joint.getDimension(), 1, lambda x: [factor(*x)])
    steps = [1e-5 * abs(mean) for mean in joint.getMean()]
    function.setGradient(ot.CenteredFiniteDifferenceGradient(steps, function.getEvaluation()))
    event = ot.ThresholdEvent(ot.CompositeRandomVector(function, ot.RandomVector(joint)), ot.Less(), 1.0)
    search = ot.AbdoRackwitz()
    search.setMaximumIterationNumber(500)
    search.setMaximumEvaluationNumber(50000)
    for error in ("Absolute", "Relative", "Residual", "Constraint"):
        getattr(search, f"setMaximum{error}Error")(1e-10)
    form = ot.FORM(search, event, joint.getMean())
    form.run()
    return form.getResult().getHasoferReliabilityIndex()


def beta_of(program, plan, folder):
    out = Path(folder) / "out"
    subprocess.run([program, "study", plan, "--out", out, "--quiet"], check=True, capture_output=True)
    return json.loads((out / "reliability_1.json").read_text())


def main(program, case):
    failed = 0
    correlation = 'correlation = [["joint_properties.joint.friction_deg", "joint_properties.joint.cohesion", -0.5]]\n'
    for name, plan, factor, more in (("slab", "slab_study.toml", slab, ""),
                                     ("correlated slab", "slab_study.toml", slab, correlation),
                                     ("two slabs", "two_slabs_study.toml", two_slabs, ""),
                                     ("wedge", "wedge_study.toml", wedge, "")):
        with tempfile.TemporaryDirectory() as folder:
            text = (Path(case) / plan).read_text().split("[[sample]]")[0]
            text = text.replace("[[reliability]]\n", '[[reliability]]\nmethod = "form"\n' + more)
            for scene in Path(case).glob("*.toml"):
                (Path(folder) / scene.name).write_text(scene.read_text())
            (Path(folder) / "plan.toml").write_text(text)
            found = beta_of(program, Path(folder) / "plan.toml", folder)
        referee = beta_by_referee(found, factor)
        apart = abs(found["beta"] - referee)
        right = apart <= tolerance
        failed += not right
        print(f"{name}: beta {found['beta']:.9f}, OpenTURNS {ot.__version__} {referee:.9f}, "
              f"{apart:.1e} apart{'' if right else f', more than {tolerance:g}: FAILED'}")
    return 1 if failed else 0


if __name__ == "__main__":
    sys.exit(main(*sys.argv[1:3]))
