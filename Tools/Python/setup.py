"""A wheel for any x86-64: pip wheel --no-build-isolation Tools/Python. CMake builds the module for three levels of the
processor in build/wheel; or as it is in the folder of a build that is there, PENDULAR_BUILD of the environment."""
import os
import re
import shutil
import subprocess
import sys
from pathlib import Path

from setuptools import Extension, setup
from setuptools.command.build_ext import build_ext

ROOT = Path(__file__).resolve().parents[2]


class BuildByCMake(build_ext):
    def build_extension(self, extension):
        folder = Path(os.environ.get("PENDULAR_BUILD", ROOT / "build/wheel"))
        if not (folder / "CMakeCache.txt").exists():
            subprocess.run(["cmake", "-S", ROOT, "-B", folder, "-DCMAKE_BUILD_TYPE=Release", "-DPENDULAR_BUILD_TESTS=OFF",
                            "-DPENDULAR_PYTHON=ON", "-DPENDULAR_ALL_LEVELS=ON", f"-DPython_EXECUTABLE={sys.executable}"],
                           check=True)
        isOfAllLevels = "PENDULAR_ALL_LEVELS:BOOL=ON" in (folder / "CMakeCache.txt").read_text()
        target = "PendularPythonLevels" if isOfAllLevels else "PendularPython"
        subprocess.run(["cmake", "--build", folder, "--target", target, "--parallel"], check=True)
        package, to = folder / "Python/pendular", Path(self.get_ext_fullpath(extension.name)).parent
        for file in package.rglob("_kernel.*"):
            (to / file.relative_to(package)).parent.mkdir(parents=True, exist_ok=True)
            shutil.copy(file, to / file.relative_to(package))


setup(
    version=re.search(r"VERSION ([\d.]+)", (ROOT / "CMakeLists.txt").read_text().split("project(")[1])[1],
    packages=["pendular"],
    package_dir={"pendular": "Package"},
    package_data={"pendular": ["py.typed"]},
    ext_modules=[Extension("pendular._kernel", [])],
    cmdclass={"build_ext": BuildByCMake},
)
