#!/bin/sh
# vtk_readback.sh PROGRAM SCENE FOLDER: runs the scene and reads its files with VTK; status 77 where VTK is not installed.
here=$(dirname "$0")
for python in python3 /usr/bin/python3; do
  if command -v "$python" >/dev/null && "$python" -c 'import vtk' 2>/dev/null; then
    "$1" run "$2" --out "$3" --overwrite --quiet || exit 1
    exec "$python" "$here/vtk_readback.py" "$3"
  fi
done
echo "skipped: Python's module vtk is not installed (Debian: python3-vtk9)"
exit 77
