"""Test help: reads a frame for ParaView (.vtp) and shares no code with the writer."""
import xml.etree.ElementTree as ElementTree
import zlib

import numpy as np


class Frame:
    """A .vtp file."""

    def __init__(self, path):
        # raw bytes, which are no XML, between the elements and the end
        elements, _, self.appended = path.read_bytes().partition(b'<AppendedData encoding="raw">\n_')
        piece = ElementTree.fromstring(elements + b"</VTKFile>").find("PolyData/Piece")
        self.points = next(iter(self.arrays(piece.find("Points")).values()))
        self.point_data, self.cell_data = self.arrays(piece.find("PointData")), self.arrays(piece.find("CellData"))
        polys = self.arrays(piece.find("Polys"))
        self.cells = np.split(polys["connectivity"], polys["offsets"][:-1]) if polys else []

    def arrays(self, parent):
        found = {}
        for array in parent.findall("DataArray") if parent is not None else []:
            numbers = self.numbers(array.get("type"), int(array.get("offset")))
            components = int(array.get("NumberOfComponents") or 1)
            found[array.get("Name") or ""] = numbers.reshape(-1, components) if components > 1 else numbers
        return found

    def numbers(self, kind, offset):
        blocks, _, _, size = np.frombuffer(self.appended, "<u8", 4, offset)
        packed = self.appended[offset + 32:offset + 32 + int(size)] if blocks else zlib.compress(b"")
        return np.frombuffer(zlib.decompress(packed), {"Int64": "<i8", "Float32": "<f4", "Float64": "<f8"}[kind])
