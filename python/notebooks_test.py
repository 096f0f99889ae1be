"""The notebooks of the examples are executed, and print what they have kept. With --keep they keep what they print now."""
import os
import shutil
import sys
import tempfile
from pathlib import Path

try:
    import matplotlib  # noqa: F401
    import nbformat
    import pandas  # noqa: F401
    from nbconvert.preprocessors import ExecutePreprocessor
except ImportError as error:
    print(f"skipped: {error.name} is not installed (cmake/install_packages.sh notebooks)")
    sys.exit(77)

SOURCE = Path(os.environ["VOUSSOIR_SOURCE_DIR"])
NOTEBOOKS = sorted((SOURCE / "examples/notebooks").glob("*.ipynb"))


def printed(notebook):
    return [output["text"] for cell in notebook.cells for output in cell.get("outputs", [])
            if output["output_type"] == "stream" and output["name"] == "stdout"]


def execute(file, scratch):
    folder = scratch / "examples/notebooks"
    notebook = nbformat.read(file, as_version=4)
    for cell in notebook.cells:
        cell.pop("outputs", None)
        if cell.cell_type == "code":
            cell.outputs = []
    executed, _ = ExecutePreprocessor(timeout=600, kernel_name="python3").preprocess(
        notebook, {"metadata": {"path": str(folder)}})
    for cell in executed.cells:
        cell.metadata = {}  # times of execution
    return executed


def main():
    assert len(NOTEBOOKS) == 2, NOTEBOOKS
    faults = 0
    with tempfile.TemporaryDirectory() as folder:
        scratch = Path(folder)
        for part in ("examples", "docs"):
            shutil.copytree(SOURCE / part, scratch / part)
        for file in NOTEBOOKS:
            now = execute(file, scratch)
            if "--keep" in sys.argv:
                nbformat.write(now, file)
                continue
            kept = printed(nbformat.read(file, as_version=4))
            if not kept or printed(now) != kept:
                faults += 1
                print(f"{file.name} prints {printed(now)}, but has kept {kept}; run it again with --keep, and look at it")
    sys.exit(faults > 0)


main()
