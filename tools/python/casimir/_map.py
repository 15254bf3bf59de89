"""Maps: what `casimir.load_map`, `casimir.Map` and `Case.discretise` give."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from typing import TYPE_CHECKING, Union

from . import _core
from ._exact import Expression, is_float, pairs_of, texts_of, whole
from ._lazy import Lazy

if TYPE_CHECKING:
    from ._results import Degrees, Iterates, MapDarboux, MapSearch, Verification

_results = Lazy("._results")

#: One expression, or several.
Expressions = Union[Expression, Iterable[Expression], None]


def maps() -> list[str]:
    """The names of the bundled maps."""
    return _core.bundled_maps()


def load_map(case: str) -> Map:
    """A bundled map by its name, or a case file by its path (with '/' or ending in '.toml').

    >>> load_map("lyness").variables
    ['x', 'y']
    """
    return Map._of(_core.Map.load(str(case)))


class Map:
    """A map x -> x' with its claims and scenes. Maps do not change: methods that change one return another.

    :param text: a case file with a table [map].

    >>> shear = Map('''
    ... title = "a shear"
    ... [phase_space]
    ... variables = ["x", "y"]
    ... [map]
    ... x = "x + y^2"
    ... y = "y"
    ... ''')
    >>> bool(shear.verify(integral="y")), bool(shear.verify(integral="x"))
    (True, False)
    """

    def __init__(self, text: str, *, name: str = "map"):
        self._core = _core.Map.from_text(text, f"{name}.toml")

    @classmethod
    def _of(cls, core: _core.Map) -> Map:
        self = cls.__new__(cls)
        self._core = core
        return self

    def __reduce__(self):
        core = self._core
        return _restored, (core.text, core.file, core.changed_parameters, core.changed_initial, core.rounded)

    def __repr__(self) -> str:
        return f"<casimir.Map {self.name}: {self.title}>"

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

    def with_values(self, parameters: Mapping[str, Expression] | None = None,
                    initial: Mapping[str, Expression] | None = None) -> Map:
        """The map with numbers in the place of parameters, and other starts in its scenes."""
        starts = pairs_of(initial)
        rounded = any(is_float(value) for value in (initial or {}).values())
        return Map._of(self._core.with_values(pairs_of(parameters), starts, rounded))

    def verify(self, integral: Expressions = None, *, casimir: Expressions = None,
               invariant_relation: Expressions = None, identity: Expressions = None, on: Expressions = None,
               time_limit: float = 0) -> Verification:
        """Proves or refutes every claim of the map, or these candidates instead, as `Case.verify` does.

        >>> load_map("lyness").verify().verdict
        'proved'
        """
        return _results.verification_of(
            self._core.verify(texts_of(integral), texts_of(casimir), texts_of(invariant_relation), texts_of(identity),
                              texts_of(on), time_limit))

    def search(self, degree: int, *, time_limit: float = 0, memory: float = 0) -> MapSearch:
        """Integrals that are quotients of polynomials up to a degree, and densities of invariant measures.

        >>> found = load_map("lyness").with_values({"a": 2}).search(3)
        >>> len(found), found.no_polynomial
        (1, True)
        """
        return _results.MapSearch(**self._core.search(whole("degree", degree, 0, 1000), time_limit, memory))

    def darboux(self, degree: int, *, time_limit: float = 0, memory: float = 0) -> MapDarboux:
        """Polynomials P with P(x') = C P up to a degree, and what their products give.

        >>> found = load_map("lyness").with_values({"a": 2}).darboux(2)
        >>> [(one.text, one.cofactor) for one in found]
        [('x*y', '(y + 2)/x^2')]
        """
        return _results.map_darboux_of(self._core.darboux(whole("degree", degree, 0, 1000), time_limit, memory))

    def degrees(self, iterates: int = 0, *, time_limit: float = 0, memory: float = 0) -> Degrees:
        """The degrees of the iterates on a general line. What they suggest is evidence and no proof.

        >>> load_map("henon-area-preserving").degrees(5).degrees
        [2, 4, 8, 16, 32]
        """
        return _results.Degrees(**self._core.degrees(whole("iterates", iterates, 0, 1000), time_limit, memory))

    def iterate(self, steps: int, *, every: int = 1, initial: Mapping[str, Expression] | None = None,
                scene: str = "default", time_limit: float = 0, **parameters: Expression) -> Iterates:
        """Iterates a scene in double precision, compiled.

        :param every: steps between the states that are kept; 0 keeps none but the last.
        :returns: t (m,), y (n, m), state (n,), drift by the name of the invariant.

        >>> orbit = load_map("lyness").iterate(100, every=10)
        >>> orbit.y.shape
        (2, 11)
        """
        case = self if parameters is None and initial is None else self.with_values(parameters, initial)
        return _results.Iterates(**case._core.iterate(scene, steps, every, time_limit))


def _restored(text: str, file: str, parameters, initial, rounded: bool) -> Map:
    core = _core.Map.from_text(text, file)
    return Map._of(core.with_values(parameters, initial, rounded) if parameters or initial else core)
