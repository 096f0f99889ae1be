"""The module and the program in it are made by CMake's targets; VOUSSOIR_BUILD_DIR names an existing build folder."""
import os
import re
import shutil
import subprocess
from pathlib import Path

from setuptools import Extension, setup
from setuptools.command.build_ext import build_ext

ROOT = Path(__file__).resolve().parent


class CMakeBuild(build_ext):
    def build_extension(self, extension):
        build = os.environ.get("VOUSSOIR_BUILD_DIR")
        if not build:
            build = Path(self.build_temp).resolve()
            subprocess.run(["cmake", "-S", ROOT, "-B", build, "-G", "Ninja", "-DCMAKE_BUILD_TYPE=Release",
                            "-DVOUSSOIR_BUILD_TESTS=OFF", "-DVOUSSOIR_BUILD_BENCHMARKS=OFF",
                            "-DVOUSSOIR_WITH_PYTHON=ON"], check=True)
        subprocess.run(["cmake", "--build", build, "--parallel", "--target", "voussoir", "voussoir_python"], check=True)
        made = Path(self.get_ext_fullpath(extension.name))
        (made.parent / "bin").mkdir(parents=True, exist_ok=True)
        shutil.copy2(Path(build, "python", "voussoir", made.name), made)
        shutil.copy2(Path(build, "app", "voussoir"), made.parent / "bin" / "voussoir")


version = re.search(r"project\(voussoir VERSION ([\d.]+)", (ROOT / "CMakeLists.txt").read_text(encoding="utf-8"))[1]
setup(version=version, ext_modules=[Extension("voussoir._core", [])], cmdclass={"build_ext": CMakeBuild})
