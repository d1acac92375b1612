import os
import pathlib
from collections.abc import Mapping, Sequence
from typing import Any

from ghtrack.table import Table

__all__ = [
    "Comparison",
    "Page",
    "Picture",
    "Run",
    "Scene",
    "Tuning",
    "compare",
    "gains",
    "load_scene",
    "plot",
    "render",
    "run",
    "score",
    "track",
    "tune",
    "view",
]

_Source = str | os.PathLike[str] | Mapping[str, Any] | "Scene"

class Scene:
    text: str
    name: str
    def __init__(self, text: str, name: str = ..., folder: str | os.PathLike[str] | None = ...) -> None: ...

class Run:
    scene: Scene
    summary: str
    def __init__(
        self,
        scene: Scene,
        options: dict[str, Any],
        summary: str,
        contents: dict[str, Any],
        folder: pathlib.Path | None = ...,
        keeper: Any = ...,
    ) -> None: ...
    @property
    def folder(self) -> pathlib.Path: ...
    @property
    def truth(self) -> Table: ...
    @property
    def detections(self) -> Table: ...
    @property
    def origins(self) -> Table: ...
    @property
    def tracks(self) -> Table: ...
    @property
    def series(self) -> Table: ...
    @property
    def metrics(self) -> dict[str, Any]: ...
    def render(self, path: str | os.PathLike[str] | None = ..., **options: Any) -> Picture: ...
    def plot(self, path: str | os.PathLike[str] | None = ..., **options: Any) -> Picture: ...
    def view(self, path: str | os.PathLike[str] | None = ...) -> Page: ...

class Picture:
    path: pathlib.Path
    def __init__(self, path: str | os.PathLike[str], keeper: Any = ...) -> None: ...
    @property
    def data(self) -> bytes: ...

class Page:
    path: pathlib.Path
    def __init__(self, path: str | os.PathLike[str], keeper: Any = ...) -> None: ...

class Comparison:
    folder: pathlib.Path
    summary: str
    report: pathlib.Path
    def __init__(self, folder: str | os.PathLike[str], summary: str, keeper: Any) -> None: ...
    @property
    def table(self) -> Table: ...

class Tuning(dict[str, Any]):
    folder: pathlib.Path
    summary: str
    report: pathlib.Path
    def __init__(self, folder: str | os.PathLike[str], summary: str, keeper: Any) -> None: ...

def load_scene(source: _Source) -> Scene: ...
def run(
    scene: _Source,
    filters: Mapping[str, Any] | None = ...,
    seed: int | None = ...,
    duration: float | None = ...,
    set: Mapping[str, Any] | None = ...,
    folder: str | os.PathLike[str] | None = ...,
) -> Run: ...
def render(run_or_scene: Run | _Source, path: str | os.PathLike[str] | None = ..., **options: Any) -> Picture: ...
def plot(source: Any, path: str | os.PathLike[str] | None = ..., **options: Any) -> Picture: ...
def view(run_or_scene: Run | _Source, path: str | os.PathLike[str] | None = ..., **options: Any) -> Page: ...
def gains(rule: str, **options: Any) -> dict[str, Any]: ...
def track(detections: Any, config: str | os.PathLike[str] | Mapping[str, Any] | None = ..., **options: Any) -> Table: ...
def score(truth: Any, tracks: Any, **options: Any) -> dict[str, Any]: ...
def compare(
    scenes: _Source | Sequence[_Source],
    filters: Mapping[str, Any] | None = ...,
    folder: str | os.PathLike[str] | None = ...,
    **options: Any,
) -> Comparison: ...
def tune(scene: _Source, folder: str | os.PathLike[str] | None = ..., **options: Any) -> Tuning: ...
