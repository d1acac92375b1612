from typing import Any

from numpy.typing import NDArray

__all__ = ["LeastSquaresFilter"]

class LeastSquaresFilter:
    dt: float
    sigma: float
    n: int
    x: NDArray[Any]
    K: NDArray[Any]
    y: float
    def __init__(self, dt: float, order: int, noise_sigma: float = ...) -> None: ...
    def reset(self) -> None: ...
    def update(self, z: float) -> NDArray[Any]: ...
    def errors(self) -> tuple[NDArray[Any], NDArray[Any]]: ...
