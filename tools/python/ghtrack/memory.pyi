from typing import Any

from numpy.typing import ArrayLike, NDArray

__all__ = ["FadingMemoryFilter"]

class FadingMemoryFilter:
    x: NDArray[Any]
    dt: float
    order: int
    beta: float
    P: NDArray[Any]
    e: NDArray[Any]
    def __init__(self, x0: ArrayLike, dt: float, order: int, beta: float) -> None: ...
    def update(self, z: ArrayLike) -> None: ...
