"""Compiled scenes: what `Case.system` gives."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from . import _core

if TYPE_CHECKING:
    from numpy.typing import ArrayLike, NDArray


class System:
    """A compiled scene. States are arrays (n,) in the order of `names`."""

    def __init__(self, core: _core.System):
        self._core = core

    @property
    def names(self) -> list[str]:
        """Of the entries of a state."""
        return self._core.names

    @property
    def parameter_names(self) -> list[str]:
        """Of the parameters that stay arguments."""
        return self._core.parameter_names

    @property
    def invariant_names(self) -> list[str]:
        """Of the entries of `invariants`."""
        return self._core.invariant_names

    @property
    def initial(self) -> NDArray:
        """The start of the scene, shape (n,)."""
        import numpy

        return numpy.array(self._core.initial)

    def rhs(self, t: float, y: ArrayLike, parameters: ArrayLike | None = None) -> NDArray:
        """dy/dt at a time and a state (n,), shape (n,).

        :param parameters: the values of those that were kept, in the order of `parameter_names`;
            without them those of the scene. So it is below.
        """
        return self._core.rhs(t, y, parameters)

    def jacobian(self, t: float, y: ArrayLike, parameters: ArrayLike | None = None) -> NDArray:
        """The derivatives of `rhs` by the state, shape (n, n)."""
        return self._core.jacobian(t, y, parameters)

    def invariants(self, t: float, y: ArrayLike, parameters: ArrayLike | None = None) -> NDArray:
        """The Hamiltonian, the Casimir functions and the integrals at a state, in the order of
        `invariant_names`."""
        return self._core.invariants(t, y, parameters)

    def low_level(self, component: str | None = None) -> Any:
        """The right-hand side as a `scipy.LowLevelCallable`: compiled code calls it without Python.

        :param component: a variable: the function is its rate, `double (int n, double *x, void *)`,
            which `scipy.integrate.quad` and `scipy.ndimage` take. x are the entries of a state, and
            the time where n is one more. Without it the function writes all rates:
            `void (double t, double *y, double *dydt, void *)`.

        Parameters that were kept have the values of the scene.

        >>> import casimir, scipy.integrate
        >>> growth = casimir.Case(equations={"x": "x^2"}, variables=["x"], initial={"x": 1}, duration=1)
        >>> area, _ = scipy.integrate.quad(growth.system().low_level("x"), 0, 3)
        >>> round(area, 12)
        9.0
        """
        import scipy

        function, data = self._core.address(component)
        return scipy.LowLevelCallable(function, user_data=data)

    def flow(self, y: ArrayLike, duration: float, tolerance: float | None = None,
             parameters: ArrayLike | None = None) -> NDArray:
        """The state after a time, by the method of the system at this tolerance (1e-12).

        :raises RequestError: where the motion does not go on so long.
        """
        return self._core.flow(y, duration, tolerance, parameters)
