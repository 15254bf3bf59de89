"""The wheel that `pip install tools/python` makes: whole, and it runs elsewhere. CASIMIR_BUILD is a build folder."""

import base64
import csv
import hashlib
import os
import subprocess
import sys
import tempfile
import unittest
import zipfile
from pathlib import Path

python = Path(__file__).resolve().parents[3] / "tools" / "python"
sys.path.insert(0, str(python))
import build_backend  # noqa: E402

settings = {"build-dir": os.environ["CASIMIR_BUILD"]}
USE = """
import casimir
top = casimir.load("kovalevskaya")
print(casimir.__file__, casimir.__version__, top.verify().verdict, top.integrate([0, 1]).success,
      len(casimir.cases()) > 100)
"""


class Wheel(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = Path(folder.name)

    def assert_runs(self, place):
        environment = {**os.environ, "PYTHONPATH": str(place), "HOME": str(self.folder)}
        done = subprocess.run([sys.executable, "-c", USE], cwd=self.folder, env=environment, capture_output=True, text=True)
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertEqual(done.stdout.split(), [str(place / "casimir" / "__init__.py"), build_backend._version(),
                                               "proved", "True", "True"])

    def test_is_whole_and_runs_where_it_is_unpacked(self):
        name = build_backend.build_wheel(self.folder, settings)
        with zipfile.ZipFile(self.folder / name) as wheel:
            record = next(file for file in wheel.namelist() if file.endswith(".dist-info/RECORD"))
            rows = {row[0]: row for row in csv.reader(wheel.read(record).decode().splitlines())}
            self.assertEqual(set(rows), set(wheel.namelist()))
            for file in set(rows) - {record}:
                digest = base64.urlsafe_b64encode(hashlib.sha256(wheel.read(file)).digest()).decode().rstrip("=")
                self.assertEqual(rows[file][1:], [f"sha256={digest}", str(len(wheel.read(file)))], file)
            wheel.extractall(self.folder / "unpacked")
        self.assert_runs(self.folder / "unpacked")

    def test_is_installed_by_pip_without_a_network(self):
        command = [sys.executable, "-m", "pip", "install", "--no-index", "--no-deps", "--quiet",
                   "--disable-pip-version-check", "--root-user-action", "ignore", "--target", self.folder / "installed",
                   "--config-settings", f"build-dir={settings['build-dir']}", python]
        done = subprocess.run(command, capture_output=True, text=True)
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assert_runs(self.folder / "installed")

    def test_is_not_made_outside_of_the_sources(self):
        backend = self.folder / "tools" / "python"
        backend.mkdir(parents=True)
        for file in ("build_backend.py", "pyproject.toml"):
            (backend / file).write_text((python / file).read_text())
        (self.folder / "CMakeLists.txt").write_text("project(other)\n")
        done = subprocess.run([sys.executable, "-c", "import build_backend; build_backend.build_wheel('.')"],
                              cwd=backend, capture_output=True, text=True)
        self.assertNotEqual(done.returncode, 0)
        self.assertIn("inside of casimir's sources", done.stderr)


if __name__ == "__main__":
    unittest.main()
