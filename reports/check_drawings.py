#!/usr/bin/python3
"""check_drawings.py FOLDER: every drawing below a folder is well-formed XML. Browsers show nothing of a file that is not."""
import pathlib
import sys
import xml.etree.ElementTree


def broken(folder):
    """what is wrong, a line a file"""
    found = []
    for drawing in sorted(pathlib.Path(folder).rglob("*.svg")):
        try:
            xml.etree.ElementTree.parse(drawing)
        except xml.etree.ElementTree.ParseError as problem:
            found.append(f"{drawing.name}: {problem}")
    return found


if __name__ == "__main__":
    wrong = broken(sys.argv[1])
    print("\n".join(wrong) or f"drawings of {sys.argv[1]}: all well-formed")
    sys.exit(bool(wrong))
