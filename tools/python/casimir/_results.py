"""What the commands answer."""

from __future__ import annotations

import html
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, field
from fractions import Fraction
from typing import Any, overload

from ._errors import UndecidedError
from ._exact import number_of
from ._html import table


def _truth(verdict: str, what: str) -> bool:
    if verdict == "undecided":
        raise UndecidedError(f"{what} is undecided, which is neither true nor false: ask for .verdict")
    return verdict == "proved"


def _listed(values: dict[str, Any]) -> str:
    return ", ".join(f"{name} = {value}" for name, value in values.items())


@dataclass(frozen=True)
class Witness:
    """A point at which a claimed identity fails."""

    #: The exact value of every symbol; text where it is no fraction, as '2*atan(1/3)'.
    point: dict[str, Fraction | str]
    #: Of the residual there; not zero.
    value: Fraction | str


@dataclass(frozen=True)
class Proof:
    """The outcome of one claim. True where it is proved; taking an undecided one for a truth value raises."""

    kind: str  #: 'integral', 'casimir', 'jacobi', 'rank', ..
    name: str
    verdict: str  #: 'proved', 'refuted' or 'undecided'
    witness: Witness | None  #: of what is refuted
    where: list[str]  #: conditions that a proof depends on, as 'a != 0'
    on: list[str]  #: functions whose common zero level the claim is about
    evidence: str  #: what was found, in words
    residual: str  #: what should have been zero
    reason: str  #: of what is not proved
    fact: bool  #: about the system; counts only where the case claims to be integrable
    integrals: list[str]  #: that a Lax pair gives
    spectrum: dict[str, Any] | None  #: of a Lax pair: what these are enough for, with a `verdict` of its own
    findings: list[Proof]  #: what else is known of a candidate
    seconds: float

    def __bool__(self) -> bool:
        return _truth(self.verdict, f"the {self.kind} {self.name}")

    def __str__(self) -> str:
        where = f" where {', '.join(self.where)}" if self.where else ""
        return f"{self.verdict}{where}: {self.kind} {self.name}"


def proof_of(facts: dict[str, Any]) -> Proof:
    """The object for what the C++ side says of a proof."""
    witness = facts["witness"]
    if witness is not None:
        point = {name: number_of(value) for name, value in witness["point"].items()}
        witness = Witness(point, number_of(witness["value"]))
    kept = {key: value for key, value in facts.items() if key not in ("note", "witness", "findings")}
    return Proof(witness=witness, findings=[proof_of(one) for one in facts["findings"]], **kept)


class Verification(Sequence[Proof]):
    """The proofs of a case's claims, or of candidates, in order. True where all that counts is proved."""

    def __init__(self, verdict: str, proofs: list[Proof], notes: list[Proof], left_out: list[str] | None = None):
        self.left_out = left_out or []  #: claims that have no theorem in the certificate, with the reasons
        self.verdict = verdict  #: the worst among the claims
        self.proofs = proofs
        self.notes = notes  #: what is said beside the claims, and never counts

    @overload
    def __getitem__(self, index: int) -> Proof: ...
    @overload
    def __getitem__(self, index: slice) -> list[Proof]: ...
    @overload
    def __getitem__(self, index: str) -> Proof: ...
    def __getitem__(self, index):
        if not isinstance(index, str):
            return self.proofs[index]
        for proof in self.proofs:
            if proof.name == index:
                return proof
        raise KeyError(index)

    def __len__(self) -> int:
        return len(self.proofs)

    def __iter__(self) -> Iterator[Proof]:
        return iter(self.proofs)

    def __bool__(self) -> bool:
        return _truth(self.verdict, "the case")

    @property
    def witness(self) -> Witness | None:
        """That of the first claim that is refuted."""
        return next((proof.witness for proof in self.proofs if proof.witness is not None), None)

    def __repr__(self) -> str:
        return "\n".join([f"<{self.verdict}>"] + [f"  {proof}" for proof in self.proofs])

    def _repr_html_(self) -> str:
        rows = []
        for proof in self.proofs:
            note = proof.evidence if proof.verdict == "proved" else proof.reason
            if proof.witness is not None:
                note = f"{proof.witness.value} at {_listed(proof.witness.point)}"
            where = f" where {', '.join(proof.where)}" if proof.where else ""
            rows.append((proof.verdict + where, proof.kind, proof.name, note))
        return table(["verdict", "claim", "", "evidence"], rows)


def verification_of(answer: dict[str, Any]) -> Verification:
    """The object for what the C++ side says of the claims of a case."""
    proofs = answer["proofs"]
    return Verification(
        answer["verdict"],
        [proof_of(one) for one in proofs if not one["note"]],
        [proof_of(one) for one in proofs if one["note"]],
        answer.get("left_out"),
    )


class Findings(Sequence[dict[str, Any]]):
    """What a search for structure found, each a dictionary. Attributes say what is known of the whole.

    `verdict` is 'proved' where it is proved that there is nothing else, and `reason` says why it is not.
    """

    def __init__(self, facts: dict[str, Any], what: str):
        self._facts = {key: value for key, value in facts.items() if key != "found"}
        self._what = what
        self.found: list[Any] = facts["found"]

    def __getattr__(self, name: str) -> Any:
        try:
            return self.__dict__["_facts"][name]
        except KeyError:
            raise AttributeError(name) from None

    def __dir__(self):
        return [*super().__dir__(), *self._facts]

    def __getitem__(self, index):
        return self.found[index]

    def __len__(self) -> int:
        return len(self.found)

    def __bool__(self) -> bool:
        return _truth(self._facts["verdict"], f"whether there are other {self._what}")

    def __repr__(self) -> str:
        rational = " with rational coefficients" if self._facts.get("coefficients") == "rational" else ""
        end = f"no others{rational}: proved" if self.verdict == "proved" else f"others: undecided, {self.reason}"
        end += _beside(self._facts.get("not_on", []))
        return "\n".join([f"<{len(self)} {self._what}; {end}>"] + [f"  {one}" for one in self.found])

    def _repr_html_(self) -> str:
        rows = [(one if isinstance(one, str) else _listed(one),) for one in self.found]
        return table([self._what], rows)


class Separations(Findings):
    """Variables that separate: one system of them, or none. True where there is one.

    `verdict` is 'proved' where one is proved, or that there is none of the kind that was looked for (`none`); of
    roots that were given it is 'refuted' where the integrals do not separate in them.
    """

    def __bool__(self) -> bool:
        return _truth(self.verdict, f"whether there are {self._what}") and bool(self.found)

    def __repr__(self) -> str:
        state = f"{self.verdict}, {self.reason}" if self.reason else self.verdict
        return "\n".join([f"<{len(self)} {self._what}; {state}>"] + [f"  {one}" for one in self.found])


@dataclass(frozen=True)
class Relation:
    """Whether one case is another in linear coordinates. True where there is such a map."""

    verdict: str  #: 'proved': there is a map; 'refuted': there is none with real coefficients
    map: dict[str, str]  #: the variables of the second case over those of the first
    factor: str  #: c of H_B(T x) = c*H_A(x) + F(x)
    casimir_part: str  #: F, a function of Casimir functions
    differences: list[tuple[str, str, str]]  #: by which there is none: name, of the first, of the second
    reason: str  #: of what is not proved

    def __bool__(self) -> bool:
        return _truth(self.verdict, "the relation")


@dataclass(frozen=True)
class MapSearch(Sequence[str]):
    """Integrals of a map that were found, each of them proved. True where it is proved that there is none."""

    integrals: list[str]
    densities: list[str]  #: of measures that the map keeps, up to sign
    density_evidence: list[str]  #: what the proof of each says beside, and what it depends on
    no_polynomial: bool  #: proved: no polynomial of the degree is an integral
    no_rational: bool  #: proved: nor is a quotient of them
    polynomials: int  #: at most so many independent ones
    relations: int  #: a general orbit lies on at most so many hypersurfaces of the degree
    density_space: int  #: at most so many polynomials P with a density 1/P
    generic: list[str]  #: parameters that all this is about generic values of
    reason: str  #: why functions that seem to exist are not shown

    def __getitem__(self, index):
        return self.integrals[index]

    def __len__(self) -> int:
        return len(self.integrals)

    def _repr_html_(self) -> str:
        rows = [("integral", text) for text in self.integrals] + [("density", text) for text in self.densities]
        return table(["proved", ""], rows)


@dataclass(frozen=True)
class Degrees:
    """The degrees of a map's iterates. What they suggest of the next ones is no proof."""

    degrees: list[int]  #: of the first, second, .. iterate
    growth: str  #: 'polynomial', 'exponential' or 'unclear'
    growth_degree: int | None  #: of polynomial growth
    formula: str  #: as '2*n^2 + 1', where all of them obey it
    recurrence: str  #: as 'd(n+2) = 3*d(n+1) - d(n)'
    ratio: float | None  #: of exponential growth
    confinement: str = "unclear"  #: of singularities: 'none', 'confined', 'not_confined' or 'unclear'
    confinement_steps: int = 0  #: that every orbit was followed, if it recovered nothing
    #: lost, recovered (or None), until: iterates; points: that did so
    singularities: list[dict[str, Any]] = field(default_factory=list)

    @property
    def entropy(self) -> float | None:
        """The logarithm of the ratio; 0 for polynomial growth."""
        import math

        if self.ratio is not None:
            return math.log(self.ratio)
        return 0.0 if self.growth == "polynomial" else None


@dataclass(frozen=True)
class Iterates:
    """An orbit of a map."""

    t: Any  #: array (m,): the numbers of the steps
    y: Any  #: array (n, m): the states there
    steps: int  #: that were done
    names: list[str]  #: of the entries of a state
    state: list[float]  #: the last one that is finite
    finite: bool  #: false: the next state is none
    stopped: bool  #: by the time limit
    drift: dict[str, float]  #: of each invariant
    seconds: float
    error_estimate: float | None  #: of the last state, relative, by rounding; None: not estimated
    reason: str = ""  #: why there is no next state
    warnings: list[str] = field(default_factory=list)  #: on integrals that change: sentences

    @property
    def success(self) -> bool:
        """Whether all steps were done."""
        return self.finite and not self.stopped


@dataclass(frozen=True)
class Found:
    """A function that a search found."""

    text: str  #: in the notation of case files
    latex: str
    degree: int
    verdict: str
    independent: bool  #: functionally, of what stands before it

    def __str__(self) -> str:
        return self.text

    def _repr_latex_(self) -> str:
        return f"$\\displaystyle {self.latex}$"


@dataclass(frozen=True)
class Search(Sequence[Found]):
    """The integrals that a search found, less those that follow from the known ones."""

    found: list[Found]
    casimirs: list[Found]  #: found first, and taken as known
    trivial: int  #: dimension of what the known ones generate up to the degree, with 1
    complete: bool  #: proved: there are no others up to the degree
    reason: str  #: where not
    generic: list[str]  #: parameters that the answer is about generic values of
    #: what all this is polynomials in, beside the variables
    functions: list[str] = field(default_factory=list)
    weights: dict[str, int] = field(default_factory=dict, repr=False)  #: where they are not all 1
    degree_in: list[tuple[list[str], int]] = field(default_factory=list, repr=False)  #: limits beside the degree
    not_on: list[str] = field(default_factory=list)  #: constraints of the case, on which there may be more

    def __getitem__(self, index):
        return self.found[index]

    def __len__(self) -> int:
        return len(self.found)

    @property
    def verdict(self) -> str:
        """'proved' where what was found is all there is, else 'undecided'."""
        return "proved" if self.complete else "undecided"

    def _repr_html_(self) -> str:
        said = "proved: there is no other" if self.complete else f"undecided: {self.reason}"
        rows = [(one.degree, (_maths(one.latex),), one.verdict) for one in self.found]
        return table(["degree", "integral", "verdict"], rows, said + _beside(self.not_on))


def _beside(constraints: Sequence[str]) -> str:
    """What is said of constraints that a search is not about."""
    return f"; not about the constraints, on which there may be more: {', '.join(constraints)}" if constraints else ""


def _maths(latex: str) -> str:
    """What notebooks typeset inside of HTML."""
    return "$" + html.escape(latex) + "$"


def search_of(facts: dict[str, Any]) -> Search:
    """The object for what the C++ side says of a search."""
    lists = {key: [Found(**one) for one in facts[key]] for key in ("found", "casimirs")}
    return Search(**{**facts, **lists})


@dataclass(frozen=True)
class Condition:
    """Values of parameters at which there are further integrals."""

    parameters: dict[str, str]
    relation: str  #: an irreducible polynomial that vanishes; empty for a point
    found: list[Found]
    verdict: str


@dataclass(frozen=True)
class Conditions(Sequence[Condition]):
    """All of them that a search with free parameters found."""

    generic: Search  #: for generic values
    conditions: list[Condition]
    complete: bool  #: proved: there is no other value, curve or set
    reason: str

    def __getitem__(self, index):
        return self.conditions[index]

    def __len__(self) -> int:
        return len(self.conditions)

    @property
    def verdict(self) -> str:
        """'proved' where there is no other, else 'undecided'."""
        return "proved" if self.complete else "undecided"

    def _repr_html_(self) -> str:
        said = "proved: there is no other" if self.complete else f"undecided: {self.reason}"
        rows = [(one.relation + " = 0" if one.relation else _listed(one.parameters),
                 (", ".join(_maths(found.latex) for found in one.found),), one.verdict)
                for one in self.conditions]
        return table(["where", "integrals", "verdict"], rows, said)


@dataclass(frozen=True)
class DarbouxPolynomial:
    """A polynomial whose rate is a multiple of it."""

    text: str
    cofactor: str
    relations: list[str]
    degree: int
    verdict: str


@dataclass(frozen=True)
class MapDarboux(Sequence[DarbouxPolynomial]):
    """Discrete Darboux polynomials of a map, with cofactors that are products of `factors`."""

    found: list[DarbouxPolynomial]
    combinations: list[tuple[str, str]]  #: "integral" or "multiplier", a density, with its text
    combination_evidence: list[str]  #: what the proof of each says beside, and what it depends on
    factors: list[str]
    #: Proved: there are no others with rational coefficients and such cofactors, beside products and sums.
    complete: bool
    has_conjugates: bool  #: others were seen, with coefficients that are algebraic numbers
    reason: str  #: where not complete

    def __getitem__(self, index):
        return self.found[index]

    def __len__(self) -> int:
        return len(self.found)


def map_darboux_of(facts: dict[str, Any]) -> MapDarboux:
    return MapDarboux(**{**facts, "found": [DarbouxPolynomial(**one) for one in facts["found"]]})


@dataclass(frozen=True)
class Exponent:
    """A Kovalevskaya exponent, or all roots of one irreducible polynomial."""

    text: str  #: the number, or the polynomial in `rho` that has it as a root
    is_root: bool  #: whether the text is a polynomial
    multiplicity: int
    values: list[tuple[float, float]]  #: of algebraic numbers: real and imaginary parts


@dataclass(frozen=True)
class Balance:
    """Leading terms x_i = c_i (t - t0)^(-g_i), with their exponents."""

    coefficients: dict[str, str]
    relations: list[str]
    free: list[str]
    exponents: list[Exponent]
    decided: bool


@dataclass(frozen=True)
class Exponents:
    """A Kovalevskaya-Painleve analysis."""

    weights: dict[str, str]
    left_out: list[str]
    balances: list[Balance]
    complete: bool
    reason: str
    generic: list[str]
    conclusions: list[str]  #: with the theorem used
    starts: int = 0  #: of the iteration, where balances are numeric

    def _repr_html_(self) -> str:
        rows = [(_listed(one.coefficients), ", ".join(exponent.text for exponent in one.exponents))
                for one in self.balances]
        return table(["balance", "exponents"], rows, "; ".join(self.conclusions))


def exponents_of(facts: dict[str, Any]) -> Exponents:
    """The object for what the C++ side says of the analysis."""
    balances = []
    for one in facts["balances"]:
        exponents = [Exponent(**exponent) for exponent in one["exponents"]]
        balances.append(Balance(**{**one, "coefficients": dict(one["coefficients"]), "exponents": exponents}))
    return Exponents(**{**facts, "weights": dict(facts["weights"]), "balances": balances})


@dataclass(frozen=True)
class Obstruction:
    """Whether a further meromorphic integral is excluded."""

    verdict: str  #: 'proved' where it is, else 'undecided'
    theorem: str
    excluded: str  #: which integrals, and where
    reason: str  #: where nothing is excluded: why
    parameters: dict[str, str]
    examined: list[dict[str, Any]]  #: the curves with their normal variational equations
    survivors: list[dict[str, Any]]  #: real values of a free parameter that are not excluded alike
    sequences: list[dict[str, Any]]  #: intervals in which only numbers survive that obey conditions
    rational: bool = False  #: not proved, but that there is no further rational integral
    left_out: list[str] = field(default_factory=list, repr=False)  #: what has no theorem in the certificate

    def __bool__(self) -> bool:
        return _truth(self.verdict, "the obstruction")

    def _repr_html_(self) -> str:
        rows = [("excluded", self.excluded), ("theorem", self.theorem), ("reason", self.reason)]
        return table(["verdict", self.verdict], [row for row in rows if row[1]])


@dataclass(frozen=True)
class Equilibrium:
    """A state that rests, or that moves with a symmetry only."""

    state: Any  #: array of n numbers
    velocities: list[float]  #: of the symmetries; empty at rest
    eigenvalues: list[complex]  #: of the linearised equations
    growth: float  #: the largest real part among them, or 0
    family: int  #: dimension of the family on the level; 0: isolated
    degenerate: bool
    residual: float  #: the largest rate that is left
    #: 'spectrally stable', 'unstable', 'not decided' (rounding may have moved an eigenvalue over the
    #: imaginary axis) or 'no derivative'
    stability: str
    proof: ProvedEquilibrium | None = None  #: where it was asked for


@dataclass(frozen=True)
class ProvedEquilibrium:
    """What is proved of an equilibrium: there is exactly one in the enclosure. True where it is proved."""

    verdict: str  #: 'proved' or 'undecided'
    reason: str
    enclosure: dict[str, tuple[Fraction, Fraction]] = field(default_factory=dict)
    velocities: list[tuple[Fraction, Fraction]] = field(default_factory=list)  #: of the symmetries
    radius: Fraction | None = None  #: the largest half width of these
    stability: str = "undecided"  #: 'stable' (Lyapunov), 'unstable' or 'undecided'

    def __bool__(self) -> bool:
        return _truth(self.verdict, "the equilibrium")


@dataclass(frozen=True)
class Rotation:
    """How an orbit of a section turns, in turns from one point to the next, up to whole turns."""

    kind: str  #: 'curve', 'islands', 'cycle', or 'none', with the reason
    number: float | None
    error: float | None
    parts: int  #: how many islands, or the length of the cycle
    inner: float | None  #: of islands, in turns per `parts` points along one of them
    inner_error: float | None
    directed: bool  #: whether `number` is told from 1 - `number`
    reason: str


@dataclass(frozen=True)
class ProvedCycle:
    """What is proved of a periodic orbit: exactly one crosses the plane in the enclosure. True where it is proved."""

    verdict: str  #: 'proved' or 'undecided'
    reason: str
    enclosure: dict[str, tuple[Fraction, Fraction]] = field(default_factory=dict)
    period: tuple[Fraction, Fraction] | None = None
    trace: tuple[Fraction, Fraction] | None = None
    radius: Fraction | None = None
    kind: str = "undecided"  #: 'elliptic', 'hyperbolic', 'inverse hyperbolic' or 'undecided'

    def __bool__(self) -> bool:
        return _truth(self.verdict, "the cycle")


@dataclass(frozen=True)
class Cycle:
    """A periodic orbit of a section."""

    points: Any  #: array (length, 2): the plotted pair
    states: Any  #: array (length, n)
    period: float
    trace: float  #: of the derivative of the return map along it
    multipliers: tuple[complex, complex]
    #: 'elliptic', 'hyperbolic', 'inverse hyperbolic' or 'parabolic or nearly so'; where areas need not be
    #: kept 'attracting', 'unstable' or 'near the unit circle'
    kind: str
    stable: bool | None  #: spectrally: it is elliptic; None where that is not decided
    stability: str  #: 'spectrally stable', 'unstable' or 'not decided'
    residual: float  #: how far it is from closing
    proof: ProvedCycle | None = None  #: where it was asked for

    def __len__(self) -> int:
        return len(self.points)


@dataclass(frozen=True)
class SymmetricCycle:
    """A periodic orbit x with x(t + T/n) = S x(t) for a symmetry S of order n. It is found, not proved."""

    state: Any  #: array (n,): where it begins
    period: float  #: T
    state_error: float  #: by a second solution at a coarser tolerance
    period_error: float
    residual: float  #: how far x(T/n) is from S x(0), relative to the size of the state
    closure: float  #: the same of x(T) and x(0)
    multipliers: list[complex]  #: n-th roots of those of Floquet
    stable: bool | None  #: all of these are on the unit circle to 1e-5; None where that is not decided
    stability: str  #: 'spectrally stable', 'unstable' or 'not decided'
    order: int  #: of S
    names: list[str]  #: of the entries of a state
    warnings: list[str]


@dataclass(frozen=True)
class Orbit:
    """The crossings of one orbit with the plane of a section."""

    points: Any  #: array (count, 2): the plotted pair
    times: Any  #: array (count,)
    states: Any  #: array (count, n)
    seed: Any  #: array (n,): where it began
    exponent: float | None  #: growth of deviations per unit of time; None where it is too short to tell
    chaotic: bool | None
    leaves_level: bool  #: a crossing was further off the level than a section allows, and dropped
    returns: bool
    status: str
    rotation: Rotation | None = None  #: where it was asked for


@dataclass(frozen=True)
class Section(Sequence[Orbit]):
    """A Poincare section: orbits on one level of energy and Casimir functions, cut with a plane."""

    orbits: list[Orbit]
    plane: str
    level: str  #: 'H = 1.5, F1 = 1'
    labels: tuple[str, str]  #: of the axes
    names: list[str] = field(default_factory=list)  #: of the entries of a state
    cycles: list[Cycle] = field(default_factory=list)  #: periodic orbits, where they were asked for
    degenerate_cycles: int = 0  #: how many more have the trace 2, as those of families have, in integrable systems
    certified: int = 0  #: how many are in the certificate

    def __getitem__(self, index):
        return self.orbits[index]

    def __len__(self) -> int:
        return len(self.orbits)

    def _repr_html_(self) -> str:
        rows = [(number, len(orbit.points), {None: "", True: "yes", False: "no"}[orbit.chaotic], orbit.status)
                for number, orbit in enumerate(self.orbits, 1)]
        return table(["orbit", "crossings", "chaotic", "status"], rows,
                     f"{self.plane}{'' if '=' in self.plane else ' = 0'}, {self.level}")

    def plot(self, ax: Any = None, **style: Any) -> Any:
        """Draws the crossings on axes of matplotlib, chaotic orbits in grey, and returns the axes."""
        if ax is None:
            from matplotlib import pyplot

            ax = pyplot.gca()
        style = {"markersize": 1, "linestyle": "none", "marker": ".", **style}
        for orbit in self.orbits:
            colour = {"color": "0.6"} if orbit.chaotic and "color" not in style else {}
            ax.plot(orbit.points[:, 0], orbit.points[:, 1], **{**style, **colour})
        ax.set_xlabel(self.labels[0])
        ax.set_ylabel(self.labels[1])
        ax.set_title(self.level)
        return ax


class Solution(dict):
    """A motion, in the shape of SciPy's OdeResult: `t` (m,), `y` (n, m), `sol`, `status`, `message`,
    `success`, `nfev`, `njev`, and what is known of how far it can be believed.

    `status` is 0 at the end and -1 where the run stopped early, which `reason` ('singularity', ..)
    and `message` explain; `y` then ends at the last good state. `drift` is that of every invariant,
    `trust` a dictionary with the estimated error, `warnings` a list of sentences. Keys are
    attributes too.
    """

    def __getattr__(self, name: str) -> Any:
        try:
            return self[name]
        except KeyError:
            raise AttributeError(name) from None

    def __dir__(self):
        return list(self)

    def __repr__(self) -> str:
        lines = [f"{key:>12}: {self[key]!r}" for key in ("success", "message", "method", "t", "y", "drift", "trust")]
        return "\n".join(lines + [f"{'warning':>12}: {warning}" for warning in self.warnings])

    def _repr_html_(self) -> str:
        rows = [(name, float(value)) for name, value in zip(self.names, self.y[:, -1])]
        rows += [(f"drift of {name}", float(value)) for name, value in self.drift.items()]
        rows += [("warning", warning) for warning in self.warnings]
        end = float(self.t[-1]) if len(self.t) else 0.0
        return table(["", f"t = {end:.6g}"], rows, f"{self.method}: {self.message}")


@dataclass(frozen=True)
class Ensemble:
    """The ends of many motions."""

    y: Any  #: array (members, n): the states
    t: Any  #: array (members,): the times
    status: list[str]  #: 'ok', 'singularity', .. of each member
    drift: dict[str, Any]  #: array (members,) for each invariant
    steps: Any  #: array (members,)
    names: list[str]  #: of the columns of y
    seconds: float  #: of the integration alone
    jobs: int  #: threads that took part
    warnings: list[str]  #: on members that are not on the constraints, on integrals that change

    @property
    def success(self) -> bool:
        """Whether every member reached its end."""
        return all(status == "ok" for status in self.status)

    def _repr_html_(self) -> str:
        kinds = sorted(set(self.status))
        rows = [(kind, self.status.count(kind)) for kind in kinds]
        rows += [("warning", warning) for warning in self.warnings]
        return table(["status", "members"], rows, f"{len(self.status)} members in {self.seconds:.3g} s")


def solution_of(motion: Any, times) -> Solution:
    """The object for what the C++ side says of a run."""
    import numpy

    facts = motion.facts()

    def sol(t):
        """The state at a time, shape (n,), or at times (k,), shape (n, k)."""
        asked = numpy.asarray(t, dtype=float)
        states = motion.at(asked.ravel())
        return states[:, 0] if asked.ndim == 0 else states

    if times is None:
        t, y = motion.steps()
    else:
        reached = facts["time"]
        t = times[(times <= reached) if reached >= 0 else (times >= reached)]
        y = motion.at(t)
    invariants = motion.invariants()
    ok = motion.ok
    return Solution(
        t=t, y=y, sol=sol, success=ok, status=0 if ok else -1, reason=facts["status"],
        message="The end of the run was reached." if ok else facts["reason"],
        nfev=facts["evaluations"], njev=facts["jacobians"], nlu=0, t_events=None, y_events=None,
        names=motion.names, method=facts["method"], rtol=facts["rtol"], atol=facts["atol"],
        steps=facts["steps"], rejected=facts["rejected"], seconds=facts["seconds"],
        drift={name: record["drift"] for name, record in invariants.items()}, invariants=invariants,
        trust=motion.trust(), warnings=facts["warnings"], advice=facts["advice"], left_out=facts["left_out"],
    )


def _exact(ends: Any) -> tuple[Fraction, Fraction]:
    return Fraction(ends[0]), Fraction(ends[1])


def _exact_box(box: dict[str, Any]) -> dict[str, tuple[Fraction, Fraction]]:
    return {name: _exact(ends) for name, ends in box.items()}


def _proof_of(facts: dict[str, Any] | None, kind: type) -> Any:
    if facts is None:
        return None
    given = {"verdict": "proved" if facts["proved"] else "undecided", "reason": facts["reason"]}
    for name, value in facts.items():
        if name == "enclosure":
            given[name] = _exact_box(value)
        elif name == "radius":
            given[name] = Fraction(value)
        elif name == "velocities":
            given[name] = [_exact(ends) for ends in value]
        elif name in ("period", "trace"):
            given[name] = _exact(value)
        elif name not in ("proved", "reason"):
            given[name] = value
    return kind(**given)


def equilibrium_of(facts: dict[str, Any]) -> Equilibrium:
    """The object for what the C++ side says of an equilibrium."""
    return Equilibrium(**{**facts, "proof": _proof_of(facts["proof"], ProvedEquilibrium)})


def section_of(facts: dict[str, Any]) -> Section:
    """The object for what the C++ side says of a section."""
    orbits = [Orbit(**{**one, "rotation": one["rotation"] and Rotation(**one["rotation"])}) for one in facts["orbits"]]
    cycles = [Cycle(**{**one, "multipliers": tuple(one["multipliers"]), "proof": _proof_of(one["proof"], ProvedCycle)})
              for one in facts["cycles"]]
    return Section(**{**facts, "orbits": orbits, "cycles": cycles})
