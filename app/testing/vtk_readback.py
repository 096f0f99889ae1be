"""Reads runs of two_cubes.toml and turning_block.toml with VTK's own reader and filters and checks their contents."""
import sys
import xml.etree.ElementTree as ElementTree
from pathlib import Path

import vtk


def read(path):
    errors = []
    reader = vtk.vtkXMLPolyDataReader()
    reader.AddObserver("ErrorEvent", lambda *_: errors.append("error"))
    reader.SetFileName(str(path))
    reader.Update()
    assert not errors, f"VTK cannot read {path}"
    return reader.GetOutput()


def frames_of(folder, collection):
    frames = ElementTree.parse(folder / collection).getroot().findall("Collection/DataSet")
    assert frames, f"{collection} names no file"
    return [(float(frame.get("timestep")), read(folder / frame.get("file"))) for frame in frames]


def last_frame(folder, collection):
    return frames_of(folder, collection)[-1][1]


def area(faces):
    measure = vtk.vtkMassProperties()
    triangles = vtk.vtkTriangleFilter()
    triangles.SetInputData(faces)
    measure.SetInputConnection(triangles.GetOutputPort())
    measure.Update()
    return measure.GetSurfaceArea()


def points(data):
    return [data.GetPoint(k) for k in range(data.GetNumberOfPoints())]


def tuples(data, name):
    array = data.GetPointData().GetArray(name)
    assert array.GetNumberOfTuples() == data.GetNumberOfPoints(), name
    return [array.GetTuple(k) for k in range(array.GetNumberOfTuples())]


def less(a, b):
    return [tuple(p - q for p, q in zip(u, v)) for u, v in zip(a, b)]


def largest(vectors):
    return max(abs(x) for v in vectors for x in v)


def warped(data, vectors, scale=1):
    """The data's points after Warp By Vector."""
    array = vtk.vtkDoubleArray()
    array.SetName("displacement")
    array.SetNumberOfComponents(3)
    for vector in vectors:
        array.InsertNextTuple(vector)
    bent = vtk.vtkPolyData()
    bent.DeepCopy(data)
    bent.GetPointData().SetVectors(array)
    warp = vtk.vtkWarpVector()
    warp.SetInputData(bent)
    warp.SetScaleFactor(scale)
    warp.Update()
    return points(warp.GetOutput())


folder = Path(sys.argv[1])

blocks = last_frame(folder, "blocks.pvd")
assert blocks.GetNumberOfPolys() == 12, blocks.GetNumberOfPolys()
assert abs(area(blocks) - 12) < 1e-9, area(blocks)
cells = blocks.GetCellData()
for name in ("body", "part", "joint", "set", "fixed", "displacement", "velocity"):
    assert cells.HasArray(name), f"no cell data {name}"
assert cells.GetArray("displacement").GetNumberOfComponents() == 3
names = blocks.GetFieldData().GetAbstractArray("joint_names")
assert names.GetNumberOfValues() == 1 and names.GetValue(0) == "bed", names

contacts = last_frame(folder, "contacts.pvd")
assert contacts.GetNumberOfVerts() == 1, contacts.GetNumberOfVerts()
force = contacts.GetPointData().GetArray("force").GetTuple(0)
assert abs(abs(force[2]) - 20000) < 20, force

# a line between the cubes' centroids, and a tube about it as wide as its force
lines = last_frame(folder, "force_lines.pvd")
assert lines.GetNumberOfLines() == 1 and lines.GetNumberOfPoints() == 2
ends = sorted(points(lines), key=lambda point: point[2])
assert largest(less(ends, [(0.5, 0.5, -0.5), (0.5, 0.5, 0.5)])) < 1e-3, ends
assert abs(lines.GetCellData().GetArray("normal_N").GetTuple1(0) - 20000) < 20
assert abs(lines.GetCellData().GetArray("shear_N").GetTuple1(0)) < 20
assert abs(tuples(lines, "magnitude_N")[1][0] - 20000) < 20
lines.GetPointData().SetActiveScalars("magnitude_N")
tube = vtk.vtkTubeFilter()
tube.SetInputData(lines)
tube.SetRadius(0.1)
tube.SetNumberOfSides(6)
tube.SetVaryRadiusToVaryRadiusByAbsoluteScalar()
tube.Update()
assert tube.GetOutput().GetNumberOfStrips() > 0 and tube.GetOutput().GetBounds()[1] > 100, "no tube"

# initial positions, displacements and velocities of the corners of a turning block
folder = Path(sys.argv[2])
frames = frames_of(folder, "blocks.pvd")
assert len(frames) >= 5, len(frames)
start = frames[0][1]
for time, frame in frames:
    displacement = tuples(frame, "displacement")
    single = 2**-23 * largest(displacement) + 1e-14
    assert largest(less(warped(start, less(displacement, tuples(start, "displacement"))), points(frame))) <= single, time
    # as in ParaView: the frame's own array, with a scale of -1
    frame.GetPointData().SetActiveVectors("displacement")
    assert largest(less(warped(frame, displacement, -1), warped(start, tuples(start, "displacement"), -1))) <= single, time
for (_, frame), (time, following) in zip(frames, frames[1:]):
    displacements = tuples(frame, "displacement"), tuples(following, "displacement")
    single = 2**-23 * largest(displacements[1]) + 1e-14
    assert largest(less(warped(frame, less(displacements[1], displacements[0])), points(following))) <= single, time
    moved = less(displacements[1], displacements[0])
    assert max(x for x, _, _ in moved) - min(x for x, _, _ in moved) > 0.05, "nothing turns"

# Over two intervals dt the mean velocity has an error of spin³ × arm × dt² / 6, and the written one is half a step old: spin² ×
# arm × step / 2. The block's corners are 0.83 m from its centroid at most.
spin, arm, step = 1.3, 0.87, 1e-3
for (before, a), (_, b), (after, c) in zip(frames[1:], frames[2:], frames[3:]):
    half = (after - before) / 2
    mean = [tuple(x / (after - before) for x in v) for v in less(points(c), points(a))]
    bound = spin**3 * arm * half**2 / 6 + spin**2 * arm * step / 2
    assert largest(less(mean, tuples(b, "velocity"))) < bound, (before, bound)

# the block's faces of the set, of a joint without one, and of the domain
names = start.GetFieldData().GetAbstractArray("set_names")
assert [names.GetValue(k) for k in range(names.GetNumberOfValues())] == ["bedding"]
names = start.GetFieldData().GetAbstractArray("joint_names")
joints, sets = (start.GetCellData().GetArray(name) for name in ("joint", "set"))
found = {}
for k in range(start.GetNumberOfCells()):
    joint = int(joints.GetTuple1(k))
    key = names.GetValue(joint) if joint >= 0 else "domain", int(sets.GetTuple1(k))
    found[key] = found.get(key, 0) + 1
assert found == {("bedding-1", 0): 2, ("foot", -1): 2, ("domain", -1): 14}, found
print("VTK", vtk.vtkVersion().GetVTKVersion(), "reads blocks, contacts and lines between bodies")
