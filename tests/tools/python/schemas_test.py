"""Every command's JSON is what its schema in tools/schemas says. CASIMIR_PROGRAM is run."""

import copy
import json
import os
import subprocess
import tempfile
import unittest
from pathlib import Path

import jsonschema

FOLDER = Path(__file__).resolve().parents[3] / "tools" / "schemas"

BLOWUP = """title = "x"
[phase_space]
variables = ["x"]
[equations]
x = "x^2"
[[scene]]
name = "default"
initial = { x = "1" }
duration = "2"
"""
DUFFING = """title = "x"
[phase_space]
variables = ["c", "s", "x", "y"]
[equations]
c = "-s"
s = "c"
x = "y/4"
y = "(x - x^3)/4 + c/12"
[integrals]
R = "c^2 + s^2"
[[scene]]
name = "default"
initial = { c = "1", s = "0", x = "1/10", y = "1/7" }
"""
FAMILY = """title = "x"
hamiltonian = "(px^2 + py^2 + x^2 + y^2)/2 + x^2*y + c*y^3/3"
[phase_space]
variables = ["x", "y", "px", "py"]
canonical = true
[parameters]
c = {}
"""

ALGEBRA = """title = "x"
hamiltonian = "M1^2 + 2*M2^2 + 3*M3^2"
[phase_space]
variables = ["M1", "M2", "M3"]
algebra = "{}"
"""

#: For each schema command lines, without --json, with the statuses that they may end with.
COMMANDS = {
    "list": [("list",), ("list", "--tag", "map")],
    "show": [("show", "kovalevskaya"), ("show", "euler-lax"), ("show", "./blowup.toml")],
    "show-map": [("show", "mcmillan")],
    "show-nve": [("show", "./family.toml", "--nve", "--param", "c=3"), ("show", "euler", "--nve")],
    "verify": [("verify", "kovalevskaya"), ("verify", "euler", "--integral", "M1"), ("verify", "mcmillan"),
               ("verify", "./family.toml", "--param", "c=3", "--obstruct"),
               ("verify", "kovalevskaya", "--time-limit", "0.000001")],
    "verify-all": [("verify", "--all", "--tag", "map")],
    "search": [("search", "euler", "--degree", "2"), ("search", "lagrange", "--degree", "2", "--casimirs")],
    "search-free": [("search", "./family.toml", "--degree", "3", "--free", "c"),
                    ("search", "./family.toml", "--degree", "1", "--darboux", "--free", "c")],
    "search-darboux": [("search", "./blowup.toml", "--degree", "2", "--darboux")],
    "search-tensors": [("search", "euler", "--degree", "1", "--fields"), ("search", "euler", "--degree", "1", "--forms")],
    "search-orbits": [("search", "./blowup.toml", "--degree", "2", "--fields", "--orbits")],
    "search-conformal": [("search", "damped-body", "--degree", "1", "--fields", "--conformal"),
                         ("search", "./blowup.toml", "--degree", "1", "--forms", "--conformal")],
    "search-separation": [("search", "henon-heiles", "--degree", "1", "--separation"),
                          ("search", "euler", "--degree", "1", "--separation"),
                          ("search", "clebsch", "--degree", "1", "--separation"),
                          ("search", "henon-heiles", "--separation", "--roots", "(u - x)*(u - y)")],
    "exponents": [("exponents", "kovalevskaya"), ("exponents", "henon-heiles")],
    "obstruct": [("obstruct", "henon-heiles"), ("obstruct", "euler-poisson"),
                 ("obstruct", "./family.toml", "--param", "c=3", "--certificate", "c.v"),
                 ("obstruct", "./family.toml", "--param", "c=2")],
    "degrees": [("degrees", "mcmillan")],
    "degrees-all": [("degrees", "--all", "--kahan", "--tag", "free-top")],
    "discretise": [("discretise", "euler", "--kahan", "-o", "kahan.toml"),
                   ("discretise", "euler", "--moser-veselov", "-o", "veselov.toml")],
    "relate": [("relate", "henon-heiles", "henon-heiles", "--bracket"), ("relate", "./rotations.toml", "./boosts.toml"),
               ("relate", "./rotations.toml", "./rotations.toml")],
    "relate-symmetries": [("relate", "lagrange"), ("relate", "./rotations.toml")],
    "equilibria": [("equilibria", "euler"), ("equilibria", "euler", "--validated")],
    "check": [("check", "euler.cert"), ("check", "wide.cert"), ("check", "euler.cert", "--time-limit", "0.0000001"),
              ("check", "chaos.cert"), ("check", "chaos.cert", "--time-limit", "0.0000001")],
    "report": [("report", "./duffing.toml", "--budget", "0", "--output", "duffing.html")],
    "report-all": [("report", "--all", "--tag", "appendix-F", "--budget", "0", "--output", "pages")],
    "generate": [("generate", "euler", "-o", "euler.hpp")],
    "integrate": [("integrate", "euler", "--duration", "1"), ("integrate", "./blowup.toml"),
                  ("integrate", "euler", "--duration", "1", "--method", "taylor", "--observe", "M1")],
    "integrate-digits": [("integrate", "euler", "--duration", "1", "--digits", "30")],
    "integrate-validated": [("integrate", "euler", "--duration", "1", "--validated")],
    "integrate-map": [("integrate", "mcmillan", "--duration", "10")],
    "integrate-ensemble": [("integrate", "euler", "--ensemble", "members.csv", "--duration", "1")],
    "integrate-frequencies": [("integrate", "euler", "--duration", "200", "--frequencies", "2")],
    "section-symmetry": [("section", "euler", "--period", "10.8", "--symmetry", "M2=-M2", "--symmetry", "M3=-M3")],
    "conserve": [("conserve", "euler", "--method", "taylor", "--duration", "1")],
    "section": [("section", "euler-poisson", "--scene", "chaotic", "--orbits", "2", "--points", "5")],
    "section-horseshoe": [("section", "kovalevskaya", "--horseshoe", "--time-limit", "0.1")],
    "bench": [("bench", "euler", "--tolerances", "1e-6", "--method", "taylor", "--budget", "0.01", "--duration", "1")],
    "stress": [("stress", "solvable-algebra", "--method", "taylor")],
    "sweep": [("sweep", "euler", "--over", "a1=1:2:2", "--duration", "1", "--output", "sweep.csv")],
    "survey": [("survey", "euler", "lagrange")],
    "new": [("new", "mytop")],
    "error": [("verify", "nothing"), ("verify", "euler", "--foo"), ("verify", "euler", "--integral", "M1+"),
              ("show", "-")],
}


class Schemas(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.temporary = tempfile.TemporaryDirectory()
        folder = Path(cls.temporary.name)
        (folder / "blowup.toml").write_text(BLOWUP)
        (folder / "family.toml").write_text(FAMILY)
        for name, algebra in (("rotations", "so(3)"), ("boosts", "sl(2)")):
            (folder / f"{name}.toml").write_text(ALGEBRA.format(algebra))
        (folder / "members.csv").write_text("M1\n1\n2\n")
        run = ("integrate", "euler", "--duration", "1", "--validated")
        cls.document(folder, (*run, "--certificate", "euler.cert"))
        cls.document(folder, (*run, "--initial-radius", "0.001", "--certificate", "wide.cert"))
        (folder / "duffing.toml").write_text(DUFFING)
        cls.document(folder, ("section", "./duffing.toml", "--horseshoe", "--plane", "s", "--certificate", "chaos.cert"))
        cls.documents = {
            name: [cls.document(folder, words) for words in lines] for name, lines in COMMANDS.items()
        }

    @classmethod
    def tearDownClass(cls):
        cls.temporary.cleanup()

    @staticmethod
    def document(folder, words):
        done = subprocess.run([os.environ["CASIMIR_PROGRAM"], *words, "--json"], cwd=folder, capture_output=True,
                              text=True, stdin=subprocess.DEVNULL)
        try:
            return json.loads(done.stdout)
        except json.JSONDecodeError:
            raise AssertionError(f"{words}: {done.returncode}\n{done.stdout[:200]}{done.stderr}") from None

    @staticmethod
    def schema(name):
        return json.loads((FOLDER / f"{name}.json").read_text())

    def test_each_is_a_schema_and_has_documents(self):
        names = sorted(path.stem for path in FOLDER.glob("*.json"))
        self.assertEqual(names, sorted(COMMANDS))
        for name in names:
            jsonschema.Draft202012Validator.check_schema(self.schema(name))

    def test_documents_are_valid(self):
        for name, documents in self.documents.items():
            validator = jsonschema.Draft202012Validator(self.schema(name))
            for words, document in zip(COMMANDS[name], documents):
                with self.subTest(name, words=words):
                    self.assertEqual([f"{e.json_path}: {e.message[:200]}" for e in validator.iter_errors(document)], [])

    def test_what_a_schema_asks_for_cannot_be_left_out(self):
        for name, documents in self.documents.items():
            schema = self.schema(name)
            for key in schema["required"]:
                broken = copy.deepcopy(documents[0])
                del broken[key]
                self.assertFalse(jsonschema.Draft202012Validator(schema).is_valid(broken), f"{name} without {key}")

    def test_documents_of_one_command_are_none_of_another(self):
        for name, other in (("verify", "integrate"), ("integrate", "verify"), ("section", "sweep"), ("list", "error")):
            self.assertFalse(jsonschema.Draft202012Validator(self.schema(other)).is_valid(self.documents[name][0]))


if __name__ == "__main__":
    unittest.main()
