#!/usr/bin/env bash
# wheel_test.sh PYTHON SOURCE BUILD SCRATCH: makes the wheel from the build folder as `pip install .` does, installs it in
# an environment of its own, and runs the tests of its commands there. 77: a tool is not installed.
set -euo pipefail
python=$1 source=$2 build=$3 scratch=$4
if ! { "$python" -m pip --version && "$python" -c "import setuptools, wheel, numpy"; } >/dev/null 2>&1; then
  echo "skipped: pip and its tools are not installed (Debian: python3-pip python3-venv python3-setuptools python3-wheel python3-numpy)"
  exit 77
fi
rm -rf "$scratch"
mkdir -p "$scratch/source"
# pip writes beside the sources
cp -r "$source"/{pyproject.toml,setup.py,CMakeLists.txt,LICENSE} "$scratch/source"
mkdir "$scratch/source/python"
cp -r "$source"/python/{README.md,src} "$scratch/source/python"
VOUSSOIR_BUILD_DIR=$build "$python" -m pip wheel --quiet --no-build-isolation --no-deps --no-index \
  --wheel-dir "$scratch" "$scratch/source"
# the environment needs no pip of its own, which takes longer to install than the rest of it
"$python" -m venv --system-site-packages --without-pip "$scratch/venv"
"$python" -m pip --python "$scratch/venv/bin/python" install --quiet --no-deps --no-index "$scratch"/voussoir-*.whl
unset PYTHONPATH VOUSSOIR_PROGRAM
cd "$scratch"
VOUSSOIR_SOURCE_DIR=$source VOUSSOIR_INSTALLED=1 "$scratch/venv/bin/python" "$source/python/commands_test.py"
