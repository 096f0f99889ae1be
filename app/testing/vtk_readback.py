"""Reads a run of two_cubes.toml with VTK's own reader and checks what it holds."""
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


def last_frame(folder, collection):
    frames = ElementTree.parse(folder / collection).getroot().findall("Collection/DataSet")
    assert frames, f"{collection} names no file"
    return read(folder / frames[-1].get("file"))


def area(faces):
    measure = vtk.vtkMassProperties()
    triangles = vtk.vtkTriangleFilter()
    triangles.SetInputData(faces)
    measure.SetInputConnection(triangles.GetOutputPort())
    measure.Update()
    return measure.GetSurfaceArea()


folder = Path(sys.argv[1])

blocks = last_frame(folder, "blocks.pvd")
assert blocks.GetNumberOfPolys() == 12, blocks.GetNumberOfPolys()
assert abs(area(blocks) - 12) < 1e-9, area(blocks)
cells = blocks.GetCellData()
for name in ("body", "part", "joint", "fixed", "displacement", "velocity"):
    assert cells.HasArray(name), f"no cell data {name}"
assert cells.GetArray("displacement").GetNumberOfComponents() == 3
names = blocks.GetFieldData().GetAbstractArray("joint_names")
assert names.GetNumberOfValues() == 1 and names.GetValue(0) == "bed", names

contacts = last_frame(folder, "contacts.pvd")
assert contacts.GetNumberOfVerts() == 1, contacts.GetNumberOfVerts()
force = contacts.GetPointData().GetArray("force").GetTuple(0)
assert abs(abs(force[2]) - 20000) < 20, force
print("VTK", vtk.vtkVersion().GetVTKVersion(), "reads blocks and contacts")
