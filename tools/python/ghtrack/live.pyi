from collections.abc import Iterable, Mapping
from typing import Any

from numpy.typing import ArrayLike

from ghtrack.table import Table

__all__ = ["Tracker"]

class Tracker:
    def __init__(self, config: str | Mapping[str, Any] | None = ..., period: float | None = ...) -> None: ...
    def step(
        self, t: float, xy: ArrayLike, covariance: ArrayLike | None = ..., labels: Iterable[object] = ...
    ) -> Table: ...
    @property
    def tracks(self) -> Table: ...
