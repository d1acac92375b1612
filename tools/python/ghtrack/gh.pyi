from typing import Any

from numpy.typing import ArrayLike, NDArray

from ghtrack.common import Saver

__all__ = [
    "GHFilter",
    "GHKFilter",
    "GHFilterOrder",
    "benedict_bordner_constants",
    "critical_damping_parameters",
    "least_squares_parameters",
    "optimal_noise_smoothing",
]

class GHFilter:
    x: Any
    dx: Any
    x_prediction: Any
    dx_prediction: Any
    dt: float
    g: float
    h: float
    y: Any
    z: Any
    def __init__(self, x: ArrayLike, dx: ArrayLike, dt: float, g: float, h: float) -> None: ...
    def update(self, z: ArrayLike, g: float | None = ..., h: float | None = ...) -> tuple[Any, Any]: ...
    def batch_filter(
        self,
        data: Any,
        save_predictions: bool = ...,
        saver: Saver | None = ...,
        g: ArrayLike | None = ...,
        h: ArrayLike | None = ...,
    ) -> Any: ...
    def VRF_prediction(self) -> float: ...
    def VRF(self) -> tuple[float, float]: ...

class GHKFilter:
    x: Any
    dx: Any
    ddx: Any
    x_prediction: Any
    dx_prediction: Any
    ddx_prediction: Any
    dt: float
    g: float
    h: float
    k: float
    y: Any
    z: Any
    def __init__(
        self, x: ArrayLike, dx: ArrayLike, ddx: ArrayLike, dt: float, g: float, h: float, k: float
    ) -> None: ...
    def update(
        self, z: ArrayLike, g: float | None = ..., h: float | None = ..., k: float | None = ...
    ) -> tuple[Any, Any, Any]: ...
    def batch_filter(
        self,
        data: Any,
        save_predictions: bool = ...,
        saver: Saver | None = ...,
        g: ArrayLike | None = ...,
        h: ArrayLike | None = ...,
        k: ArrayLike | None = ...,
    ) -> Any: ...
    def VRF_prediction(self) -> float: ...
    def VRF(self) -> tuple[float, float, float]: ...
    def bias_error(self, dddx: Any) -> Any: ...

class GHFilterOrder:
    x: NDArray[Any]
    dt: float
    order: int
    g: float
    h: float | None
    k: float | None
    y: Any
    z: Any
    def __init__(
        self, x0: ArrayLike, dt: float, order: int, g: float, h: float | None = ..., k: float | None = ...
    ) -> None: ...
    def update(
        self, z: ArrayLike, g: float | None = ..., h: float | None = ..., k: float | None = ...
    ) -> None: ...

def optimal_noise_smoothing(g: float) -> tuple[float, float, float]: ...
def least_squares_parameters(n: int) -> tuple[float, float]: ...
def critical_damping_parameters(theta: float, order: int = ...) -> tuple[float, ...]: ...
def benedict_bordner_constants(g: float, critical: bool = ...) -> tuple[float, float]: ...
def benedict_bornder_constants(g: float, critical: bool = ...) -> tuple[float, float]: ...
