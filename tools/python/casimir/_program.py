"""What the program `casimir` makes: pages, and the matrix of extreme scenes, each run in a process of its own."""

from __future__ import annotations

import json
import os
import shutil
import subprocess
import tempfile
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Any

from ._errors import CaseError, EnvironmentProblem, Error, RequestError, UndecidedError
from ._html import table

if TYPE_CHECKING:
    from ._case import Case

#: Exit statuses of the program that say that something is wrong with what was asked or with the machine.
_BAD_INPUT, _ENVIRONMENT = 2, 4


@dataclass(frozen=True)
class Report:
    """A page about a case that was written."""

    file: str
    verdict: str  #: of all claims: 'proved', 'refuted' or 'undecided'
    claims: dict[str, int]  #: how many are 'proved', 'refuted' and 'undecided'
    plots: list[str]  #: the pictures in it
    notes: list[str]  #: what was left out for a reason of the case
    problems: list[str]  #: what this machine did not allow
    seconds: float
    ok: bool  #: all is proved, no run of any scene failed, and nothing was left out for want of time or of a program

    def __fspath__(self) -> str:
        return self.file


@dataclass(frozen=True)
class Cell:
    """An extreme scene by one method."""

    scene: str
    method: str
    verdict: str  #: 'right', 'warned', 'refused', 'inaccurate', 'wrong', or 'unknown' without a reference state
    refusal: str  #: of 'refused': 'expected', 'not_applicable' or 'failed'; empty for others
    status: str  #: how the run ended
    error: float | None  #: of the largest state; None where there is no end or no reference state
    seconds: float
    outside: bool  #: the method is that of another library


@dataclass(frozen=True)
class Stress(Sequence[Cell]):
    """Extreme scenes by every method. True where no method of casimir is wrong."""

    cells: list[Cell]
    complete: bool  #: not where the time limit came before the last cell

    def __getitem__(self, index):
        return self.cells[index]

    def __len__(self) -> int:
        return len(self.cells)

    def __bool__(self) -> bool:
        if any(cell.verdict == "wrong" and not cell.outside for cell in self.cells):
            return False
        if not self.complete:
            raise UndecidedError("the time limit came before the last cell: whether a method is wrong is undecided")
        return True

    def _repr_html_(self) -> str:
        methods = list(dict.fromkeys(cell.method for cell in self.cells))
        scenes = list(dict.fromkeys(cell.scene for cell in self.cells))
        of = {(cell.scene, cell.method): cell.verdict for cell in self.cells}
        return table(["scene", *methods], [(scene, *(of.get((scene, one), "") for one in methods)) for scene in scenes])


def program() -> str:
    """The program: that of the same build or prefix, or the first one on PATH.

    :raises EnvironmentProblem: where there is none: a wheel has the libraries alone.
    """
    here = Path(__file__).parent  # not where a link of a build tree leads
    places = [here / "../../../../bin/casimir"]
    if (here / "../../CMakeCache.txt").is_file():  # a build tree
        places.insert(0, here / "../../casimir")
    for place in places:
        if place.is_file() and os.access(place, os.X_OK):
            return str(place.absolute())
    if found := shutil.which("casimir"):
        return found
    raise EnvironmentProblem("the program 'casimir' is not there: it makes pages and the matrix of extreme scenes")


def _document(line: Sequence[str]) -> tuple[dict[str, Any], int]:
    """What a command line of the program says as JSON, and its exit status."""
    done = subprocess.run([program(), line[0], "--json", *line[1:]], capture_output=True, text=True, check=False)
    try:
        answer = json.loads(done.stdout)
    except ValueError:
        raise Error(f"casimir {line[0]} ended with status {done.returncode}: {done.stderr.strip()}") from None
    if "error" in answer and "text" in answer["error"]:
        kinds = {_BAD_INPUT: CaseError if "line" in answer["error"] else RequestError, _ENVIRONMENT: EnvironmentProblem}
        raise kinds.get(done.returncode, Error)(answer["error"]["text"].removeprefix("casimir: error: "))
    return answer, done.returncode


def survey(tag: str | None = None, *, time_limit: float = 0) -> list[dict[str, Any]]:
    """A table of all bundled cases: what is proved, and the operations that specialising saves.

    :param tag: only cases with this tag.
    :returns: a dictionary for each case: 'case', 'book', 'title', 'verdict', 'claims', 'operations', ..

    >>> [row["verdict"] for row in survey("goryachev-chaplygin")]
    ['proved']
    """
    line = ["survey"]
    if tag is not None:
        line += ["--tag", tag]
    if time_limit > 0:
        line += ["--time-limit", repr(float(time_limit))]
    return _document(line)[0]["rows"]


def new(name: str, *, algebra: str | None = None, canonical: int = 0, equations: int = 0) -> str:
    """The text of a commented case file to start from, for `Case(text)` once it says what it is about.

    :param algebra: a top on this Lie algebra, as 'e(3)'; without any of these so(3).
    :param canonical: instead, so many oscillators in q1 .., p1 ..
    :param equations: instead, so many equations without a bracket.

    >>> print(new("my-top", algebra="e(3)").splitlines()[0][0])
    #
    """
    line = ["new"]
    if algebra is not None:
        line += ["--algebra", algebra]
    if canonical:
        line += ["--canonical", str(canonical)]
    if equations:
        line += ["--equations", str(equations)]
    with tempfile.TemporaryDirectory(prefix="casimir-") as folder:
        file = Path(folder, "case.toml")
        _document([*line, "--output", str(file), "--", name])
        return file.read_text(encoding="utf-8")


def _answer(case: Case, words: Sequence[str], scene: str | None, initial: bool) -> tuple[dict[str, Any], int]:
    """The JSON document of a command about the case, and its exit status."""
    core = case._core
    if core.changed_initial and not initial:
        raise RequestError(f"{words[0]} takes the starts of the case file: write a case with another one")
    with tempfile.TemporaryDirectory(prefix="casimir-") as folder:
        file = Path(folder, core.name.replace("/", "_") + ".toml")
        file.write_text(core.text, encoding="utf-8")
        line = [words[0], str(file), *words[1:]]
        for option, values in (("--param", core.changed_parameters), ("--initial", core.changed_initial)):
            for name, value in values:
                line += [option, f"{name}={value}"]
        if core.set:
            line += ["--in", core.set]
        if scene is not None:
            line += ["--scene", scene]
        return _document(line)


def report(case: Case, file: str | os.PathLike[str], budget: float | None, scene: str | None,
           time_limit: float) -> Report:
    """Writes a page. See `Case.report`."""
    words = ["report", "--output", os.path.abspath(file)]
    if budget is not None:
        words += ["--budget", repr(float(budget))]
    if time_limit > 0:
        words += ["--time-limit", repr(float(time_limit))]
    answer, status = _answer(case, words, scene, True)
    return Report(**{name: answer[name] for name in Report.__dataclass_fields__ if name != "ok"}, ok=status == 0)


def stress(case: Case, methods: Sequence[str], tolerance: float | None, scene: str | None, every_scene: bool,
           cell_limit: float, time_limit: float) -> Stress:
    """Runs extreme scenes. See `Case.stress`."""
    words = ["stress", "--cell-limit", repr(float(cell_limit))]
    if methods:
        words += ["--method", ",".join(methods)]
    if tolerance is not None:
        words += ["--tolerance", repr(float(tolerance))]
    if every_scene:
        words.append("--every-scene")
    if time_limit > 0:
        words += ["--time-limit", repr(float(time_limit))]
    answer, _ = _answer(case, words, scene, False)
    cells = [Cell(scene=row["scene"], method=row["method"], verdict=row["verdict"], refusal=row.get("refusal", ""),
                  status=row["status"], error=None if row["error"] is None else float(row["error"]),
                  seconds=row["seconds"], outside=row["outside"]) for row in answer["rows"]]
    return Stress(cells, answer["complete"])
