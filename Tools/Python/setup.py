"""A wheel: pip wheel --no-build-isolation Tools/Python. CMake builds the module, in build/wheel or, of a build that is
there, in the folder PENDULAR_BUILD of the environment."""
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
                            "-DPENDULAR_PYTHON=ON", f"-DPython_EXECUTABLE={sys.executable}"], check=True)
        subprocess.run(["cmake", "--build", folder, "--target", "PendularPython", "--parallel"], check=True)
        to = Path(self.get_ext_fullpath(extension.name)).parent
        to.mkdir(parents=True, exist_ok=True)
        for file in (folder / "Python/pendular").glob("_kernel.*"):
            shutil.copy(file, to)


setup(
    version=re.search(r"VERSION ([\d.]+)", (ROOT / "CMakeLists.txt").read_text().split("project(")[1])[1],
    packages=["pendular"],
    package_dir={"pendular": "Package"},
    package_data={"pendular": ["py.typed"]},
    ext_modules=[Extension("pendular._kernel", [])],
    cmdclass={"build_ext": BuildByCMake},
)
