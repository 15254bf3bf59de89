"""What the commands write as .npz is what numpy.load reads, and the same as CSV. CASIMIR_PROGRAM runs."""

import csv
import os
import shutil
import subprocess
import tempfile
import unittest
import zipfile
from fractions import Fraction
from pathlib import Path

import numpy as np


class Tables(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = Path(folder.name)

    def run_program(self, *words):
        done = subprocess.run([os.environ["CASIMIR_PROGRAM"], *words], cwd=self.folder, capture_output=True, text=True)
        return done.returncode, done.stderr

    def both(self, *words, status=0):
        """The arrays and the rows of the CSV of the same command."""
        for name in ("x.npz", "x.csv"):
            code, errors = self.run_program(*words, "--quiet", "--output", name)
            self.assertEqual(code, status, errors)
        with open(self.folder / "x.csv") as file:
            rows = list(csv.DictReader(line for line in file if not line.startswith("#")))
        return np.load(self.folder / "x.npz"), rows

    def assert_same(self, arrays, rows):
        self.assertGreater(len(rows), 0)
        for name in rows[0]:
            array = arrays[name]
            self.assertEqual(array.shape, (len(rows),), name)
            texts = [row[name] for row in rows]
            if array.dtype.kind == "U":
                self.assertEqual(list(array), texts)
            else:
                numbers = np.array([float(text) if text else np.nan for text in texts])
                np.testing.assert_array_equal(array, numbers, name)

    def test_states_of_a_run(self):
        arrays, rows = self.both("integrate", "kovalevskaya", "--duration", "3", "--every", "0.25")
        self.assert_same(arrays, rows)
        self.assertEqual(arrays.files, ["t", "M1", "M2", "M3", "g1", "g2", "g3"])
        self.assertEqual(arrays["t"].dtype, np.dtype("<f8"))

    def test_more_digits_than_a_double_has_stay_text(self):
        arrays, rows = self.both("integrate", "euler", "--duration", "1", "--digits", "30", "--every", "0.5")
        self.assert_same(arrays, rows)
        self.assertEqual(arrays["M1"].dtype.kind, "U")
        self.assertGreaterEqual(len(arrays["M1"][-1]), 30)

    def test_boxes(self):
        arrays, rows = self.both("integrate", "euler", "--duration", "1", "--validated", "--every", "0.5")
        self.assert_same(arrays, rows)
        self.assertLess(Fraction(str(arrays["M1_low"][-1])), Fraction(str(arrays["M1_high"][-1])))

    def test_a_run_that_stops_says_so(self):
        (self.folder / "blowup.toml").write_text(
            'title = "x"\n[phase_space]\nvariables = ["x"]\n[equations]\nx = "x^2"\n'
            '[[scene]]\nname = "default"\ninitial = { x = "1" }\nduration = "2"\n')
        arrays, rows = self.both("integrate", "./blowup.toml", "--every", "0.1", status=5)
        self.assert_same(arrays, rows)
        self.assertRegex(str(arrays["note"]), r"^stopped at t = (1|0\.999).*singularity")

    def test_members_of_an_ensemble(self):
        (self.folder / "members.csv").write_text("M1\n1\n1.5\n-2\n")
        arrays, rows = self.both("integrate", "euler", "--ensemble", "members.csv", "--duration", "1")
        self.assert_same(arrays, rows)
        self.assertEqual(arrays["member"].dtype, np.dtype("<i8"))
        self.assertEqual(list(arrays["status"]), ["ok"] * 3)

    def test_iterates_of_a_map(self):
        arrays, rows = self.both("integrate", "mcmillan", "--duration", "10")
        self.assert_same(arrays, rows)

    def test_names_that_are_taken_get_an_underscore(self):
        (self.folder / "h.toml").write_text(
            'title = "x"\nhamiltonian = "(u^2 + v^2 + x^2 + y^2)/2 + x^2*y - y^3/3"\n[phase_space]\n'
            'variables = ["x", "y", "u", "v"]\ncanonical = true\n[section]\nfunction = "x"\nplot = ["y", "v"]\n'
            '[[scene]]\nname = "default"\ninitial = { x = "0", y = "1/10", u = "1/2", v = "0" }\nduration = "1"\n')
        code, errors = self.run_program("section", "./h.toml", "--orbits", "3", "--points", "20", "--output", "s.npz")
        self.assertEqual(code, 0, errors)
        arrays = np.load(self.folder / "s.npz")
        self.assertEqual(arrays.files, ["orbit", "n", "t", "u", "v", "x", "y", "u_", "v_"])
        np.testing.assert_array_equal(arrays["u"], arrays["y"])
        np.testing.assert_array_equal(arrays["v"], arrays["v_"])
        self.assertGreater(arrays["u_"].min(), 0)
        (self.folder / "t.toml").write_text(
            'title = "x"\n[phase_space]\nvariables = ["t", "axes"]\n[equations]\nt = "1"\naxes = "2"\n'
            '[[scene]]\nname = "default"\ninitial = { t = "3", axes = "0" }\nduration = "2"\n')
        _, rows = self.both("integrate", "./t.toml", "--every", "1")
        self.assertEqual([(row["t"], row["t_"]) for row in rows], [("0", "3"), ("1", "4"), ("2", "5")])
        arrays, rows = self.both("sweep", "./t.toml", "--over", "t=0:1:2")
        self.assertEqual(len(set(rows[0])), len(rows[0]))
        self.assertEqual(float(rows[1]["axes"]), 4)
        np.testing.assert_array_equal(arrays["axes_"], [4, 4])

    @unittest.skipIf(shutil.which("h5dump") is None, "no h5dump")
    def test_hdf5_has_a_group_of_axes_beside_a_variable_of_that_name(self):
        (self.folder / "t.toml").write_text(
            'title = "x"\n[phase_space]\nvariables = ["t", "axes"]\n[equations]\nt = "1"\naxes = "2"\n'
            '[[scene]]\nname = "default"\ninitial = { t = "3", axes = "0" }\nduration = "2"\n')
        code, errors = self.run_program("sweep", "./t.toml", "--over", "t=0:1:2", "--quiet", "--output", "x.h5")
        self.assertEqual(code, 0, errors)
        self.assertIn("(0): 4, 4", self.dump("-d", "/axes_"))

    def test_a_sweep_has_arrays_of_the_shape_of_its_grid(self):
        words = ("sweep", "kovalevskaya", "--over", "r=1:2:3", "--over", "M1=0:1:2", "--duration", "1")
        arrays, rows = self.both(*words)
        self.assertEqual(arrays["M3"].shape, (3, 2))
        np.testing.assert_array_equal(arrays["axes/r"], [1, 1.5, 2])
        np.testing.assert_array_equal(arrays["M3"].ravel(), [float(row["M3"]) for row in rows])
        self.assertEqual(list(arrays["status"].ravel()), [row["status"] for row in rows])

    def dump(self, *words):
        done = subprocess.run(["h5dump", *words, "x.h5"], cwd=self.folder, capture_output=True, text=True)
        self.assertEqual(done.returncode, 0, done.stderr)
        return done.stdout

    @unittest.skipIf(shutil.which("h5dump") is None, "no h5dump")
    def test_hdf5_has_the_same_numbers(self):
        words = ("integrate", "euler", "--duration", "1", "--every", "0.25", "--quiet", "--output")
        self.assertEqual(self.run_program(*words, "x.h5")[0], 0)
        self.run_program(*words, "x.npz")
        numbers = self.dump("-y", "-w", "1", "-m", "%.17g", "-d", "/M2").split("DATA {")[1].split("}")[0]
        np.testing.assert_array_equal(np.load(self.folder / "x.npz")["M2"],
                                      [float(text) for text in numbers.replace(",", " ").split()])
        self.assertIn('"euler"', self.dump("-a", "/case"))

    @unittest.skipIf(shutil.which("h5dump") is None, "no h5dump")
    def test_hdf5_has_text_and_statuses(self):
        (self.folder / "members.csv").write_text("M1\n1\n2\n")
        self.run_program("integrate", "euler", "--ensemble", "members.csv", "--duration", "1", "--output", "x.h5")
        self.assertRegex(self.dump("-d", "/status"), r"H5T_ENUM[\s\S]*DATA \{\s*\(0\): ok, ok")
        self.run_program("integrate", "euler", "--duration", "1", "--digits", "30", "--every", "1", "--output", "x.h5")
        self.assertRegex(self.dump("-d", "/M1"), r'"1", "0\.[0-9]{28,}')

    def test_rows_of_a_measurement(self):
        arrays, rows = self.both("conserve", "euler", "--scene", "default", "--method", "dop853,taylor")
        # Times differ from run to run.
        for name in ("method", "tolerance", "steps", "status"):
            self.assert_same({name: arrays[name]}, [{name: row[name]} for row in rows])

    def test_the_bytes_depend_on_the_numbers_only(self):
        words = ("integrate", "euler", "--duration", "1", "--quiet", "--output")
        self.run_program(*words, "a.npz")
        self.run_program(*words, "b.npz")
        self.assertEqual((self.folder / "a.npz").read_bytes(), (self.folder / "b.npz").read_bytes())
        with zipfile.ZipFile(self.folder / "a.npz") as archive:
            self.assertIsNone(archive.testzip())
            self.assertEqual({one.compress_type for one in archive.infolist()}, {zipfile.ZIP_STORED})
        self.assertEqual(sorted(one.name for one in self.folder.iterdir()), ["a.npz", "b.npz"])

    def test_other_endings_are_refused(self):
        for command in (["integrate", "euler"], ["section", "euler-poisson"], ["sweep", "euler", "--over", "a1=1:2:2"],
                        ["conserve", "euler"], ["bench", "euler"], ["stress", "euler"]):
            code, errors = self.run_program(*command, "--output", "x.json")
            self.assertEqual(code, 2, command)
            for ending in (".csv", ".npz", ".h5"):
                self.assertIn(ending, errors)
        self.assertEqual(list(self.folder.iterdir()), [])


if __name__ == "__main__":
    unittest.main()
