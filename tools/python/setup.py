"""For `pip install tools/python`: the extension is built by CMake, from the sources around this folder."""

import shutil
import subprocess
from pathlib import Path

from setuptools import Extension, setup
from setuptools.command.build_ext import build_ext

here = Path(__file__).resolve().parent
root = here.parent.parent


class Build(build_ext):
    def build_extension(self, ext):
        build = Path(self.build_temp).resolve()
        target = Path(self.get_ext_fullpath(ext.name)).resolve().parent
        configure = ["cmake", "-S", root, "-B", build, "-DCMAKE_BUILD_TYPE=Release", "-DCASIMIR_TESTS=OFF",
                     "-DCASIMIR_UNITY=ON", f"-DPython3_EXECUTABLE={shutil.sys.executable}"]
        subprocess.run(configure, check=True)
        subprocess.run(["cmake", "--build", build, "--target", "casimir_python", "--parallel"], check=True)
        target.mkdir(parents=True, exist_ok=True)
        shutil.copytree(root / "cases", target / "cases", dirs_exist_ok=True)
        for module in (build / "python" / "casimir").glob("_core.*"):
            shutil.copy(module, target)


version = next(line.split()[2] for line in (root / "CMakeLists.txt").read_text().splitlines()
               if line.startswith("project(casimir VERSION"))
setup(
    name="casimir",
    version=version,
    description="An integrability workbench for Hamiltonian systems",
    packages=["casimir"],
    package_data={"casimir": ["py.typed", "*.pyi"]},
    ext_modules=[Extension("casimir._core", [])],
    cmdclass={"build_ext": Build},
    install_requires=["numpy"],
    python_requires=">=3.9",
)
