"""What studies of motions answer: drifts, frequencies, comparisons, sweeps, and numbers that are right."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field
from decimal import Decimal
from fractions import Fraction
from typing import Any

from ._html import table
from ._results import _truth


@dataclass(frozen=True)
class Run:
    """A measured run of one method."""

    method: str
    tolerance: float
    status: str  #: 'ok', 'drifted', 'no_value', 'not_kept', 'wrong', 'does_not_split', or how the integration ended
    ok: bool  #: it arrived, and nothing is wrong with it
    failed: bool  #: it counts as a failure
    error: float  #: relative, of the end state; NaN where there is no reference state
    drift: float  #: the largest of all invariants
    seconds: float
    steps: int
    evaluations: int
    spread: float  #: half the distance of the quartiles of the times of repeated runs
    code: str  #: 'specialised' or 'general'
    reason: str  #: a sentence, where the status needs one
    drifts: dict[str, float] = field(default_factory=dict)  #: of each invariant


@dataclass(frozen=True)
class Conservation(Sequence[Run]):
    """Runs whose invariants were watched. True where none failed."""

    runs: list[Run]

    def __getitem__(self, index):
        return self.runs[index]

    def __len__(self) -> int:
        return len(self.runs)

    def __bool__(self) -> bool:
        return not any(run.failed for run in self.runs)

    def _repr_html_(self) -> str:
        rows = [(run.method, run.status, f"{run.drift:.1e}", f"{run.seconds:.3g}") for run in self.runs]
        return table(["method", "status", "largest drift", "seconds"], rows)


@dataclass(frozen=True)
class Frequencies:
    """The spectrum of a motion."""

    base: list[float]  #: every settled line is a combination of these with small whole numbers
    errors: list[float]  #: of them
    quasi_periodic: bool  #: the strong lines are the same in both halves of the motion
    variables: dict[str, dict[str, Any]]  #: `lines`, whether it is an `angle`, and the `rest` that they leave
    samples: int
    interval: float  #: the time between two samples
    warnings: list[str]

    def _repr_html_(self) -> str:
        rows = [(name, f"{line['frequency']:.15g}", f"{line['error']:.0e}", f"{line['amplitude']:.5g}")
                for name, spectrum in self.variables.items() for line in spectrum["lines"]]
        return table(["variable", "frequency", "error", "amplitude"], rows, "; ".join(self.warnings))


@dataclass(frozen=True)
class Comparison(Sequence[Run]):
    """Error against run time of several methods."""

    rows: list[Run]
    outside: list[str]  #: methods of other libraries
    scene: str
    reference: str  #: where the reference state is from
    bound: float  #: of its error
    conditioning: float  #: growth of small changes
    notes: list[str]  #: what was left out, and why

    def __getitem__(self, index):
        return self.rows[index]

    def __len__(self) -> int:
        return len(self.rows)

    def curve(self, method: str, code: str = "specialised") -> tuple[Any, Any]:
        """Arrays of the errors and run times of the rows of a method that are good."""
        import numpy

        good = [row for row in self.rows if row.method == method and row.code == code and row.ok]
        return numpy.array([row.error for row in good]), numpy.array([row.seconds for row in good])

    def plot(self, ax: Any = None) -> Any:
        """Draws error against run time on axes of matplotlib, and returns the axes."""
        if ax is None:
            from matplotlib import pyplot

            ax = pyplot.gca()
        for method, code in dict.fromkeys((row.method, row.code) for row in self.rows):
            errors, seconds = self.curve(method, code)
            if len(errors):
                label = method if code == "specialised" else f"{method} {code}"
                ax.loglog(errors, seconds, marker=".", linestyle="--" if method in self.outside else "-", label=label)
        ax.set_xlabel("error")
        ax.set_ylabel("run time in s")
        ax.legend()
        return ax

    def _repr_html_(self) -> str:
        rows = [(row.method, row.code, f"{row.tolerance:.0e}", row.status, f"{row.error:.1e}", f"{row.seconds:.3g}")
                for row in self.rows]
        return table(["method", "code", "tolerance", "status", "error", "seconds"], rows, f"reference: {self.reference}")


@dataclass(frozen=True)
class Sweep:
    """What a study found at the points of a grid: `sweep["M1"]` has an axis for each name."""

    axes: dict[str, Any]  #: the values of each name
    columns: dict[str, Any]  #: arrays over the grid
    status: list[str]  #: 'ok', 'singularity', .. of each point; the last axis runs fastest
    principal: str  #: the column that matters most, or empty
    warnings: list[str] = field(default_factory=list)  #: what is in doubt: sentences

    def __getitem__(self, column: str):
        return self.columns[column]

    @property
    def success(self) -> bool:
        """Whether every point was done to its end."""
        return all(status == "ok" for status in self.status)

    def plot(self, ax: Any = None, column: str | None = None) -> Any:
        """Draws a column over one or two axes with matplotlib, and returns the axes."""
        if ax is None:
            from matplotlib import pyplot

            ax = pyplot.gca()
        name = column or self.principal or next(iter(self.columns))
        (first, x), *others = self.axes.items()
        ax.set_xlabel(first)
        if not others:
            ax.plot(x, self.columns[name])
            ax.set_ylabel(name)
        elif len(others) == 1:
            (second, y), = others
            mesh = ax.pcolormesh(x, y, self.columns[name].T, shading="nearest")
            ax.figure.colorbar(mesh, ax=ax, label=name)
            ax.set_ylabel(second)
        else:
            raise ValueError("a grid of more than two names is no picture: choose from its arrays")
        return ax


@dataclass(frozen=True)
class PreciseEnd:
    """The end of a run with many digits. Numbers have those of the digits that two runs agree in."""

    state: dict[str, Decimal]
    time: Decimal
    status: str  #: 'ok', or how it ended
    reason: str  #: a sentence, where that is something else
    digits: int | None  #: in which the runs agree; None where none has checked the other
    lost: int  #: digits that the motion magnified errors by
    steps: int
    runs: int
    warnings: list[str]

    @property
    def success(self) -> bool:
        """Whether it reached the end with all its digits."""
        return self.status == "ok"


def precise_of(facts: dict[str, Any]) -> PreciseEnd:
    """The object for what the C++ side says of a run."""
    state = {name: Decimal(value) for name, value in facts["state"].items()}
    return PreciseEnd(**{**facts, "state": state, "time": Decimal(facts["time"])})


@dataclass(frozen=True)
class Box:
    """States at a time, all of them within intervals with rational ends."""

    time: Fraction
    intervals: dict[str, tuple[Fraction, Fraction]]

    def __getitem__(self, name: str) -> tuple[Fraction, Fraction]:
        return self.intervals[name]

    def __contains__(self, state: Any) -> bool:
        """Whether numbers by name, or in order, are in the box."""
        values = [state[name] for name in self.intervals] if hasattr(state, "keys") else list(state)
        return len(values) == len(self.intervals) and all(
            low <= Fraction(value) <= high for value, (low, high) in zip(values, self.intervals.values()))


@dataclass(frozen=True)
class Enclosure:
    """What is proved of the solutions of a scene: that they exist up to the time of `end`, and are in its boxes.

    True where that is the time asked for.
    """

    end: Box
    samples: list[Box]
    names: list[str]
    radius: float  #: the largest half width of the box at the end
    status: str  #: 'ok', or why it ended before
    reason: str
    contracted_by: list[str]  #: the integrals that made the boxes smaller
    doubts: list[str]  #: sentences on those that could not
    steps: int
    seconds: float

    @property
    def success(self) -> bool:
        """Whether it reached its time."""
        return self.status == "ok"

    def __bool__(self) -> bool:
        return _truth("proved" if self.success else "undecided", "the enclosure up to its time")

    def _repr_html_(self) -> str:
        rows = [(name, repr(float(low)), repr(float(high))) for name, (low, high) in self.end.intervals.items()]
        return table(["", "from", "to"], rows, f"t = {float(self.end.time):.6g}: {self.reason or 'proved'}")


def enclosure_of(facts: dict[str, Any]) -> Enclosure:
    """The object for what the C++ side says of an enclosure."""

    def box(one: dict[str, Any]) -> Box:
        ends = [(Fraction(low), Fraction(high)) for low, high in one["box"]]
        return Box(Fraction(one["time"]), dict(zip(facts["names"], ends)))

    return Enclosure(**{**facts, "end": box(facts["end"]), "samples": [box(one) for one in facts["samples"]]})


@dataclass(frozen=True)
class Horseshoe:
    """Chaos as a theorem. True where it is proved; where none was found nothing is said, as of an undecided claim."""

    proved: bool
    theorem: str  #: what is proved, in a sentence; empty where nothing is
    reason: str  #: where nothing is proved: how far the search came
    entropy: Fraction  #: the topological entropy of the return map is not below it
    radius: Fraction  #: nor is the spectral radius of the graph of coverings below this
    plane: str
    upwards: bool  #: in which direction it is crossed
    levels: dict[str, tuple[Fraction, Fraction]]  #: for all values in these intervals
    names: list[str]  #: of the entries of a state
    sets: dict[str, list[float]]  #: the centres of the h-sets
    coverings: list[tuple[str, str]]  #: each h-set with one that it covers
    cycles: int  #: hyperbolic ones that were found
    connections: int  #: orbits between them

    @property
    def verdict(self) -> str:
        """'proved' or 'undecided'."""
        return "proved" if self.proved else "undecided"

    def __bool__(self) -> bool:
        return _truth(self.verdict, "whether there is a horseshoe")

    def _repr_html_(self) -> str:
        if not self.proved:
            return table(["horseshoe"], [(self.reason,)])
        return table(["h-set", "covers"], [
            (name, ", ".join(to for of, to in self.coverings if of == name)) for name in self.sets], self.theorem)


def horseshoe_of(facts: dict[str, Any]) -> Horseshoe:
    """The object for what the C++ side says of a horseshoe."""
    return Horseshoe(**{**facts, "entropy": Fraction(facts["entropy"]), "radius": Fraction(facts["radius"]),
                        "levels": {of: (Fraction(low), Fraction(high)) for of, (low, high) in facts["levels"].items()}})


@dataclass(frozen=True)
class Checked:
    """What a file of certificates proves. True where all of it holds."""

    kind: str  #: 'run', 'cycles' or 'horseshoe'
    parts: list[dict[str, Any]]  #: of each certificate: whether it `holds`, the `reason` where not, and what it says

    @property
    def holds(self) -> bool:
        """Whether all of it is proved."""
        return all(part["holds"] for part in self.parts)

    @property
    def reason(self) -> str:
        """Why not: a sentence on the first that does not hold, or nothing."""
        return next((part["reason"] for part in self.parts if not part["holds"]), "")

    def __bool__(self) -> bool:
        return self.holds

    def _repr_html_(self) -> str:
        rows = [(part["of_case"], "proved" if part["holds"] else part["reason"]) for part in self.parts]
        return table(["case", self.kind], rows)


def checked_of(kind: str, parts: list[dict[str, Any]]) -> Checked:
    """The object for what the C++ side says of certificates."""
    for part in parts:
        for name in ("enclosure", "levels"):
            if name in part:
                part[name] = {of: (Fraction(low), Fraction(high)) for of, (low, high) in part[name].items()}
        if "period" in part:
            part["period"] = tuple(Fraction(end) for end in part["period"])
        if "entropy" in part:
            part["entropy"] = Fraction(part["entropy"])
    return Checked(kind, parts)


def write_text(path: Any, text: str) -> None:
    """Writes a file of text, which is whole or is not there."""
    import os

    part = f"{os.fspath(path)}.{os.getpid()}.part"
    try:
        with open(part, "x", encoding="utf-8", newline="\n") as file:
            file.write(text)
        os.replace(part, path)
    except BaseException:
        if os.path.exists(part):
            os.remove(part)
        raise
