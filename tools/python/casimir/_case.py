"""Cases: what `casimir.load` and `casimir.Case` give."""

from __future__ import annotations

import re
from collections.abc import Callable, Iterable, Mapping, Sequence
from os import PathLike
from typing import TYPE_CHECKING, Any, Literal, Union

from . import _core
from ._errors import NoAnswer, RequestError
from ._exact import Expression, is_float, pairs_of, reals, text_of, texts_of, whole
from ._lazy import Lazy
from ._options import options_first
from ._progress import Progress, told
from ._system import System
from ._text import case_text

if TYPE_CHECKING:
    from numpy.typing import ArrayLike

    from ._map import Map
    from ._measured import (
        Comparison,
        Conservation,
        Enclosure,
        Frequencies,
        Horseshoe,
        PreciseEnd,
        Sweep,
    )
    from ._program import Report, Stress
    from ._results import (
        Conditions,
        DarbouxPolynomial,
        Degrees,
        Ensemble,
        Equilibrium,
        Exponents,
        Findings,
        Obstruction,
        Relation,
        Search,
        Section,
        Separations,
        Solution,
        SymmetricCycle,
        Verification,
    )

_results, _measured, _program = Lazy("._results"), Lazy("._measured"), Lazy("._program")

#: One expression, or several.
Expressions = Union[Expression, Iterable[Expression], None]


def _degree(degree: int) -> int:
    return whole("degree", degree, 0, 1000)


def _limits_of(degree_in: Mapping[str | tuple[str, ...], int] | None) -> list[tuple[list[str], int]]:
    """Names, alone or several, with the highest degree in them."""
    if not isinstance(degree_in, (Mapping, type(None))):
        raise TypeError(f"names with degrees are expected, {{'momenta': 4}}, and not {type(degree_in).__name__}")
    return [(texts_of(names), whole("degree_in", degree, 0, 250)) for names, degree in (degree_in or {}).items()]


#: The variables of algebras that have usual names for them.
_USUAL = {
    "so(3)": ["M1", "M2", "M3"],
    "e(3)": ["M1", "M2", "M3", "g1", "g2", "g3"],
}


def cases() -> list[str]:
    """The names of the bundled cases."""
    return _core.bundled()


def load(case: str) -> Case:
    """A bundled case by its name, or a case file by its path (with '/' or ending in '.toml').

    >>> load("kovalevskaya").variables
    ['M1', 'M2', 'M3', 'g1', 'g2', 'g3']
    """
    return Case._of(_core.Case.load(str(case)))


class Case:
    """A system with its claims and scenes. Cases do not change: methods that change one return another.

    :param text: a case file; or, instead of it, what follows.
    :param hamiltonian: text, or a SymPy expression over symbols with the names of the variables.
    :param equations: the rate of each variable, for a system without a Hamiltonian.
    :param variables: their names; those of so(3) and e(3) need not be said.
    :param algebra: the name of a Lie algebra, as 'e(3)'.
    :param brackets: the nonzero brackets, as {'M1,M2': '-M3'}.
    :param canonical: whether the variables are q1 .. qn, p1 .. pn.
    :param constraints: expressions that vanish on the phase space.
    :param dirac: whether the bracket is the Dirac bracket of the constraints.
    :param parameters: names, or names with values for the scene; None leaves a value open.
    :param assume: what is assumed of a parameter, as {'a': 'a > 0'}.
    :param integrals, casimirs, definitions: expressions by name.
    :param initial: a start, for numbers: one scene called 'default'.
    :param duration: of that scene.

    >>> top = Case(hamiltonian="(M1^2 + M2^2 + 2*M3^2)/2 - r*g1", algebra="e(3)", parameters=["r"])
    >>> bool(top.verify(integral="(M1^2 - M2^2 + 2*r*g1)^2 + (2*M1*M2 + 2*r*g2)^2"))
    True
    """

    def __init__(
        self,
        text: str | None = None,
        *,
        name: str = "case",
        title: str | None = None,
        hamiltonian: Expression | None = None,
        equations: Mapping[str, Expression] | None = None,
        variables: Sequence[str] | None = None,
        algebra: str | None = None,
        brackets: Mapping[str, Expression] | None = None,
        canonical: bool = False,
        time: str | None = None,
        domain: Iterable[str] = (),
        constraints: Iterable[Expression] = (),
        dirac: bool = False,
        parameters: Iterable[str] | Mapping[str, Expression | None] = (),
        assume: Mapping[str, str] | None = None,
        definitions: Mapping[str, Expression] | None = None,
        casimirs: Mapping[str, Expression] | None = None,
        integrals: Mapping[str, Expression] | None = None,
        integrable: bool = False,
        initial: Mapping[str, Expression] | None = None,
        duration: Expression | None = None,
    ):
        if text is None:
            space = {
                "variables": [str(one) for one in variables or _USUAL.get(algebra or "", [])],
                "algebra": algebra,
                "canonical": canonical or None,
                "time": time,
                "domain": list(domain) or None,
                "constraints": [text_of(one) for one in constraints] or None,
                "dirac": dirac or None,
                "brackets": brackets,
            }
            values = parameters if isinstance(parameters, Mapping) else {str(one): None for one in parameters}
            text = case_text(
                title or name, hamiltonian, equations, space, values, assume or {},
                {"definitions": definitions, "casimirs": casimirs, "integrals": integrals},
                integrable, initial, duration,
            )
        self._core = _core.Case.from_text(text, f"{name}.toml")

    @classmethod
    def _of(cls, core: _core.Case) -> Case:
        self = cls.__new__(cls)
        self._core = core
        return self

    def __reduce__(self):
        core = self._core
        return _restored, (core.text, core.file, core.changed_parameters, core.changed_initial, core.rounded, core.set)

    def __repr__(self) -> str:
        return f"<casimir.Case {self.name}: {self.title}>"

    @property
    def name(self) -> str:
        """The name of the file, without its ending."""
        return self._core.name

    @property
    def title(self) -> str:
        """As the case has it."""
        return self._core.title

    @property
    def text(self) -> str:
        """The case file, without what `with_values` changed."""
        return self._core.text

    @property
    def variables(self) -> list[str]:
        """The names of the entries of a state, in order."""
        return self._core.variables

    @property
    def parameters(self) -> list[str]:
        """The parameters that are symbols."""
        return self._core.parameters

    @property
    def scenes(self) -> list[str]:
        """The names of the scenes, for `scene=..`."""
        return self._core.scenes

    @property
    def casimirs(self) -> dict[str, str]:
        """The Casimir functions that the case claims."""
        return dict(self._core.casimirs)

    @property
    def integrals(self) -> dict[str, str]:
        """The integrals that the case claims."""
        return dict(self._core.integrals)

    def with_values(self, parameters: Mapping[str, Expression] | None = None,
                    initial: Mapping[str, Expression] | None = None) -> Case:
        """The case with numbers in the place of parameters, and other starts in its scenes.

        A start of floats may be off the levels of the case by their rounding; exact numbers may not.
        """
        starts = pairs_of(initial)
        rounded = any(is_float(value) for value in (initial or {}).values())
        return Case._of(self._core.with_values(pairs_of(parameters), starts, rounded))

    def in_variables(self, variables: str) -> Case:
        """The case in other variables: equations, integrals and scenes, carried along the maps of the bundled cases.

        Starts that are changed afterwards stay those of the case's own variables.

        :param variables: the name of a set, as 'euler-angles', 'andoyer' or 'quaternions'.
        :raises ModelError: for an unknown set, or one that no maps lead to.
        :raises SingularPoint: where a scene begins at a point that these variables cannot describe.

        >>> load("kovalevskaya").in_variables("euler-angles").variables[:3]
        ['theta', 'phi', 'psi']
        """
        return Case._of(self._core.in_variables(variables))

    def show(self, format: str = "text") -> dict[str, Any]:
        """The system as formulas: 'text' in the notation of case files, or 'latex'."""
        return self._core.show(format)

    def sympy(self, expression: Expression):
        """An expression over the names of the case as one of SymPy, exactly."""
        import sympy

        text = self._core.expression(text_of(expression))[0]
        # Letters of its own for each name: SymPy reads some as constants or as words of Python.
        names = self.variables + self.parameters
        own = {name: f"name{k}_" for k, name in enumerate(names)}
        words = {"Pi": "pi", "^": "**"}
        text = re.sub(r"[A-Za-z_][A-Za-z_0-9]*|\^", lambda m: own.get(m[0]) or words.get(m[0], m[0]), text)
        symbols = {own[name]: sympy.Symbol(name) for name in names}
        return sympy.sympify(text, locals=symbols, rational=True)

    def _repr_latex_(self) -> str:
        shown = self.show("latex")
        lines = [rf"H &= {shown['hamiltonian']}"] if shown["hamiltonian"] else []
        lines += [rf"{left} &= {right}" for left, right in shown["equations"]]
        return "$$\\begin{aligned}" + r"\\ ".join(lines) + "\\end{aligned}$$"

    # Proofs and searches.

    def verify(self, integral: Expressions = None, *, casimir: Expressions = None,
               invariant_relation: Expressions = None, identity: Expressions = None, on: Expressions = None,
               certificate: str | PathLike[str] | None = None, time_limit: float = 0) -> Verification:
        """Proves or refutes every claim of the case, or these candidates instead.

        :param integral, casimir, invariant_relation, identity: an expression, or a list of them.
        :param on: functions whose common zero level a candidate is restricted to.
        :param certificate: a file NAME.v that the proof assistant Coq checks by itself; none is written where not
            everything is proved. Its `left_out` says which claims have no theorem there.
        :param time_limit: in seconds; what is not reached by then is undecided.

        >>> load("kovalevskaya").verify().verdict
        'proved'
        >>> load("euler").verify(integral="M1").witness.value
        Fraction(...)
        """
        _check_name_for_coq(certificate)
        answer = self._core.verify(texts_of(integral), texts_of(casimir), texts_of(invariant_relation),
                                   texts_of(identity), texts_of(on), certificate is not None, time_limit)
        if "certificate" in answer:
            _write_certificate(certificate, answer)
        return _results.verification_of(answer)

    def search(self, degree: int | None = None, *, casimirs: bool = False, on: Expressions = None,
               functions: Expressions = None, weights: Mapping[str, Expression] | Literal["auto"] | None = None,
               degree_in: Mapping[str | tuple[str, ...], int] | None = None,
               free: Expressions = None, time_limit: float = 0, memory: float = 0) -> Search | Conditions:
        """All polynomial integrals up to a degree, less those that follow from the known ones.

        :param degree: highest, weighted; without it those in ``degree_in`` have to bound all of the ansatz.
        :param casimirs: Casimir functions instead.
        :param functions: that the integrals may be polynomials in besides the variables and the functions of
            the equations.
        :param weights: whole numbers; ``"auto"``: those by which the equations are quasi-homogeneous.
        :param degree_in: highest degrees in some variables, as ``{"momenta": 4, "rest": 6}`` or
            ``{("M1", "M2"): 2}``.
        :param free: parameters: their values at which there are further integrals.
        :param memory: bytes that may be used.
        :raises NoAnswer: where the time or the memory does not suffice.

        >>> [str(one) for one in load("euler").search(2)]
        []
        """
        highest = -1 if degree is None and degree_in else _degree(degree)
        limits = _limits_of(degree_in)
        if free is not None:
            if casimirs or on is not None:
                raise RequestError("free parameters go with neither casimirs nor a level")
            if weights == "auto":
                raise RequestError("free parameters go with weights that are numbers")
            facts = self._core.conditions(highest, texts_of(free), texts_of(functions), pairs_of(weights), limits,
                                          time_limit, memory)
            return _results.Conditions(
                _results.search_of(facts["generic"]),
                [_results.Condition(**{**one, "found": [_results.Found(**f) for f in one["found"]]})
                 for one in facts["conditions"]],
                facts["complete"],
                facts["reason"],
            )
        own = weights == "auto"
        facts = self._core.search(highest, casimirs, texts_of(on), texts_of(functions),
                                  pairs_of(None if own else weights), own, limits, time_limit, memory)
        return _results.search_of({**facts, "not_on": self._core.constraints_left_out(texts_of(on))})

    def _findings(self, facts: dict[str, Any], what: str) -> Findings:
        """With the constraints of the case, which a search for structure is not about."""
        return _results.Findings({**facts, "not_on": self._core.constraints_left_out([])}, what)

    def darboux(self, degree: int, *, free: Expressions = None, time_limit: float = 0,
                memory: float = 0) -> list[DarbouxPolynomial] | Findings:
        """Irreducible polynomials whose zero level is invariant, up to a degree.

        :param free: parameters: their values at which there are further ones, as dictionaries.

        >>> decay = Case(equations={"x": "x*(1 + a*y)", "y": "1 + x"}, variables=["x", "y"], parameters=["a"])
        >>> [str(one.text) for one in decay.darboux(1)]
        ['x']
        """
        if free is not None:
            return self._findings(
                _core.darboux_conditions(self._core, _degree(degree), texts_of(free), time_limit, memory),
                "values of parameters")
        found = self._core.darboux(_degree(degree), time_limit, memory)["found"]
        return [_results.DarbouxPolynomial(**one) for one in found]

    def rational(self, degree: int, *, time_limit: float = 0, memory: float = 0) -> Findings:
        """Integrals that are quotients of polynomials, with factors up to a degree.

        >>> Case(equations={"x": "2*x", "y": "3*y"}, variables=["x", "y"]).rational(1).found
        ['x^3/y^2']
        """
        return self._findings(_core.rational(self._core, _degree(degree), time_limit, memory), "rational integrals")

    def tensors(self, rank: int, degree: int, *, forms: bool = False, conformal: bool = False,
                time_limit: float = 0, memory: float = 0) -> Findings:
        """Skew tensors with polynomial components that the motion keeps: rank 1 are fields, 2 bivectors.

        :param forms: differential forms instead.
        :param conformal: those that it multiplies by a polynomial that is not 0, their `factor`.
        :returns: dictionaries with `components` by the names of the variables; `dimensions` of the space.

        >>> load("euler").tensors(2, 1).verdict
        'proved'
        >>> damped = Case(equations={"q": "p", "p": "-q - q^3 - p"}, variables=["q", "p"])
        >>> damped.tensors(2, 0, forms=True, conformal=True)[0]["factor"]
        '-1'
        """
        if conformal:
            return self._findings(
                _core.conformal_tensors(self._core, rank, forms, _degree(degree), time_limit, memory),
                "conformal forms" if forms else "conformal tensors")
        return self._findings(_core.tensors(self._core, rank, forms, _degree(degree), time_limit, memory),
                                 "forms" if forms else "tensors")

    def orbital_symmetries(self, degree: int, *, time_limit: float = 0, memory: float = 0) -> Findings:
        """Polynomial fields that take orbits to orbits: their bracket with the motion X is `factor` times X.

        :returns: dictionaries with `components` by the names of the variables; products of X are left out.

        >>> load("euler").orbital_symmetries(1).verdict
        'proved'
        """
        return self._findings(_core.orbital_symmetries(self._core, _degree(degree), time_limit, memory),
                              "orbital symmetries")

    def hamiltonian(self, degree: int, *, time_limit: float = 0, memory: float = 0) -> Findings:
        """Poisson brackets of the equations of motion alone, up to a degree, with their Hamiltonians.

        >>> Case(equations={"q": "p", "p": "-q"}, variables=["q", "p"]).hamiltonian(0)[0]["hamiltonian"]
        '(q^2 + p^2)/2'
        """
        return self._findings(_core.brackets(self._core, _degree(degree), False, time_limit, memory), "brackets")

    def bihamiltonian(self, degree: int, *, time_limit: float = 0, memory: float = 0) -> Findings:
        """Second brackets, compatible with that of the case, with their Lenard chains."""
        return self._findings(_core.brackets(self._core, _degree(degree), True, time_limit, memory), "second brackets")

    def separation(self, degree: int = 2, *, on: Expressions = None, roots: Expression | None = None,
                   time_limit: float = 0, memory: float = 0) -> Separations:
        """Variables in which the integrals separate: the roots of a polynomial, by a second bivector.

        :param degree: of the components of that bivector.
        :param on: Casimir functions, on whose common zero level the integrals commute.
        :param roots: a polynomial in u whose roots are examined instead.
        :returns: dictionaries with the `polynomial`, what is proved of it, and Staeckel's `relations`.

        >>> load("henon-heiles").separation(1)[0]["separated"]
        'proved'
        """
        found = _core.separation(self._core, _degree(degree), texts_of(on), texts_of(roots), time_limit, memory)
        return _results.Separations(found, "systems of variables that separate")

    def symmetries(self, *, time_limit: float = 0, memory: float = 0) -> Findings:
        """Linear symmetries of bracket and Hamiltonian, with their integrals by Noether's theorem."""
        return self._findings(_core.symmetries(self._core, time_limit, memory), "linear symmetries")

    def relate(self, other: Case, *, bracket_only: bool = False, time_limit: float = 0,
               memory: float = 0) -> Relation:
        """Whether the other case is this one in linear coordinates; parameters need numbers.

        >>> top = load("euler").with_values({"a1": 1, "a2": 2, "a3": 3})
        >>> top.relate(load("euler").with_values({"a1": 3, "a2": 1, "a3": 2})).verdict
        'proved'
        """
        return _results.Relation(**_core.relate(self._core, other._core, not bracket_only, time_limit, memory))

    def exponents(self, weights: Mapping[str, Expression] | None = None, *, numeric: bool = False,
                  time_limit: float = 0, memory: float = 0) -> Exponents:
        """Balances and Kovalevskaya exponents.

        :param numeric: by Newton's iteration from random starts in place of the exact analysis: no proof, and others are
            not excluded. All parameters have to be numbers.
        """
        return _results.exponents_of(self._core.exponents(pairs_of(weights), numeric, time_limit, memory))

    def obstruct(self, *, along: Expressions = None, free: str = "", scene: str = "default",
                 certificate: str | PathLike[str] | None = None, time_limit: float = 0,
                 memory: float = 0) -> Obstruction:
        """Whether the variational equations along a particular solution exclude a further integral;
        with a free parameter, for which of its real values they do not.

        :param certificate: a file NAME.v with the linear algebra of the proof, which Coq checks; none is written where
            nothing is proved.
        :raises NoAnswer: where the proof has no linear algebra; nothing is written then.
        """
        _check_name_for_coq(certificate)
        facts = self._core.obstruct(scene, texts_of(along), free, certificate is not None, time_limit, memory)
        if "certificate" in facts:
            _write_certificate(certificate, facts)
        verdict = "proved" if facts.pop("proved") else "undecided"
        return _results.Obstruction(verdict=verdict, **{**facts, "parameters": dict(facts["parameters"])})

    # Maps.

    def discretise(self, method: str = "kahan", step: Expression | None = None) -> Map:
        """Kahan's map of quadratic equations, the implicit midpoint rule ('midpoint') of linear ones, or Moser's and
        Veselov's map ('moser-veselov') of a free rigid body.

        :param step: without it the step is a parameter.

        >>> load("euler").discretise().parameters[-1]
        'eps'
        """
        if method not in ("kahan", "midpoint", "moser-veselov"):
            raise RequestError(f"{method!r} makes no map: 'kahan', 'midpoint' and 'moser-veselov' do")
        from ._map import Map

        text = _core.discretised(self._core, method, None if step is None else text_of(step))
        return Map(text, name=f"{self.name}-{method}")

    def kahan_degrees(self, iterates: int = 0, *, time_limit: float = 0, memory: float = 0) -> Degrees:
        """The degrees of the iterates of Kahan's map. What they suggest is evidence and no proof.

        >>> load("euler").kahan_degrees(8).growth
        'polynomial'
        """
        iterates = whole("iterates", iterates, 0, 1000)
        return _results.Degrees(**_core.kahan_degrees(self._core, iterates, time_limit, memory))

    # Numbers.

    def generate(self, *, scene: str = "default", keep: Iterable[str] = (),
                 observe: Iterable[str] | None = None, jacobian: bool = True,
                 variational: bool = False, taylor: bool = False, language: str = "c++",
                 name: str | None = None) -> str:
        """The equations of a scene as a header in C++20 or C99 that needs nothing else.

        :param keep: parameters that stay arguments.
        :param observe: states that are wanted; what they do not need is left out.
        :param language: 'c++' or 'c'.
        """
        if language not in ("c++", "c"):
            raise RequestError(f"{language!r} is no language of headers: 'c++' and 'c' are")
        return self._core.generate(scene, list(keep), None if observe is None else list(observe), jacobian,
                                   variational, taylor, language, name)

    @options_first
    def integrate(self, t_eval: ArrayLike | None = None, *, initial: Mapping[str, Expression] | None = None,
                  duration: float | None = None, scene: str = "default", method: str = "auto",
                  tolerance: float | None = None, rtol: float | None = None, atol: float | None = None,
                  step: float | None = None, max_steps: int = 0,
                  observe: Sequence[str] | None = None, project: bool = False, time_limit: float = 0,
                  progress: Progress = None, **parameters: Expression) -> Solution:
        """Integrates a scene from time 0.

        :param t_eval: times of the states wanted, shape (m,); without it those of the steps.
        :param initial: other starts than those of the scene, by name.
        :param duration: without it the last of `t_eval`, or that of the scene; negative: backwards.
        :param method: 'auto', or one of `casimir.methods()`.
        :param tolerance: sets `rtol` and `atol`.
        :param step: of all steps, instead of an error that is kept.
        :param max_steps: after which it ends, and is no success. 0: no limit.
        :param project: onto every invariant that is proved.
        :param time_limit: in seconds; what was reached by then is returned, and is no success. 0: none.
        :param progress: told the share that is done: a function of it, or a bar of tqdm. `auto` may
            begin anew. What it raises ends the run.
        :param parameters: other values than those of the scene, as r=2.
        :returns: t (m,), y (n, m), sol, success, .., drift, trust, warnings.

        >>> motion = load("kovalevskaya").integrate([0, 1, 2], r=1)
        >>> motion.y.shape, motion.success
        ((6, 3), True)
        """
        import numpy

        case = self if parameters is None and initial is None else self.with_values(parameters, initial)
        times = None if t_eval is None else numpy.atleast_1d(reals(t_eval))
        if times is not None and (times.ndim != 1 or times.size == 0 or not numpy.isfinite(times).all()):
            raise RequestError("t_eval is a list of times")
        if times is not None and duration is None:
            duration = float(times[numpy.abs(times).argmax()])
        if times is not None and (times * numpy.sign(duration) > abs(duration)).any():
            raise RequestError(f"t_eval goes to {times[numpy.abs(times).argmax()]:g}, beyond the duration {duration:g}")
        if max_steps < 0:
            raise RequestError("max_steps is not negative; 0 is no limit")
        if step is not None and not step > 0:
            raise RequestError(f"step is {step}, and has to be positive")
        if observe is not None and len(observe) == 0:
            raise RequestError("observe names no state: leave it out for all of them")
        motion = _core.integrate(case._core, scene, method, duration, tolerance, rtol, atol, step, max_steps, observe,
                                 project, time_limit, told(progress))
        return _results.solution_of(motion, times)

    def ensemble(self, initial: ArrayLike, *, variables: Sequence[str] | None = None,
                 parameters: Mapping[str, Any] | None = None,
                 duration: float | None = None, scene: str = "default", method: str = "taylor",
                 tolerance: float | None = None, rtol: float | None = None, atol: float | None = None,
                 jobs: int = 0, time_limit: float = 0, progress: Progress = None) -> Ensemble:
        """Integrates many initial states at once, several in the lanes of a register, on all cores.

        :param initial: array (members, n), with a column for each variable.
        :param variables: the names of the columns, where these are only some of the variables.
        :param parameters: arrays (members,) by name.
        :param jobs: threads; 0: one for each processor.
        :param progress: told the share of the members that are done: a function of it, or a bar of tqdm.
        :returns: y (members, n), t (members,), drift (members,) for each invariant, status, steps.

        >>> top = load("kovalevskaya")
        >>> many = top.system().initial + [[0], [0], [0]]
        >>> top.ensemble(many, parameters={"r": [1, 2, 3]}, duration=1).y.shape
        (3, 6)
        """
        import numpy

        initial = reals(initial)
        names = list(parameters or {})
        values = numpy.empty((len(initial), len(names)))
        for column, name in enumerate(names):
            values[:, column] = parameters[name]
        answer = _core.ensemble(self._core, scene, method, initial, list(variables or self.variables), values,
                                names, duration, tolerance, rtol, atol, jobs, time_limit, told(progress))
        drift = answer["drift"]
        return _results.Ensemble(
            y=answer["states"], t=answer["t"], status=answer["status"],
            drift={name: drift[:, k] for k, name in enumerate(answer["invariant_names"])},
            steps=answer["steps"], names=answer["names"], seconds=answer["seconds"], jobs=answer["jobs"],
            warnings=answer["warnings"],
        )

    def system(self, *, scene: str = "default", method: str = "dop853", keep: Sequence[str] = ()) -> System:
        """A scene compiled for repeated use: its right-hand side and its flow as functions of arrays.

        :param method: of the flow; 'radau5' has a Jacobian too.
        :param keep: parameters that stay arguments.
        """
        return System(_core.System(self._core, scene, method, list(keep)))

    @property
    def rhs(self) -> Callable[..., Any]:
        """The right-hand side of the scene 'default' as a function f(t, y), for SciPy's solvers."""
        return self.system().rhs

    @options_first
    def precise(self, digits: int, *, duration: Expression | None = None, scene: str = "default",
                initial: Mapping[str, Expression] | None = None, time_limit: float = 0,
                progress: Progress = None, **parameters: Expression) -> PreciseEnd:
        """The state at the end with any number of digits, each of them checked by a second run.

        :param digits: 17 to 5000.
        :param duration: exactly; without it that of the scene.

        >>> end = Case(equations={"x": "x"}, variables=["x"], initial={"x": 1}, duration=1).precise(40)
        >>> end.state["x"]
        Decimal('2.718281828459045235360287471352662497757')
        """
        case = self if parameters is None and initial is None else self.with_values(parameters, initial)
        return _measured.precise_of(
            _core.precise(case._core, scene, digits, None if duration is None else text_of(duration), time_limit,
                          told(progress)))

    @options_first
    def enclose(self, *, duration: Expression | None = None, initial_radius: Expression = 0,
                ranges: Mapping[str, tuple[Expression, Expression]] | None = None, digits: int = 0,
                sample_every: Expression | None = None, certificate: str | PathLike[str] | None = None,
                scene: str = "default", initial: Mapping[str, Expression] | None = None, time_limit: float = 0,
                progress: Progress = None, **parameters: Expression) -> Enclosure:
        """Boxes that provably contain the solutions of a scene.

        :param initial_radius: by how much each initial value may be off, on both sides.
        :param ranges: parameters that may have any value of an interval, by name.
        :param digits: of the arithmetic; 0: double precision.
        :param sample_every: time between boxes on the way.
        :param certificate: a file for every step, which `casimir.check` verifies in other arithmetic. None is written of
            a run that ends before its time.
        :raises NoAnswer: where a certificate was asked for and does not pass that; nothing is written then.

        >>> box = load("kovalevskaya").enclose(duration=1)
        >>> box.success, box.radius < 1e-10
        (True, True)
        """
        case = self if parameters is None and initial is None else self.with_values(parameters, initial)
        if digits:
            whole("digits", digits, 17, 5000)
        intervals = [(str(name), (text_of(low), text_of(high))) for name, (low, high) in (ranges or {}).items()]
        facts = _core.enclosed(case._core, scene, None if duration is None else text_of(duration),
                               text_of(initial_radius), intervals, digits,
                               None if sample_every is None else text_of(sample_every), certificate is not None,
                               time_limit, told(progress))
        _write_certificate(certificate, facts)
        return _measured.enclosure_of(facts)

    def conserve(self, *, methods: Sequence[str] = (), bound: float = 1e-9, duration: float | None = None,
                 tolerance: float | None = None, scene: str = "default", time_limit: float = 0,
                 progress: Progress = None) -> Conservation:
        """The drift of every invariant along the scene by each method. True where none is beyond the bound.

        >>> bool(load("euler").conserve(methods=["taylor"]))
        True
        """
        runs = _core.conserved(self._core, scene, list(methods), bound, duration, tolerance, time_limit, told(progress))
        return _measured.Conservation([_measured.Run(**one) for one in runs])

    def frequencies(self, *, lines: int = 5, method: str = "auto", duration: float | None = None,
                    tolerance: float | None = None, scene: str = "default", time_limit: float = 0,
                    progress: Progress = None) -> Frequencies:
        """The strongest lines in the spectrum of each variable, and a base of their frequencies.

        :param lines: of each variable.

        >>> swing = Case(equations={"q": "p", "p": "-q"}, variables=["q", "p"], initial={"q": 1, "p": 0})
        >>> [round(one, 9) for one in swing.frequencies(duration=1000).base]
        [1.0]
        """
        lines = whole("lines", lines, 1, 40)
        return _measured.Frequencies(**_core.frequencies(self._core, scene, method, lines, duration, tolerance,
                                                         time_limit, told(progress)))

    def compare(self, *, methods: Sequence[str] = (), tolerances: Sequence[float] = (1e-3, 1e-6, 1e-9, 1e-12),
                budget: float = 8, quick: bool = False, duration: float | None = None, scene: str = "default",
                time_limit: float = 0, progress: Progress = None) -> Comparison:
        """Error against run time of methods, ours and those of other libraries, in interleaved rounds.

        :param methods: without them all that suit the case.
        :param budget: seconds for all rounds; `quick` leaves out what takes longer to compile than to run.
        """
        facts = _core.compared(self._core, scene, list(methods), list(tolerances), budget, quick, duration,
                               time_limit, told(progress))
        return _measured.Comparison(**{**facts, "rows": [_measured.Run(**one) for one in facts["rows"]]})

    def sweep(self, over: Mapping[str, Any], *, do: str = "integrate", lets: Mapping[str, Expression] | None = None,
              method: str = "auto", duration: float | None = None, tolerance: float | None = None, orbits: int = 16,
              points: int = 200, scene: str = "default", jobs: int = 0, time_limit: float = 0,
              progress: Progress = None) -> Sweep:
        """The same study at every point of a grid.

        :param over: arrays of values by name, of parameters, variables or names that `lets` use; or '0:1:11'.
        :param do: 'integrate', 'section', 'exponents', 'indicators' or 'rotation'.
        :param lets: initial values and parameters as expressions over the names of the grid.
        :returns: arrays with an axis for each name, by column.

        >>> grid = load("kovalevskaya").sweep({"r": [1, 2, 3]}, duration=1)
        >>> grid["M1"].shape, grid.success
        ((3,), True)
        """
        axes = [f"{name}={values if isinstance(values, str) else _listed_values(values)}"
                for name, values in over.items()]
        facts = _core.sweep(self._core, scene, do, method, axes,
                            [f"{name}={text_of(value)}" for name, value in (lets or {}).items()],
                            duration, tolerance, orbits, points, jobs, time_limit, told(progress))
        return _measured.Sweep(axes=dict(facts["axes"]), columns=facts["columns"], status=facts["status"],
                               principal=facts["principal"], warnings=facts["warnings"])

    def section(self, *, plane: Expression | None = None, direction: str | None = None,
                plot: Sequence[Expression] = (), energy: float | None = None,
                casimirs: Mapping[str, float] | None = None, orbits: int = 40, points: int = 500,
                seeds: ArrayLike | None = None, cycles: int = 0, proved: bool = False, rotation: bool = False,
                certificate: str | PathLike[str] | None = None, tolerance: float = 1e-14, scene: str = "default", jobs: int = 0,
                progress: Progress = None) -> Section:
        """A Poincare section on one level of energy and Casimir functions.

        :param plane: a function that vanishes there; without it that of the case.
        :param direction: 'up' or 'down'.
        :param plot: two functions of the state.
        :param energy, casimirs: the level; without them that of the scene.
        :param orbits, points: how many, and the crossings of each.
        :param seeds: array (orbits, n) of states on the level that orbits begin at, instead of a spread of them.
        :param cycles: the most crossings of periodic orbits that are looked for; there may be others.
        :param proved: whether each of these is enclosed by a box that provably has exactly one.
        :param rotation: whether the rotation numbers of the orbits are wanted.
        :param certificate: a file of those cycles that are proved, which `casimir.check` verifies in other arithmetic;
            none is written where none is.
        :param progress: told the share of the crossings that are there: a function of it, or a bar of tqdm.
        :returns: orbits with points (count, 2), times (count,) and states (count, n).

        >>> cut = load("kovalevskaya").section(orbits=3, points=5)
        >>> cut[0].points.shape
        (5, 2)
        >>> cut = load("henon-heiles").section(orbits=4, points=50, cycles=1, proved=True)
        >>> sum(cycle.proof.verdict == "proved" for cycle in cut.cycles) > 0
        True
        """
        if proved and cycles == 0:
            raise RequestError("proved=True is for cycles: say how long they may be, as cycles=2")
        if certificate is not None and not proved:
            raise RequestError("a certificate is of cycles that are proved: say proved=True")
        facts = _core.section(self._core, scene, None if plane is None else text_of(plane),
                              _upwards(direction), [text_of(one) for one in plot],
                              energy, list((casimirs or {}).items()), orbits, _rows(seeds), points, cycles, proved,
                              certificate is not None, rotation, tolerance, jobs, told(progress))
        if certificate is not None:
            _write_certificate(certificate, facts)
        return _results.section_of(facts)

    @options_first
    def symmetric_cycle(self, symmetry: Mapping[str, Expression], *, period: float | None = None,
                        keep_period: bool = False, tolerance: float = 1e-14, scene: str = "default",
                        initial: Mapping[str, Expression] | None = None, time_limit: float = 0,
                        **parameters: Expression) -> SymmetricCycle:
        """A periodic orbit with x(t + T/n) = S x(t), as a choreography, by Newton's method from the start of the scene.

        :param symmetry: S: the images of variables, as {'q1': 'q3'}; the others stay.
        :param period: a guess of T; without it the duration of the scene.
        :param keep_period: whether T is exactly that.
        :raises NoAnswer: where none was found.

        >>> swing = Case(equations={"q": "p", "p": "-q - q^3"}, variables=["q", "p"], initial={"q": 1, "p": 0},
        ...              duration=5)
        >>> cycle = swing.symmetric_cycle({"q": "-q", "p": "-p"})
        >>> cycle.order, cycle.closure < 1e-12
        (2, True)
        """
        case = self if parameters is None and initial is None else self.with_values(parameters, initial)
        facts = _core.symmetric_cycle(case._core, scene, pairs_of(symmetry), period, keep_period, tolerance, time_limit)
        found, reason = facts.pop("found"), facts.pop("reason")
        if not found:
            raise NoAnswer(f"no cycle was found: {reason}")
        return _results.SymmetricCycle(**facts)

    def horseshoe(self, *, plane: Expression | None = None, direction: str | None = None,
                  energy: float | None = None, casimirs: Mapping[str, float] | None = None, longest: int = 0,
                  certificate: str | PathLike[str] | None = None, scene: str = "default", time_limit: float = 120,
                  progress: Progress = None) -> Horseshoe:
        """A proof that returns to a plane are chaotic on one level, and that there is no further analytic integral.

        :param plane, direction, energy, casimirs: as of `section`.
        :param longest: the length of the cycles that h-sets are put around; 0: up to 2.
        :param certificate: a file that `casimir.check` verifies in other arithmetic; none is written where nothing
            is proved.
        :param time_limit: seconds; where nothing is found in that time nothing is said.
        :raises NoAnswer: where a certificate was asked for and does not pass that; nothing is written then.

        >>> chaos = load("euler-poisson").horseshoe(scene="chaotic")  # doctest: +SKIP
        >>> chaos.verdict, chaos.entropy > 0.2  # doctest: +SKIP
        ('proved', True)
        """
        if longest < 0:
            raise RequestError("longest is not negative; 0 is the usual length")
        facts = _core.horseshoe(self._core, scene, None if plane is None else text_of(plane), _upwards(direction),
                                energy, list((casimirs or {}).items()), longest, certificate is not None, time_limit,
                                told(progress))
        _write_certificate(certificate, facts)
        return _measured.horseshoe_of(facts)

    def report(self, file: str | PathLike[str], *, budget: float | None = None, scene: str | None = None,
               time_limit: float = 0) -> Report:
        """Writes one page about the case: equations, proofs, code, motion, drift, section, error against run time.

        The page needs nothing but itself and integrates in a browser. The program `casimir` makes it.

        :param file: its name, which ends in '.html'.
        :param budget: seconds of measuring error against run time; 0 leaves that out.

        >>> import tempfile
        >>> page = load("euler-jacobi").report(tempfile.mktemp(suffix=".html"), budget=0)
        >>> page.verdict
        'proved'
        """
        return _program.report(self, file, budget, scene, time_limit)

    def stress(self, *, methods: Sequence[str] = (), tolerance: float | None = None, scene: str | None = None,
               every_scene: bool = False, cell_limit: float = 5, time_limit: float = 0) -> Stress:
        """Extreme scenes by every method, each answer judged against a reference state.

        The program `casimir` runs them, each in a process of its own.

        :param methods: without them 'auto', all of casimir's own and the multistep methods of SUNDIALS.
        :param every_scene: scenes that are not extreme too.
        :param cell_limit: seconds for one run.

        >>> cells = load("euler").stress(scene="separatrix", methods=["auto", "dop853"])
        >>> [cell.verdict for cell in cells], bool(cells)
        (['right', 'right'], True)
        """
        return _program.stress(self, methods, tolerance, scene, every_scene, cell_limit, time_limit)

    def equilibria(self, scene: str = "default", *, proved: bool = False) -> list[Equilibrium]:
        """Equilibria and relative equilibria on the level of a scene. There may be others.

        :param proved: whether each is enclosed by a box that provably has exactly one, and its stability decided.

        >>> [rest.proof.verdict for rest in load("henon-heiles").equilibria(proved=True)][:1]
        ['proved']
        """
        return [_results.equilibrium_of(one) for one in _core.equilibria(self._core, scene, proved)["equilibria"]]


def _rows(states: ArrayLike | None) -> list[list[float]]:
    import numpy

    if states is None:
        return []
    rows = numpy.atleast_2d(reals(states))
    if rows.ndim != 2 or rows.size == 0:
        raise RequestError("seeds are an array with a row for each orbit")
    return rows.tolist()


def _upwards(direction: str | None) -> bool | None:
    if direction not in (None, "up", "down"):
        raise RequestError(f"{direction!r} is no direction: 'up' and 'down' are")
    return None if direction is None else direction == "up"


def _check_name_for_coq(file: str | PathLike[str] | None) -> None:
    from pathlib import Path

    if file is None:
        return
    stem = Path(file).stem
    if Path(file).suffix != ".v" or not (stem.isascii() and stem.isidentifier() and stem[0] != "_"):
        raise RequestError(f"{str(file)!r}: the name of a certificate is a letter, then letters, digits and '_', and "
                           "ends in .v")


def _write_certificate(file: str | PathLike[str] | None, facts: dict[str, Any]) -> None:
    """Takes the text of a certificate out of the facts, and writes it where a file was asked for."""
    text, reason = facts.pop("certificate"), facts.pop("uncertified", "")
    if reason:
        raise NoAnswer(f"no certificate was written: {reason}")
    if file is not None and text:
        _measured.write_text(file, text)


def _listed_values(values: Any) -> str:
    import numpy

    return ",".join(repr(float(value)) for value in numpy.asarray(values, dtype=float).ravel())


def _restored(text: str, file: str, parameters, initial, rounded: bool, variables: str = "") -> Case:
    core = _core.Case.from_text(text, file)
    if parameters or initial:
        core = core.with_values(parameters, initial, rounded)
    return Case._of(core.in_variables(variables) if variables else core)
