"""The Python package as its users see it. Run by CTest with PYTHONPATH set to the build tree."""

import contextlib
import doctest
import math
import pickle
import signal
import subprocess
import sys
import threading
import time
import unittest
import warnings
from decimal import Decimal
from fractions import Fraction
from pathlib import Path

import numpy as np

import casimir


#: With one scene, whose motion is free for a = 0.
CUBIC = casimir.Case("""title = "Cubic potential"
hamiltonian = "p^2/2 + a*q^3/3"
[phase_space]
variables = ["q", "p"]
canonical = true
[parameters]
a = {}
[[scene]]
name = "default"
parameters = { a = "0" }
initial = { q = "-1", p = "0" }
duration = "20"
""", name="cubic")


class Cases(unittest.TestCase):
    def test_bundled_ones_are_found_by_name(self):
        self.assertIn("kovalevskaya", casimir.cases())
        top = casimir.load("kovalevskaya")
        self.assertEqual(top.variables, ["M1", "M2", "M3", "g1", "g2", "g3"])
        self.assertIn("default", top.scenes)

    def test_other_variables_are_those_of_the_command_line(self):
        top = casimir.load("kovalevskaya").with_values({"r": 2})
        angles = top.in_variables("euler-angles")
        self.assertEqual(len(angles.variables), 6)
        self.assertNotIn("M1", angles.variables)
        for case in (angles, pickle.loads(pickle.dumps(angles))):
            self.assertTrue(case.verify())
            motion, own = case.integrate(duration=2), top.integrate(duration=2)
            self.assertTrue(motion.success)
            self.assertAlmostEqual(motion.invariants["H"]["initial"], own.invariants["H"]["initial"],
                                   places=13)
        with self.assertRaises(casimir.ModelError):
            top.in_variables("euler-angels")

    def test_names_in_expressions_of_sympy_are_those_of_the_case(self):
        import sympy

        names = ["pi1", "Pi1", "spin", "pi"]
        pi1, other, spin, pi = (sympy.Symbol(name) for name in names)
        case = casimir.Case(equations={"pi1": pi1, "Pi1": 2*other, "spin": pi, "pi": sympy.pi*spin}, variables=names,
                            initial=dict.fromkeys(names, 1))
        np.testing.assert_allclose(case.system().rhs(0, [2, 3, 5, 7]), [2, 6, 7, 5*math.pi], rtol=1e-15)
        still = casimir.Case(equations={"pi1": "1", "Pi1": "0"}, variables=["pi1", "Pi1"])
        self.assertEqual(still.verify(integral=pi1).verdict, "refuted")
        self.assertEqual(still.verify(integral=other).verdict, "proved")
        self.assertEqual(case.sympy("Pi*pi"), sympy.pi*pi)
        word = casimir.Case(equations={"lambda": "-lambda"}, variables=["lambda"])
        self.assertEqual(word.sympy("2*lambda^2"), 2*sympy.Symbol("lambda")**2)

    def test_numbers_of_sympy_are_exactly_those_that_they_are(self):
        import sympy

        x = sympy.Symbol("x")
        for number in (2.0**53 + 2, 1/3, -0.1, 123456789012345678.0, 1e-300):
            case = casimir.Case(equations={"x": sympy.Float(number)*x}, variables=["x"], initial={"x": 1})
            self.assertEqual(case.system().rhs(0, [1.0])[0], number)
        case = casimir.Case(equations={"x": sympy.Abs(x) + sympy.E*x**2}, variables=["x"], initial={"x": 1})
        self.assertAlmostEqual(case.system().rhs(0, [-2.0])[0], 2 + 4*math.e, places=14)
        with self.assertRaises(casimir.Error):
            casimir.Case(equations={"x": sympy.Float("nan")*x}, variables=["x"])

    def test_an_unknown_name_gets_the_nearest(self):
        with self.assertRaises(casimir.CaseError) as caught:
            casimir.load("kovalevskya")
        self.assertIn("kovalevskaya", caught.exception.hint)

    def test_an_error_has_its_place(self):
        with self.assertRaises(casimir.CaseError) as caught:
            casimir.Case('title = "x"\nhamiltonian = "p^2/2 + z"\n[phase_space]\nvariables = ["q", "p"]\n'
                         "canonical = true\n", name="broken")
        error = caught.exception
        self.assertEqual((error.file, error.line, error.column), ("broken.toml", 2, 24))
        self.assertIn("z", error.text)
        again = pickle.loads(pickle.dumps(error))
        self.assertEqual((again.line, str(again)), (2, str(error)))

    def test_from_parts(self):
        oscillator = casimir.Case(hamiltonian="(p^2 + w^2*q^2)/2", variables=["q", "p"], canonical=True,
                                  parameters={"w": Fraction(3, 2)}, initial={"q": 1, "p": 0}, duration=10)
        with self.assertRaises(casimir.RequestError):
            oscillator.integrate([0, 20], duration=10)
        motion = oscillator.integrate([0, 10])
        self.assertAlmostEqual(motion.y[0, 1], math.cos(15), delta=1e-12)

    def test_text_of_strangers_stays_text(self):
        for text in ('a"\nhamiltonian = "1', "\\", "\x7f", "]]"):
            with self.assertRaises(casimir.CaseError):
                casimir.Case(hamiltonian=text, algebra="so(3)")

    def test_pickles_by_text(self):
        top = casimir.load("kovalevskaya").with_values({"r": 2}, {"M1": "1/3"})
        again = pickle.loads(pickle.dumps(top))
        self.assertEqual(again.parameters, [])
        np.testing.assert_array_equal(again.integrate(duration=1).y, top.integrate(duration=1).y)

    def test_numbers_are_exact(self):
        top = casimir.load("kovalevskaya")
        for start in (0.1, np.float64(0.1), Fraction(0.1)):
            motion = top.integrate(duration=1, initial={"M1": start})
            self.assertEqual(motion.y[0, 0], 0.1)
        with self.assertRaises(casimir.RequestError):
            top.integrate(duration=1, initial={"M1": math.nan})
        with self.assertRaises(casimir.RequestError):
            top.integrate(duration=1, initial={"M1": True})


    def test_numbers_out_of_range_are_refused(self):
        top, lyness = casimir.load("euler"), casimir.load_map("lyness")
        for ask in (lambda: top.search(-1), lambda: lyness.search(-1), lambda: top.rational(-1), lambda: top.darboux(-1),
                    lambda: top.tensors(1, -1), lambda: top.bihamiltonian(-1), lambda: top.orbital_symmetries(-1),
                    lambda: top.kahan_degrees(-1), lambda: lyness.degrees(-1), lambda: top.frequencies(lines=0),
                    lambda: top.integrate(step=0), lambda: top.integrate(observe=[]), lambda: top.enclose(digits=-5),
                    lambda: top.enclose(sample_every=0), lambda: top.enclose(sample_every=-1)):
            with self.assertRaises(casimir.RequestError):
                ask()

    def test_an_option_with_the_name_of_a_parameter_is_said_to_be_taken_as_the_option(self):
        case = casimir.Case(equations={"x": "step*x"}, variables=["x"], parameters={"step": 1}, initial={"x": 1},
                            duration=1)
        with self.assertWarnsRegex(UserWarning, "with_values"):
            case.integrate(step=0.5, method="dop853")
        with warnings.catch_warnings():
            warnings.simplefilter("error")
            self.assertAlmostEqual(case.with_values({"step": 0.5}).integrate().y[0, -1], math.exp(0.5), places=12)


class Maps(unittest.TestCase):
    def test_a_bundled_map_is_proved_searched_and_iterated(self):
        self.assertIn("lyness", casimir.maps())
        self.assertNotIn("lyness", casimir.cases())
        lyness = casimir.load_map("lyness")
        self.assertTrue(lyness.verify())
        refuted = lyness.verify(integral="x + y")
        self.assertFalse(refuted)
        self.assertIsInstance(refuted.witness.value, Fraction)
        found = lyness.with_values({"a": 2}).search(3)
        self.assertEqual((len(found), found.no_polynomial, found.no_rational), (1, True, False))
        orbit = lyness.iterate(1000, every=100, a=2)
        self.assertTrue(orbit.success)
        self.assertEqual(orbit.y.shape, (2, 11))
        self.assertEqual(list(orbit.t[:3]), [0, 100, 200])
        self.assertLess(max(orbit.drift.values()), 1e-12)

    def test_the_states_are_those_of_the_formula(self):
        shear = casimir.Map('title = "s"\n[phase_space]\nvariables = ["x", "y"]\n[map]\nx = "x + y^2"\ny = "y/2"\n'
                            '[[scene]]\nname = "default"\ninitial = { x = "1", y = "1" }\nduration = "3"\n')
        orbit = shear.iterate(3, initial={"y": 2})
        np.testing.assert_array_equal(orbit.y, [[1, 5, 6, 6.25], [2, 1, 0.5, 0.25]])
        self.assertEqual(orbit.state, [6.25, 0.25])

    def test_darboux_polynomials_of_a_map_say_what_they_depend_on(self):
        plane = 'title = "m"\n[phase_space]\nvariables = ["x", "y"]\n[map]\n'
        found = casimir.Map(plane + 'x = "2*x/(1-x^2)"\ny = "y/2"\n').darboux(2)
        self.assertEqual(found.combinations, [("multiplier", "1/(x^2 + 1)")])
        self.assertIn("one to one", found.combination_evidence[0])
        self.assertEqual((found.complete, found.has_conjugates), (True, False))
        self.assertTrue(casimir.Map(plane + 'x = "y"\ny = "3*x"\n').darboux(1).has_conjugates)

    def test_a_flow_is_discretised(self):
        kahan = casimir.load("euler").discretise()
        self.assertTrue(kahan.verify())
        self.assertEqual(casimir.load("euler").discretise(step="1/10").parameters, kahan.parameters[:-1])
        again = pickle.loads(pickle.dumps(kahan.with_values({"eps": "1/10"})))
        self.assertNotIn("eps", again.parameters)
        degrees = casimir.load("euler").kahan_degrees(6)
        self.assertEqual((degrees.growth, degrees.entropy), ("polynomial", 0.0))
        self.assertEqual(degrees.confinement, "confined")
        self.assertTrue(all(orbit["recovered"] > orbit["lost"] for orbit in degrees.singularities))
        self.assertTrue(degrees.singularities)
        with self.assertRaises(casimir.RequestError):
            casimir.load("euler").discretise("leapfrog")
        with self.assertRaises(casimir.ModelError):
            casimir.load("lagrange").discretise("moser-veselov")
        self.assertTrue(casimir.load("euler").discretise("moser-veselov", "1/10").with_values(
            {"a1": 1, "a2": "1/2", "a3": "1/4"}).verify())
        with self.assertRaises(casimir.ModelError):
            casimir.load("kepler-sphere").discretise()

    def test_each_kind_says_where_the_other_is_read(self):
        with self.assertRaises(casimir.CaseError):
            casimir.load("lyness")
        with self.assertRaises(casimir.CaseError) as caught:
            casimir.load_map("euler")
        self.assertIn("casimir.load", caught.exception.hint)


class Structure(unittest.TestCase):
    def test_brackets_of_bare_equations(self):
        oscillator = casimir.Case(equations={"q": "p", "p": "-q"}, variables=["q", "p"])
        found = oscillator.hamiltonian(0)
        self.assertEqual(found.verdict, "proved")
        self.assertEqual(found[0]["jacobi"], "proved")
        self.assertIn("q,p", found[0]["brackets"])
        damped = casimir.Case(equations={"q": "p", "p": "-q - p"}, variables=["q", "p"]).hamiltonian(0)
        self.assertEqual(len(damped), 0)

    def test_what_is_not_proved_is_no_truth_value(self):
        algebraic = casimir.Case(equations={"x": "y", "y": "-x"}, variables=["x", "y"]).rational(1)
        self.assertEqual(algebraic.verdict, "undecided")
        with self.assertRaises(casimir.UndecidedError):
            bool(algebraic)
        with self.assertRaises(AttributeError):
            algebraic.nothing

    def test_tensors_symmetries_and_relations(self):
        euler = casimir.load("euler")
        self.assertTrue(euler.tensors(2, 1))
        rotation = casimir.Case(equations={"x": "y", "y": "-x"}, variables=["x", "y"])
        fields = rotation.orbital_symmetries(1)
        self.assertEqual((fields.verdict, fields.trivial), ("proved", 1))
        self.assertEqual([one["components"] for one in fields], [{"x": "x", "y": "y"}])
        self.assertEqual(fields.not_on, [])
        self.assertEqual(casimir.load("neumann").search(1).not_on, casimir.load("neumann").tensors(1, 0).not_on)
        self.assertIn("not about the constraints", repr(casimir.load("kovalevskaya").tensors(1, 0)))
        found = casimir.Case(equations={"x": "x*y + y^2", "y": "y^2"}, variables=["x", "y"]).tensors(1, 0, conformal=True)
        self.assertEqual((found[0]["components"], found[0]["factor"]), ({"x": "1"}, "-y"))
        self.assertEqual(found.rational, "proved")

    def test_the_spectrum_of_a_lax_pair_is_counted(self):
        pair = next(one for one in casimir.load("lagrange-lax").verify() if one.kind == "lax")
        self.assertEqual((pair.spectrum["verdict"], pair.spectrum["leaf"]), ("proved", 4))
        self.assertIsNone(casimir.load("euler").verify()[0].spectrum)

    def test_relations_and_symmetries(self):
        euler = casimir.load("euler")
        with self.assertRaises(casimir.ModelError):  # it needs numbers
            euler.relate(euler)
        one, other = (euler.with_values({"a1": 1, "a2": 2, "a3": last}) for last in (3, 4))
        self.assertEqual(one.relate(other).verdict, "refuted")
        self.assertEqual(len(casimir.load("lagrange").symmetries()), 1)


class Proofs(unittest.TestCase):
    def test_a_case_is_proved(self):
        verification = casimir.load("kovalevskaya").verify()
        self.assertTrue(verification)
        self.assertEqual(verification["K"].verdict, "proved")
        self.assertIn("<table>", verification._repr_html_())

    def test_a_false_candidate_has_an_exact_witness(self):
        verification = casimir.load("euler").verify(integral="M1^2 + 2*M2^2 - M3^2")
        self.assertFalse(verification)
        witness = verification.witness
        self.assertIsInstance(witness.value, Fraction)
        self.assertNotEqual(witness.value, 0)
        # The derivative at the witness, by hand: dM/dt = M x A M with the values that it gives.
        m = [witness.point[name] for name in ("M1", "M2", "M3")]
        a = [witness.point[name] for name in ("a1", "a2", "a3")]
        rate = [m[1] * a[2] * m[2] - m[2] * a[1] * m[1], m[2] * a[0] * m[0] - m[0] * a[2] * m[2],
                m[0] * a[1] * m[1] - m[1] * a[0] * m[0]]
        self.assertEqual(2 * m[0] * rate[0] + 4 * m[1] * rate[1] - 2 * m[2] * rate[2], witness.value)

    def test_undecided_is_neither_true_nor_false(self):
        undecided = casimir.load("kovalevskaya").verify(time_limit=1e-9)
        self.assertEqual(undecided.verdict, "undecided")
        with self.assertRaises(casimir.UndecidedError):
            bool(undecided)

    def test_search_finds_the_integral(self):
        bare = casimir.Case(hamiltonian="(M1^2 + M2^2 + 2*M3^2)/2 - g1", algebra="e(3)")
        found = bare.search(4)
        self.assertEqual(found.verdict, "proved")
        quartic = [one for one in found if one.degree == 4]
        self.assertEqual(len(quartic), 1)
        self.assertTrue(bare.verify(integral=quartic[0].text))

    def test_search_by_degrees_in_parts_and_own_weights(self):
        cubic = casimir.Case(hamiltonian="(p1^2 + p2^2)/2 + q1^2*q2 + c*q2^3",
                             variables=["q1", "q2", "p1", "p2"], canonical=True, parameters=["c"])
        known = cubic.with_values({"c": Fraction(16, 3)})
        found = known.search(degree_in={"momenta": 4, "rest": 6})
        self.assertEqual((len(found), found.verdict), (1, "proved"))
        self.assertEqual(found.degree_in, [(["p1", "p2"], 4), (["q1", "q2"], 6)])
        self.assertEqual(known.search(degree_in={("p1", "p2"): 3, "rest": 6}).found, [])
        weighted = known.search(12, weights="auto")
        self.assertEqual(weighted.weights, {"q1": 2, "q2": 2, "p1": 3, "p2": 3})
        self.assertEqual([one.degree for one in weighted], [12])
        values = [one.parameters["c"] for one in cubic.search(degree_in={"momenta": 4, "rest": 6}, free="c").conditions]
        self.assertEqual(set(values), {"1/3", "2", "16/3"})
        for ask in (lambda: known.search(), lambda: known.search(4, degree_in={"q9": 1}),
                    lambda: known.search(4, degree_in=["momenta"]), lambda: cubic.search(4, weights="auto", free="c")):
            with self.assertRaises((casimir.Error, TypeError, ValueError)):
                ask()

    def test_free_parameters(self):
        family = casimir.Case(hamiltonian="(px^2 + py^2 + x^2 + y^2)/2 + x^2*y + c*y^3/3",
                              variables=["x", "y", "px", "py"], canonical=True, parameters=["c"])
        found = family.search(3, free="c")
        self.assertIn("1", [one.parameters["c"] for one in found])

    def test_exponents_darboux_and_obstruction(self):
        top = casimir.load("euler")
        self.assertTrue(top.exponents().balances)
        henon = casimir.Case(hamiltonian="(px^2 + py^2 + x^2 + y^2)/2 + x^2*y - y^3/3",
                             variables=["x", "y", "px", "py"], canonical=True)
        self.assertIn("meromorphic", henon.obstruct().excluded)
        volterra = casimir.Case(equations={"x": "x*(1 - y)", "y": "y*(x - 1)"}, variables=["x", "y"])
        self.assertEqual(sorted(one.text for one in volterra.darboux(1)), ["x", "y"])
        family = casimir.Case(equations={"x": "x*(1 + y)", "y": "a + y*(x - 1)"}, variables=["x", "y"],
                              parameters=["a"])
        self.assertIn({"a": "0"}, [one["parameters"] for one in family.darboux(1, free="a")])

    def test_latex_for_notebooks(self):
        self.assertIn("\\dot", casimir.load("kovalevskaya")._repr_latex_().replace("\\frac{d", "\\dot"))

    def test_two_threads_may_prove_at_once(self):
        verdicts = []

        def prove():
            for _ in range(5):
                verdicts.append(casimir.load("clebsch").verify().verdict)

        threads = [threading.Thread(target=prove) for _ in range(3)]
        for thread in threads:
            thread.start()
        for thread in threads:
            thread.join()
        self.assertEqual(verdicts, ["proved"] * 15)


class Runs(unittest.TestCase):
    def test_the_shape_is_that_of_scipy(self):
        motion = casimir.load("kovalevskaya").integrate(np.linspace(0, 10, 101))
        self.assertEqual(motion.y.shape, (6, 101))
        self.assertTrue(motion.success and motion["status"] == 0)
        self.assertEqual(motion.sol(2.5).shape, (6,))
        self.assertEqual(motion.sol([1, 2]).shape, (6, 2))
        np.testing.assert_allclose(motion.sol(motion.t), motion.y, rtol=0, atol=0)
        self.assertLess(max(motion.drift.values()), 1e-12)
        self.assertLess(motion.trust["error_estimate"], 1e-9)

    def test_steps_without_times(self):
        motion = casimir.load("kovalevskaya").integrate(duration=10)
        self.assertEqual(motion.t[0], 0)
        self.assertEqual(motion.t[-1], 10)
        self.assertTrue((np.diff(motion.t) > 0).all())

    def test_backwards_comes_back(self):
        top = casimir.load("kovalevskaya")
        there = top.integrate([3])
        with self.assertRaises(casimir.CaseError):
            top.integrate([1], initial={"g1": 0.7})
        start = {name: float(value) for name, value in zip(top.variables, there.y[:, -1])}
        back = top.integrate([-1, -3], initial=start)
        np.testing.assert_allclose(back.y[:, -1], top.system().initial, atol=1e-13)

    def test_a_singularity_is_no_success(self):
        blowup = casimir.Case(equations={"x": "x^2"}, variables=["x"], initial={"x": 1}, duration=2)
        motion = blowup.integrate([0.5, 0.9, 1.5])
        self.assertFalse(motion.success)
        self.assertEqual(motion.reason, "singularity")
        self.assertEqual(list(motion.t), [0.5, 0.9])
        np.testing.assert_allclose(motion.y[0], [2, 10], rtol=1e-12)

    def test_what_the_command_line_warns_of_is_here(self):
        lorenz = casimir.Case(equations={"x": "10*(y - x)", "y": "x*(28 - z) - y", "z": "x*y - 8*z/3"},
                              variables=["x", "y", "z"], initial={"x": 1, "y": 1, "z": 1}, duration=100)
        self.assertTrue(lorenz.integrate().warnings)

    def test_parameters_by_name(self):
        top = casimir.load("kovalevskaya")
        self.assertNotEqual(top.integrate([1], r=2).y[0, 0], top.integrate([1], r=1).y[0, 0])
        with self.assertRaises(casimir.CaseError):
            top.integrate([1], R=2)

    def test_an_unknown_method_gets_the_nearest(self):
        with self.assertRaises(casimir.RequestError) as caught:
            casimir.load("euler").integrate(method="dop835")
        self.assertIn("dop853", str(caught.exception))

    def test_complex_numbers_and_bare_starts_are_refused(self):
        top = casimir.load("euler")
        start = top.system().initial
        for call in (lambda: top.system().rhs(0, start + 1j), lambda: top.system().flow(start + 1j, 1),
                     lambda: top.ensemble([start + 1j, start])):
            with self.assertRaisesRegex(TypeError, "complex"):
                call()
        with self.assertRaisesRegex(TypeError, "names with their values"):
            top.integrate(initial=[1, 2, 3])
        self.assertEqual(top.system().rhs(0, [1, 2, 3]).shape, (3,))

    def test_an_ensemble_is_its_members(self):
        top = casimir.load("kovalevskaya")
        start = top.system().initial
        rng = np.random.default_rng(1)
        many = start + 0.01 * rng.standard_normal((20, 6))
        ends = top.ensemble(many, duration=5, tolerance=1e-12)
        self.assertTrue(ends.success)
        self.assertRegex(ends.warnings[0], "member 1: the constraint .*, and 19 more members")
        self.assertEqual(top.ensemble([start], duration=1).warnings, [])
        with self.assertRaisesRegex(casimir.RequestError, "member 1: the assumption r != 0"):
            top.ensemble([start], parameters={"r": [0]}, duration=1)
        with self.assertRaisesRegex(casimir.RequestError, "there are two columns 'g1'"):
            top.ensemble([[1, 2]], variables=["g1", "g1"], duration=1)
        flow = top.system(method="taylor")
        for row, end in zip(many, ends.y):
            np.testing.assert_allclose(end, flow.flow(row, 5, 1e-12), atol=1e-10)

    def test_a_flow_asks_for_the_assumptions(self):
        top = casimir.load("kovalevskaya").system(keep=["r"])
        self.assertEqual(top.flow(top.initial, 1, parameters=[2]).shape, (6,))
        with self.assertRaisesRegex(casimir.RequestError, "the assumption r != 0"):
            top.flow(top.initial, 1, parameters=[0])

    def test_an_ensemble_over_a_parameter(self):
        top = casimir.load("kovalevskaya")
        start = np.tile(top.system().initial, (3, 1))
        ends = top.ensemble(start, parameters={"r": [1, 2, 3]}, duration=2, tolerance=1e-12)
        for r, end in zip((1, 2, 3), ends.y):
            np.testing.assert_allclose(end, top.integrate([2], r=r).y[:, 0], atol=1e-9)

    def test_the_right_hand_side_is_that_of_the_equations(self):
        system = casimir.load("kovalevskaya").system(method="radau5")
        m1, m2, m3, g1, g2, g3 = y = np.array([0.3, -0.2, 0.5, 0.1, 0.7, -0.4])
        m, g = y[:3], y[3:]
        dh = np.array([m1, m2, 2 * m3])
        expected = np.concatenate([np.cross(m, dh) + np.cross(g, [-1, 0, 0]), np.cross(g, dh)])
        np.testing.assert_allclose(system.rhs(0, y), expected, atol=1e-15)
        h = 1e-6
        numeric = np.stack([(system.rhs(0, y + h * e) - system.rhs(0, y - h * e)) / (2 * h) for e in np.eye(6)], 1)
        np.testing.assert_allclose(system.jacobian(0, y), numeric, atol=1e-8)
        with self.assertRaises(casimir.RequestError):
            system.rhs(0, y[:5])

    def test_sections(self):
        henon = casimir.Case(hamiltonian="(u^2 + v^2 + x^2 + y^2)/2 + x^2*y - y^3/3", canonical=True,
                             variables=["x", "y", "u", "v"], duration=1,
                             initial={"x": 0, "y": "1/10", "u": "1/2", "v": 0})
        section = henon.section(plane="x", plot=["y", "v"], energy=1 / 8, orbits=5, points=50)
        self.assertEqual(len(section), 5)
        orbit = max(section, key=lambda one: len(one.points))
        x, y, u, v = orbit.states.T
        np.testing.assert_allclose((u**2 + v**2 + x**2 + y**2) / 2 + x**2 * y - y**3 / 3, 1 / 8, atol=1e-10)

    def test_compiled_code_may_call_the_right_hand_side(self):
        import ctypes

        system = casimir.load("kovalevskaya").system()
        y = np.array([0.3, -0.2, 0.5, 0.1, 0.7, -0.4])
        function, data = system._core.address(None)
        pointer, context = ctypes.pythonapi.PyCapsule_GetPointer, ctypes.pythonapi.PyCapsule_GetPointer
        pointer.restype, pointer.argtypes = ctypes.c_void_p, [ctypes.py_object, ctypes.c_char_p]
        signature = b"void (double, double *, double *, void *)"
        doubles = ctypes.POINTER(ctypes.c_double)
        call = ctypes.CFUNCTYPE(None, ctypes.c_double, doubles, doubles, ctypes.c_void_p)(pointer(function, signature))
        rates = np.empty(6)
        call(0.0, y.ctypes.data_as(doubles), rates.ctypes.data_as(doubles), context(data, None))
        np.testing.assert_array_equal(rates, system.rhs(0, y))
        with self.assertRaises(casimir.RequestError) as caught:
            system._core.address("M4")
        self.assertIn("M1", str(caught.exception))

    def test_scipy_integrates_a_rate_after_the_system_is_gone(self):
        try:
            from scipy.integrate import quad
        except ImportError:
            self.skipTest("no SciPy")
        driven = casimir.Case(equations={"x": "x^2*cos(t)"}, variables=["x"], time="t", initial={"x": 1}, duration=1)
        rate = driven.system().low_level("x")
        self.assertAlmostEqual(quad(rate, 0, 3)[0], 9, delta=1e-12)  # without a time it is 0
        self.assertAlmostEqual(quad(rate, 0, 3, args=(math.pi / 3,))[0], 4.5, delta=1e-12)
        with warnings.catch_warnings():
            warnings.simplefilter("ignore")
            self.assertTrue(math.isnan(quad(rate, 0, 3, args=(0.0, 1.0))[0]))  # too many numbers

    def test_progress_is_told(self):
        top = casimir.load("kovalevskaya")
        for work in (lambda tell: top.integrate(duration=2000, tolerance=1e-12, progress=tell),
                     lambda tell: top.ensemble(np.tile(top.system().initial, (300, 1)), duration=20, progress=tell),
                     lambda tell: top.section(orbits=4, points=50, progress=tell)):
            shares = []
            work(shares.append)
            self.assertEqual(shares[-1], 1)
            self.assertTrue(all(0 <= share <= 1 for share in shares))

    def test_a_bar_of_tqdm_fills(self):
        class Bar:
            n, total = 0, None

            def update(self, more):
                self.n += more

        bar = Bar()
        casimir.load("kovalevskaya").integrate(duration=10, progress=bar)
        self.assertEqual(bar.n, 1)

    def test_what_progress_raises_ends_the_run(self):
        def stop(share):
            raise KeyError("enough")

        top = casimir.load("kovalevskaya")
        begun = time.monotonic()
        with self.assertRaises(KeyError):
            top.integrate(duration=1e8, tolerance=1e-14, progress=stop)
        self.assertLess(time.monotonic() - begun, 10)

    def test_parts_of_an_ensemble_are_the_whole(self):
        top = casimir.load("kovalevskaya")
        many = top.system().initial + 0.01 * np.random.default_rng(2).standard_normal((200, 6))
        whole, parts = top.ensemble(many, duration=3), top.ensemble(many, duration=3, progress=lambda share: None)
        np.testing.assert_array_equal(whole.y, parts.y)
        self.assertEqual(whole.status, parts.status)

    def test_results_are_tables_in_notebooks(self):
        top = casimir.load("kovalevskaya")
        cut = top.section(orbits=2, points=5)
        bare = casimir.Case(hamiltonian="(M1^2 + M2^2 + 2*M3^2)/2 - g1", algebra="e(3)")
        for result, part in ((top.integrate(duration=1), "drift of H"), (cut, "crossings"), (bare.search(2), "proved"),
                             (top.exponents(), "exponents"), (top.ensemble([top.system().initial], duration=1), "ok")):
            self.assertTrue(result._repr_html_().startswith("<table>"))
            self.assertIn(part, result._repr_html_())

    def test_cycles_of_a_section_are_proved_and_close(self):
        henon = casimir.load("henon-heiles")
        cut = henon.section(orbits=6, points=60, cycles=1, proved=True, rotation=True)
        self.assertTrue(cut.cycles)
        self.assertTrue(all(orbit.rotation is not None for orbit in cut.orbits))
        proved = [cycle for cycle in cut.cycles if cycle.proof.verdict == "proved"]
        self.assertTrue(proved)
        for cycle in proved:
            low, high = cycle.proof.period
            self.assertLess(high - low, Fraction(1, 10**8))
            self.assertAlmostEqual(float(low), cycle.period, 6)
            start = dict(zip(cut.names, cycle.states[0]))
            end = henon.integrate(initial=start, duration=cycle.period).y[:, -1]
            np.testing.assert_allclose(end, cycle.states[0], atol=1e-5)
            self.assertEqual(cycle.proof.kind, cycle.kind)
        with self.assertRaises(casimir.RequestError):
            henon.section(proved=True)

    def test_rotation_numbers_lie_in_the_unit_interval_or_have_a_reason(self):
        for orbit in casimir.load("henon-heiles").section(orbits=4, points=300, rotation=True):
            rotation = orbit.rotation
            if rotation.kind == "none":
                self.assertTrue(rotation.reason)
                self.assertIsNone(rotation.number)
            else:
                self.assertTrue(0 <= rotation.number <= 1 and rotation.error < 1e-3, rotation)

    def test_proved_equilibria_contain_those_that_were_found(self):
        pendulum = casimir.Case(hamiltonian="p^2/2 - cos(q)", variables=["q", "p"], canonical=True,
                                initial={"q": 1, "p": 0}, duration=1)
        rests = pendulum.equilibria(proved=True)
        self.assertEqual({rest.proof.stability for rest in rests if rest.proof.verdict == "proved"},
                         {"stable", "unstable"})
        for rest in rests:
            self.assertTrue(rest.proof)
            for (low, high), value in zip(rest.proof.enclosure.values(), rest.state):
                self.assertLess(max(abs(float(low) - value), abs(float(high) - value)), 1e-6)
        self.assertIsNone(pendulum.equilibria()[0].proof)

    def test_a_certificate_is_checked_and_a_bent_one_refused(self):
        import tempfile

        with tempfile.TemporaryDirectory() as folder:
            path = Path(folder, "run.json")
            box = casimir.load("euler").enclose(duration=1, certificate=path)
            checked = casimir.check(path)
            self.assertTrue(checked)
            self.assertEqual(checked.kind, "run")
            for name, (low, high) in checked.parts[0]["enclosure"].items():  # in other arithmetic
                self.assertLess(high - low, Fraction(1, 10**10))
                self.assertTrue(low <= box.end.intervals[name][1] and box.end.intervals[name][0] <= high)
            self.assertEqual([file.name for file in Path(folder).iterdir()], ["run.json"])
            with self.assertRaises(FileNotFoundError):
                casimir.load("euler").enclose(duration=1, certificate=Path(folder, "none", "run.json"))
            pole = casimir.Case(equations={"x": "x^2"}, variables=["x"], initial={"x": 1}, duration=2)
            self.assertFalse(pole.enclose(certificate=Path(folder, "pole.json")).success)
            self.assertFalse(Path(folder, "pole.json").exists())
            path.write_text(path.read_text().replace("euler", "eulex", 1))
            with self.assertRaises(casimir.CaseError):
                casimir.check(path)  # its digest is that of another text
            with self.assertRaises(casimir.CaseError):
                casimir.check(Path(folder, "none.json"))

    def test_proofs_are_written_for_coq(self):
        import tempfile

        with tempfile.TemporaryDirectory() as folder:
            path = Path(folder, "euler.v")
            proof = casimir.load("euler").verify(certificate=path)
            self.assertEqual(proof.verdict, "proved")
            self.assertIn("ring", path.read_text())
            self.assertEqual([one.split()[0] for one in proof.left_out], ["independence", "rank", "liouville"])
            false = casimir.load("euler").verify(integral="M1", certificate=Path(folder, "false.v"))
            self.assertEqual(false.verdict, "refuted")
            mills = casimir.Case(hamiltonian="(px^2 + py^2 + x^2 + y^2)/2 + x^2*y^2", canonical=True,
                                 variables=["x", "y", "px", "py"])
            right = Path(folder, "right.v")
            self.assertEqual(mills.obstruct(certificate=right).verdict, "proved")
            self.assertIn("Theorem no_polynomial_", right.read_text())
            self.assertEqual(casimir.load("henon-heiles").obstruct(certificate=Path(folder, "none.v")).verdict,
                             "undecided")
            self.assertEqual(sorted(file.name for file in Path(folder).iterdir()), ["euler.v", "right.v"])
            # The same files as those of the program, which Coq checks in other tests.
            program = sys.modules["casimir._case"]._program.program()
            subprocess.run([program, "verify", "euler", "--certificate", "other.v", "--quiet"], cwd=folder, check=True)
            self.assertEqual(Path(folder, "other.v").read_text(), path.read_text())
            for wrong in ("euler.txt", "1.v", "a b.v"):
                with self.assertRaises(casimir.RequestError):
                    casimir.load("euler").verify(certificate=Path(folder, wrong))

    def test_cycles_are_certified_and_symmetric_ones_found(self):
        import tempfile

        with tempfile.TemporaryDirectory() as folder:
            path = Path(folder, "cycles.json")
            cut = casimir.load("henon-heiles").section(orbits=4, points=50, cycles=1, proved=True, certificate=path)
            checked = casimir.check(path)
            self.assertEqual((checked.kind, len(checked.parts)), ("cycles", cut.certified))
            self.assertTrue(checked)
            self.assertGreater(cut.certified, 0)
            with self.assertRaises(casimir.RequestError):
                casimir.load("henon-heiles").section(orbits=1, points=5, certificate=path)
        swing = casimir.Case(equations={"q": "p", "p": "-sin(q)"}, variables=["q", "p"], initial={"q": 1, "p": 0},
                             duration=6.5)
        cycle = swing.symmetric_cycle({"q": "-q", "p": "-p"})
        self.assertEqual(cycle.order, 2)
        # T = 4 K(sin(q0/2)), with q0 where p is zero: by the arithmetic-geometric mean
        energy = cycle.state[1] ** 2 / 2 - math.cos(cycle.state[0])
        a, b = 1.0, math.sqrt((1 - energy) / 2)
        for _ in range(8):
            a, b = (a + b) / 2, math.sqrt(a * b)
        self.assertAlmostEqual(cycle.period, 2 * math.pi / a, places=10)
        self.assertTrue(cycle.stable)
        for wrong in ({"period": math.nan}, {"period": -3.0}, {"tolerance": math.nan}, {"tolerance": 0.0}):
            with self.assertRaisesRegex(casimir.RequestError, "positive finite"):
                swing.symmetric_cycle({"q": "-q", "p": "-p"}, **wrong)
        with self.assertRaises(casimir.RequestError):
            swing.integrate(max_steps=-1)
        with self.assertRaises(casimir.CaseError):
            swing.symmetric_cycle({"x": "-q"})
        with self.assertRaises(casimir.RequestError):
            swing.symmetric_cycle({"q": "-q"})  # does not take motions to motions

    def test_orbits_of_a_section_begin_at_seeds(self):
        top = casimir.load("henon-heiles")
        own = top.section(orbits=3, points=20)
        again = top.section(seeds=[orbit.seed for orbit in own], points=20)
        self.assertEqual(len(again), 3)
        for orbit, other in zip(own, again):
            np.testing.assert_allclose(orbit.points, other.points, rtol=0, atol=1e-9)
        with self.assertRaisesRegex(casimir.RequestError, "seed 1 is not on the level"):
            top.section(seeds=own[0].seed + 0.1, points=5)
        with self.assertRaisesRegex(casimir.RequestError, "numbers instead of 4"):
            top.section(seeds=[[1.0, 2.0]], points=5)

    def test_chaos_is_a_theorem_with_a_certificate_or_undecided(self):
        import tempfile

        duffing = casimir.Case(equations={"c": "-s", "s": "c", "x": "y/4", "y": "(x - x^3)/4 + c/12"},
                               variables=["c", "s", "x", "y"], integrals={"R": "c^2 + s^2"},
                               initial={"c": 1, "s": 0, "x": "1/10", "y": "1/7"}, duration=10)
        with tempfile.TemporaryDirectory() as folder:
            path = Path(folder, "chaos.json")
            chaos = duffing.horseshoe(plane="s", certificate=path)
            self.assertEqual(chaos.verdict, "proved", chaos.reason)
            self.assertTrue(chaos)
            self.assertGreater(chaos.entropy, 0)
            self.assertIn("no further real-analytic integral", chaos.theorem)
            self.assertTrue(all(of in chaos.sets and to in chaos.sets for of, to in chaos.coverings))
            low, high = chaos.levels["R"]
            self.assertTrue(low <= 1 <= high)
            checked = casimir.check(path)
            self.assertTrue(checked)
            self.assertEqual(checked.parts[0]["entropy"], chaos.entropy)
            none = duffing.with_values(initial={"y": 0}).horseshoe(plane="s", certificate=Path(folder, "none.json"),
                                                                   time_limit=0.01)
            self.assertEqual(none.verdict, "undecided")
            self.assertFalse(Path(folder, "none.json").exists())
            with self.assertRaises(casimir.UndecidedError):
                bool(none)
        with self.assertRaises(casimir.RequestError):
            duffing.horseshoe(plane="s", direction="sideways")
        with self.assertRaisesRegex(casimir.RequestError, "finite"):
            casimir.load("henon-heiles").horseshoe(energy=math.nan)
        with self.assertRaises(casimir.RequestError):
            duffing.horseshoe(plane="s", longest=-1)

    def test_the_program_makes_pages_and_the_matrix_of_extreme_scenes(self):
        import tempfile
        from unittest import mock

        euler = casimir.load("euler")
        top = euler.with_values({"a1": 1, "a2": 2, "a3": 3})
        with tempfile.TemporaryDirectory() as folder:
            page = CUBIC.report(Path(folder, "page.html"), budget=0)
            self.assertEqual((page.verdict, page.ok), ("proved", True))
            page = CUBIC.with_values({"a": 1}).report(Path(folder, "page.html"), budget=0)
            self.assertEqual((page.verdict, page.ok), ("proved", False))  # its motion ends at a pole then
            cut = euler.report(Path(folder, "cut.html"), budget=0, time_limit=0.01)
            self.assertFalse(cut.ok)
            Path(cut).unlink()
            self.assertIn("--param a=1", Path(page).read_text())
            self.assertEqual([file.name for file in Path(folder).iterdir()], ["page.html"])
            with self.assertRaisesRegex(casimir.RequestError, "must end in .html"):
                euler.report(Path(folder, "page.txt"))
            with self.assertRaises(casimir.EnvironmentProblem):
                euler.report(Path(folder, "none", "page.html"))
        text = casimir.new("pendulums", canonical=2)
        self.assertEqual(casimir.Case(text, name="pendulums").variables, ["q1", "q2", "p1", "p2"])
        with self.assertRaises(casimir.RequestError):
            casimir.new("top", algebra="e(3)", canonical=2)
        with self.assertRaisesRegex(casimir.RequestError, "cannot name a case"):
            casimir.new("--json x")
        rows = casimir.survey("so(3)")
        self.assertIn("euler", [row["case"] for row in rows])
        self.assertEqual({row["verdict"] for row in rows}, {"proved"})
        exact, numeric = top.exponents(), top.exponents(numeric=True)
        self.assertEqual((exact.starts, numeric.complete), (0, False))
        self.assertGreater(numeric.starts, 0)
        with self.assertRaisesRegex(casimir.RequestError, "numbers for all parameters"):
            euler.exponents(numeric=True)
        cells = euler.stress(scene="separatrix", methods=["auto", "dop853"])
        self.assertEqual([(cell.method, cell.verdict) for cell in cells], [("auto", "right"), ("dop853", "right")])
        self.assertTrue(cells)
        with self.assertRaises(casimir.UndecidedError):
            bool(euler.stress(every_scene=True, time_limit=0.05))
        with self.assertRaisesRegex(casimir.RequestError, "no method 'dop85'"):
            euler.stress(methods=["dop85"])
        with self.assertRaisesRegex(casimir.RequestError, "starts of the case file"):
            euler.with_values(initial={"M1": 1}).stress()
        program = sys.modules["casimir._program"]
        with mock.patch.object(program, "__file__", "/nowhere/casimir/_program.py"), \
                mock.patch.object(program.shutil, "which", return_value=None):
            with self.assertRaisesRegex(casimir.EnvironmentProblem, "'casimir' is not there"):
                euler.stress()

    def test_equilibria(self):
        pendulum = casimir.Case(hamiltonian="p^2/2 - cos(q)", variables=["q", "p"], canonical=True,
                                initial={"q": 1, "p": 0}, duration=1)
        for one in pendulum.equilibria():
            self.assertAlmostEqual(math.sin(one.state[0]), 0, places=9)
            self.assertEqual(one.stability,
                             "spectrally stable" if math.cos(one.state[0]) > 0 else "unstable")

    def test_dirac_bracket(self):
        pendulum = casimir.Case(
            hamiltonian="(px^2 + py^2)/2 + y", variables=["x", "y", "px", "py"], canonical=True,
            constraints=["x^2 + y^2 - 1", "x*px + y*py"], dirac=True,
            initial={"x": 0, "y": -1, "px": Fraction(1, 2), "py": 0}, duration=10)
        self.assertTrue(pendulum.verify())
        end = pendulum.integrate().y[:, -1]
        self.assertAlmostEqual(end[0] ** 2 + end[1] ** 2, 1, places=12)
        self.assertAlmostEqual(end[0] * end[2] + end[1] * end[3], 0, places=12)

    def test_generated_code(self):
        self.assertIn("namespace", casimir.load("euler").generate())
        self.assertIn("euler_rhs", casimir.load("euler").generate(language="c"))


class Studies(unittest.TestCase):
    """What measures motions: against closed forms, and against the other ways to the same numbers."""

    circle = dict(equations={"q": "w*p", "p": "-w*q"}, variables=["q", "p"], integrals={"E": "q^2 + p^2"},
                  parameters={"w": "1"}, initial={"q": 1, "p": 0}, duration=10)

    def test_digits_are_right_or_not_there(self):
        end = casimir.Case(equations={"x": "x"}, variables=["x"], initial={"x": 1}, duration=1).precise(60)
        self.assertTrue(end.success)
        exact = Decimal("2.71828182845904523536028747135266249775724709369995957496696763")
        self.assertLess(abs(end.state["x"] - exact), Decimal("1e-58"))
        with self.assertRaises(casimir.RequestError):
            casimir.load("euler").precise(16)
        pole = casimir.Case(equations={"x": "x^2"}, variables=["x"], initial={"x": 1}, duration=2).precise(30)
        self.assertFalse(pole.success)
        self.assertEqual(pole.status, "singularity")

    def test_boxes_contain_the_solution(self):
        case = casimir.Case(**self.circle)
        box = case.enclose(duration="1", sample_every="1/4")
        self.assertTrue(box)
        self.assertEqual([sample.time for sample in box.samples], [Fraction(k, 4) for k in range(5)])
        low, high = box.end["q"]
        # cos 1, from its series: the first term that is left out bounds what is left out
        cosine = sum(Fraction((-1) ** k, math.factorial(2 * k)) for k in range(20))
        self.assertLessEqual(low, cosine)
        self.assertLessEqual(cosine, high)
        self.assertLess(box.radius, 1e-13)
        self.assertNotIn({"q": Fraction(1), "p": Fraction(0)}, box.end)

    def test_boxes_over_ranges_are_for_every_value(self):
        case = casimir.Case(**self.circle)
        box = case.enclose(duration="1", ranges={"w": ("99/100", "101/100")})
        self.assertEqual(box.names, ["q", "p", "w"])
        for frequency in (0.99, 1.0, 1.01):
            low, high = box.end["q"]
            self.assertLess(low, Fraction(math.cos(frequency)))
            self.assertGreater(high, Fraction(math.cos(frequency)))
        with self.assertRaises(casimir.CaseError) as caught:
            case.enclose(ranges={"W": (0, 1)})
        self.assertIn("'w'", str(caught.exception))
        with self.assertRaises(casimir.RequestError):
            case.enclose(ranges={"w": (1, 0)})

    def test_a_sweep_refuses_what_the_command_refuses_and_warns_as_it_does(self):
        forced = casimir.Case(equations={"q": "p", "p": "-q + a*cos(t)"}, variables=["q", "p"], time="t",
                              parameters={"a": "1"}, initial={"q": 1, "p": 0}, duration=1)
        self.assertEqual(forced.sweep({"a": [1, 2]}).warnings, [])
        for do in ("exponents", "indicators"):
            with self.assertRaises(casimir.RequestError):
                forced.sweep({"a": [1, 2]}, do=do)
        with self.assertRaises(casimir.RequestError):
            casimir.load("henon-heiles").sweep({"x": [0, 0.1]}, do="section", method="dop853")
        hidden = casimir.Case(equations={"x": "a*sqrt(x)^2 - 2"}, variables=["x"], parameters={"a": "1"},
                              initial={"x": 1}, duration=2).sweep({"a": [1]})
        self.assertTrue(any("sqrt" in warning for warning in hidden.warnings), hidden.warnings)

    def test_what_has_no_end_is_not_enclosed(self):
        pole = casimir.Case(equations={"x": "x^2"}, variables=["x"], initial={"x": 1}, duration=2).enclose()
        self.assertFalse(pole.success)
        self.assertLess(pole.end.time, 1)
        with self.assertRaises(casimir.UndecidedError):
            bool(pole)

    def test_drifts_are_those_of_each_method(self):
        runs = casimir.load("kovalevskaya").conserve(methods=["taylor", "dopri5"], tolerance=1e-6, bound=1e-13)
        self.assertEqual([run.method for run in runs], ["taylor", "dopri5"])
        self.assertEqual(set(runs[0].drifts), {"H", "F1", "F2", "K"})
        self.assertEqual(runs[1].drift, max(runs[1].drifts.values()))
        self.assertFalse(runs)
        self.assertEqual(runs[1].status, "drifted")
        self.assertTrue(casimir.load("kovalevskaya").conserve(methods=["taylor"]))

    def test_frequencies_of_an_oscillator(self):
        found = casimir.Case(**{**self.circle, "duration": 2000}).with_values({"w": "sqrt(2)"}).frequencies(lines=1)
        self.assertTrue(found.quasi_periodic)
        self.assertAlmostEqual(found.base[0], math.sqrt(2), delta=1e-12)
        self.assertEqual(len(found.variables["q"]["lines"]), 1)
        with self.assertRaises(casimir.RequestError):
            casimir.Case(equations={"x": "x^2"}, variables=["x"], initial={"x": 1}, duration=2).frequencies()

    def test_a_sweep_has_an_axis_for_each_name(self):
        case = casimir.Case(**self.circle)
        grid = case.sweep({"w": [1, 2], "angle": np.linspace(0, 1, 3)}, lets={"q": "cos(angle)", "p": "-sin(angle)"},
                          duration=1, tolerance=1e-12)
        self.assertTrue(grid.success)
        self.assertEqual(list(grid.axes), ["w", "angle"])
        self.assertEqual(grid["q"].shape, (2, 3))
        for i, frequency in enumerate(grid.axes["w"]):
            np.testing.assert_allclose(grid["q"][i], np.cos(grid.axes["angle"] + frequency), atol=1e-11)
        self.assertEqual(case.sweep({"w": "1:2:5"}, duration=1)["q"].shape, (5,))
        for wrong in ({"W": [1]}, {"w": "1:2"}, {}):
            with self.assertRaises((casimir.CaseError, casimir.RequestError)):
                case.sweep(wrong)
        with self.assertRaises(casimir.RequestError) as caught:
            case.sweep({"w": [1]}, do="exponent")
        self.assertIn("exponents", str(caught.exception))

    def test_a_sweep_of_exponents_tells_chaos_from_order(self):
        swing = casimir.load("henon-heiles").with_values({"A": "1", "B": "1"})
        megno = swing.sweep({"x": [0.01, 0.02]}, do="indicators", duration=200)["megno"]
        self.assertTrue((megno < 3).all())

    def test_methods_are_compared_by_error_and_time(self):
        table = casimir.load("euler").compare(methods=["taylor", "dop853"], tolerances=[1e-6, 1e-10], budget=0.2)
        self.assertEqual({row.method for row in table if row.code == "specialised"}, {"taylor", "dop853"})
        errors, seconds = table.curve("dop853")
        self.assertEqual(len(errors), 2)
        self.assertGreater(errors[0], errors[1])
        self.assertTrue((seconds > 0).all())

    def test_progress_ends_what_it_watches(self):
        class Enough(Exception):
            pass

        def stop(share):
            raise Enough

        top = casimir.load("kovalevskaya")
        for long in (lambda: top.precise(200, duration=1000, progress=stop),
                     lambda: top.enclose(duration=10000, progress=stop),
                     lambda: top.sweep({"r": np.linspace(1, 2, 400)}, duration=1000, progress=stop)):
            with self.assertRaises(Enough):
                long()


class Process(unittest.TestCase):
    def test_control_c_ends_a_long_run(self):
        script = ("import casimir\n"
                  "top = casimir.load('kovalevskaya')\n"
                  "top.integrate(duration=1)\n"
                  "print('ready', flush=True)\n"
                  "top.integrate(duration=1e9, tolerance=1e-14)\n")
        child = subprocess.Popen([sys.executable, "-c", script], stdout=subprocess.PIPE, stderr=subprocess.PIPE)
        child.stdout.readline()
        time.sleep(0.3)
        child.send_signal(signal.SIGINT)
        _, errors = child.communicate(timeout=20)
        self.assertIn(b"KeyboardInterrupt", errors)

    def test_numpy_is_not_needed_to_prove(self):
        script = ("import sys, casimir\n"
                  "assert casimir.load('euler').verify()\n"
                  "assert 'numpy' not in sys.modules\n")
        subprocess.run([sys.executable, "-c", script], check=True)

    def test_what_answers_are_is_read_when_one_is_wanted(self):
        script = ("import sys, casimir\n"
                  "assert not {'casimir._results', 'casimir._measured', 'dataclasses'} & set(sys.modules)\n"
                  "assert isinstance(casimir.load('euler').verify(), casimir.Verification)\n"
                  "assert all(hasattr(casimir, name) for name in casimir.__all__)\n"
                  "assert not hasattr(casimir, 'Enclosures')\n")
        subprocess.run([sys.executable, "-c", script], check=True)


def load_tests(loader, tests, ignore):
    readme = Path(__file__).resolve().parents[3] / "tools" / "python" / "README.md"
    tests.addTests(doctest.DocFileSuite(str(readme), module_relative=False))
    tests.addTests(doctest.DocTestSuite(casimir))
    for name in ("_case", "_exact", "_html", "_map", "_progress"):
        tests.addTests(doctest.DocTestSuite(sys.modules[f"casimir.{name}"], optionflags=doctest.ELLIPSIS,
                                            extraglobs={"casimir": casimir}))
    with contextlib.suppress(ImportError):
        import scipy.integrate  # noqa: F401

        tests.addTests(doctest.DocTestSuite(sys.modules["casimir._system"]))
    return tests


if __name__ == "__main__":
    unittest.main()
