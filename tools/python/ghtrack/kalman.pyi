from collections.abc import Sequence
from typing import Any

from numpy.typing import ArrayLike, NDArray

from ghtrack.common import Saver

__all__ = ["FixedLagSmoother", "KalmanFilter", "batch_filter", "predict", "update"]

def predict(
    x: Any, P: Any, F: ArrayLike = ..., Q: ArrayLike = ..., u: ArrayLike = ..., B: ArrayLike = ..., alpha: float = ...
) -> tuple[Any, Any]: ...
def update(
    x: Any, P: Any, z: ArrayLike | None, R: ArrayLike, H: ArrayLike | None = ..., return_all: bool = ...
) -> tuple[Any, ...]: ...

def batch_filter(
    x: Any,
    P: Any,
    zs: Sequence[Any],
    Fs: Sequence[Any],
    Qs: Sequence[Any],
    Hs: Sequence[Any],
    Rs: Sequence[Any],
    Bs: Sequence[Any] | None = ...,
    us: Sequence[Any] | None = ...,
    update_first: bool = ...,
) -> tuple[NDArray[Any], ...]: ...

class KalmanFilter:
    dim_x: int
    dim_z: int
    dim_u: int
    x: NDArray[Any]
    P: NDArray[Any]
    Q: NDArray[Any]
    F: NDArray[Any]
    H: NDArray[Any]
    R: NDArray[Any]
    B: NDArray[Any] | None
    z: Any
    y: NDArray[Any]
    K: NDArray[Any]
    S: NDArray[Any]
    x_prior: NDArray[Any]
    P_prior: NDArray[Any]
    log_likelihood: float
    def __init__(self, dim_x: int, dim_z: int, dim_u: int = ...) -> None: ...
    def predict(self, u: ArrayLike | None = ..., F: ArrayLike | None = ..., Q: ArrayLike | None = ...) -> None: ...
    def update(self, z: ArrayLike | None, R: ArrayLike | None = ..., H: ArrayLike | None = ...) -> None: ...
    def batch_filter(
        self, zs: Sequence[Any], update_first: bool = ..., saver: Saver | None = ...
    ) -> tuple[NDArray[Any], ...]: ...
    @property
    def mahalanobis(self) -> float: ...
    @property
    def likelihood(self) -> float: ...
    def rts_smoother(
        self, Xs: NDArray[Any], Ps: NDArray[Any], Fs: Sequence[Any] | None = ..., Qs: Sequence[Any] | None = ...
    ) -> tuple[NDArray[Any], NDArray[Any], NDArray[Any], NDArray[Any]]: ...

class FixedLagSmoother:
    dim_x: int
    dim_z: int
    N: int | None
    x: NDArray[Any]
    P: NDArray[Any]
    Q: NDArray[Any]
    F: NDArray[Any]
    H: NDArray[Any]
    R: NDArray[Any]
    K: NDArray[Any]
    y: NDArray[Any]
    S: NDArray[Any]
    B: Any
    count: int
    xSmooth: list[NDArray[Any]]
    def __init__(self, dim_x: int, dim_z: int, N: int | None = ...) -> None: ...
    def smooth(self, z: ArrayLike, u: ArrayLike | None = ...) -> None: ...
    def smooth_batch(
        self, zs: Sequence[Any], N: int, us: Sequence[Any] | None = ...
    ) -> tuple[NDArray[Any], NDArray[Any]]: ...
