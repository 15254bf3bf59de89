"""Makes a wheel of the package `casimir`, by the hooks of PEP 517: CMake builds the extension, the rest is copied.

A build folder that is kept between builds is named by `pip install tools/python --config-settings build-dir=FOLDER`.
"""

import base64
import hashlib
import os
import re
import subprocess
import sys
import sysconfig
import tempfile
import tomllib
import zipfile
from pathlib import Path

here = Path(__file__).resolve().parent
root = here.parent.parent


class BuildError(Exception):
    """What the build lacks, for whoever asked for it."""


def _version():
    found = re.search(r"^project\(casimir VERSION (\S+)", (root / "CMakeLists.txt").read_text(), re.MULTILINE)
    if not found:
        raise BuildError(f"no version in {root / 'CMakeLists.txt'}: the package is built inside of casimir's sources")
    return found[1]


def _extension(build):
    """The compiled module for this interpreter, built in the folder `build`."""
    if not (build / "CMakeCache.txt").exists():
        subprocess.run(["cmake", "-S", root, "-B", build, "-DCMAKE_BUILD_TYPE=Release", "-DCASIMIR_TESTS=OFF",
                        "-DCASIMIR_UNITY=ON", f"-DPython3_EXECUTABLE={sys.executable}"], check=True)
    jobs = str(os.cpu_count() or 1)
    done = subprocess.run(["cmake", "--build", build, "--target", "casimir_python", "--parallel", jobs], check=False)
    module = build / "python" / "casimir" / f"_core{sysconfig.get_config_var('EXT_SUFFIX')}"
    if done.returncode != 0 or not module.exists():
        raise BuildError(f"CMake made no {module.name}: it needs pybind11 and the headers of {sys.executable} "
                         "(Debian: pybind11-dev, python3-dev), and what the program needs")
    return module


def _metadata():
    project = tomllib.loads((here / "pyproject.toml").read_text())["project"]
    lines = ["Metadata-Version: 2.1", f"Name: {project['name']}", f"Version: {_version()}",
             f"Summary: {project['description']}", f"Requires-Python: {project['requires-python']}"]
    return "\n".join(lines + [f"Requires-Dist: {name}" for name in project["dependencies"]]) + "\n"


def _tag():
    platform = re.sub(r"[-.]", "_", sysconfig.get_platform())
    python = f"cp{sys.version_info.major}{sys.version_info.minor}"
    return f"{python}-{python}-{platform}"


def _files(build):
    """What the wheel holds: name in it and contents."""
    module = _extension(build)
    yield f"casimir/{module.name}", module.read_bytes()
    for pattern in ("*.py", "*.pyi", "py.typed"):
        for file in sorted((here / "casimir").glob(pattern)):
            yield f"casimir/{file.name}", file.read_bytes()
    for file in sorted((root / "cases").rglob("*.toml")):
        yield f"casimir/{file.relative_to(root).as_posix()}", file.read_bytes()
    folder = f"casimir-{_version()}.dist-info"
    yield f"{folder}/METADATA", _metadata().encode()
    yield f"{folder}/LICENSE", (root / "LICENSE").read_bytes()
    yield f"{folder}/WHEEL", f"Wheel-Version: 1.0\nGenerator: casimir\nRoot-Is-Purelib: false\nTag: {_tag()}\n".encode()


def build_wheel(wheel_directory, config_settings=None, metadata_directory=None):
    """Writes the wheel into `wheel_directory` and returns its name."""
    name = f"casimir-{_version()}-{_tag()}.whl"
    record = f"casimir-{_version()}.dist-info/RECORD"
    lines = []
    with tempfile.TemporaryDirectory() as scratch, \
            zipfile.ZipFile(Path(wheel_directory) / name, "w", zipfile.ZIP_DEFLATED) as wheel:
        for path, contents in _files(Path((config_settings or {}).get("build-dir") or scratch).resolve()):
            wheel.writestr(path, contents)
            digest = base64.urlsafe_b64encode(hashlib.sha256(contents).digest()).decode().rstrip("=")
            lines.append(f"{path},sha256={digest},{len(contents)}")
        wheel.writestr(record, "\n".join([*lines, f"{record},,"]) + "\n")
    return name


def build_sdist(sdist_directory, config_settings=None):
    """None is made: the extension is built from all of casimir's sources."""
    raise BuildError("casimir's Python package is built from its repository, as a wheel; there is no source archive")
