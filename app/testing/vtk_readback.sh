#!/bin/sh
# vtk_readback.sh PROGRAM FOLDER: runs two scenes and reads their files with VTK; status 77 if VTK is not installed.
here=$(dirname "$0")
for python in python3 /usr/bin/python3; do
  if command -v "$python" >/dev/null && "$python" -c 'import vtk' 2>/dev/null; then
    for scene in two_cubes turning_block; do
      "$1" run "$here/$scene.toml" --out "$2/$scene" --overwrite --quiet || exit 1
    done
    exec "$python" "$here/vtk_readback.py" "$2/two_cubes" "$2/turning_block"
  fi
done
echo "skipped: Python's module vtk is not installed (Debian: python3-vtk9)"
exit 77
