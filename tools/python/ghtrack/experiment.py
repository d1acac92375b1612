"""Scenes, runs, tracking, scores and comparisons: what the program does, as Python values."""

import contextlib
import html
import json
import os
import pathlib
import tempfile

import numpy as np

from ghtrack._program import InputError, as_yaml, call, option_list
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


class Scene:
    """The text of a scene file, which has been checked."""

    def __init__(self, text, name="scene", folder=None):
        self.text, self.name = text, name
        # A scene may name files beside it; one that was read from a file stays in its place.
        self._file = pathlib.Path(folder) / name if folder else None
        self._document = name if folder else f"{name}.yaml"
        with self._as_file() as path:
            call("--quiet", "check", path)

    def _as_file(self):
        return _kept(self._file) if self._file else _written(self.text, self._document)

    def __repr__(self):
        return f"<Scene {self.name!r}>"


@contextlib.contextmanager
def _written(text, name):
    """A text as a file for a while."""
    with tempfile.TemporaryDirectory(prefix="ghtrack-") as folder:
        path = pathlib.Path(folder) / name
        path.write_text(text, encoding="utf-8")
        yield path


def _kept(path):
    """A file that is there, and stays."""
    return contextlib.nullcontext(path)


def _place(path, name):
    """Where a result goes: the path that was given, or a folder of its own and what keeps it."""
    if path:
        return pathlib.Path(path), None
    keeper = tempfile.TemporaryDirectory(prefix="ghtrack-")
    return pathlib.Path(keeper.name) / name, keeper


def load_scene(source):
    """A scene from a path, from YAML text, or from a dict of the same shape.

    Raises InputError that names line, column and key of everything that is wrong.
    """
    if isinstance(source, Scene):
        return source
    if isinstance(source, dict):
        given = source.get("given")
        if isinstance(given, dict) and "file" in given:  # its place is counted from here
            source = {**source, "given": {**given, "file": os.path.abspath(given["file"])}}
        return Scene(json.dumps(source, indent=1), _file_name(source.get("name", "scene")))
    if isinstance(source, os.PathLike) or "\n" not in source:
        path = pathlib.Path(source)
        try:
            text = path.read_text(encoding="utf-8")
        except OSError as error:
            raise InputError(f"{path}: {error.strerror}") from error
        return Scene(text, path.name, path.resolve().parent)
    return Scene(source)


def _file_name(name):
    return "".join(letter if letter.isalnum() or letter in "-_" else "_" for letter in str(name)) or "scene"


def _file_property(name, parse):
    """A property that reads a file of the object's folder when it is first asked for."""

    def value(self):
        if name not in self._contents:
            self._contents[name] = parse((self.folder / name).read_text(encoding="utf-8"))
        return self._contents[name]

    return property(value, doc=f"The content of {name}.")


# The columns of a run's tables, in the order of the files.
_COLUMNS = {
    "truth": ("t", "truth_id", "name", "kind", "x", "y", "vx", "vy", "ax", "ay"),
    "detections": ("t", "sensor", "class", "x", "y"),
    "origins": ("t", "sensor", "x", "y", "truth_id"),
    "tracks": (
        *("t", "track_id", "status", "filter", "x", "y", "vx", "vy", "ax", "ay", "x_pred", "y_pred"),
        *("rx", "ry", "sigma_x", "sigma_y", "existence"),
    ),
}


def _tables(columns):
    """The tables of a run that this process has made, which share its memory."""
    columns["origins"] = columns["detections"]
    tables = {}
    for table, names in _COLUMNS.items():
        found = columns[table]
        tables[f"{table}.csv"] = Table({name: _column(found[name]) for name in names if name in found})
    return tables


def _column(values):
    """Numbers as they are; of words the numbers and all of them are given."""
    if not isinstance(values, tuple):
        return values
    numbers, words = values
    return np.array([*words, ""], dtype=object)[numbers]


class Run:
    """A run of a scene: tables and metrics.

    Attributes
    ----------
    truth, detections, origins, tracks : tables of numpy arrays; a series scene has series instead
    metrics : dict, the content of metrics.json
    summary : the table that the program prints
    folder : the same as files, which are written when they are first asked for; a folder of its own
        goes when the run does
    """

    def __init__(self, scene, options, summary, contents, folder=None, keeper=None):
        self.scene, self.summary = scene, summary
        self._options, self._contents = options, contents
        self._folder, self._keeper = folder, keeper

    @property
    def folder(self):
        if self._folder is None:
            self._folder, self._keeper = _place(None, "run")
            _run_program(self.scene, self._folder, self._options)
        return self._folder

    truth = _file_property("truth.csv", Table.from_csv)
    detections = _file_property("detections.csv", Table.from_csv)
    origins = _file_property("origins.csv", Table.from_csv)
    tracks = _file_property("tracks.csv", Table.from_csv)
    series = _file_property("series.csv", Table.from_csv)
    metrics = _file_property("metrics.json", json.loads)

    def render(self, path=None, **options):
        """The annotated video or picture of this run; see render()."""
        return render(self, path, **options)

    def plot(self, path=None, **options):
        """Tracks or filtered series over time, with residuals and errors; see plot()."""
        return plot(self, path, **options)

    def view(self, path=None):
        """The page on which this run can be played with; see view()."""
        return view(self, path)

    def __repr__(self):
        return f"<Run of {self.scene.name!r}>\n{self.summary}"

    def _repr_html_(self):
        return f"<pre>{html.escape(self.summary)}</pre>"


def _run_program(scene, folder, options):
    with scene._as_file() as path:
        return call("--quiet", "run", path, "--no-video", "-o", folder, *option_list(options))


def run(scene, filters=None, seed=None, duration=None, set=None, folder=None):
    """Simulates, senses, tracks and scores a scene, with the bits of the program.

    Parameters
    ----------
    scene : path, text, dict or Scene
    filters : filter by class, such as {"ball": {"gh": {"g": 0.4, "h": 0.1}}}
    seed, duration : instead of the scene's [s]
    set : other keys of the scene to change, such as {"sensors[0].noise": 0.5}
    folder : where to keep the files of the run; without it none are written

    Returns a Run.
    """
    scene = load_scene(scene)
    changes = dict(set or {})
    for label, config in (filters or {}).items():
        changes[f"tracker.filters.{label}"] = config
    options = {"seed": seed, "duration": duration, "set": changes}
    if folder is None:
        done = _run_here(scene, options)
        if done is not None:
            summary, metrics = done.pop("summary"), json.loads(done.pop("metrics"))
            return Run(scene, options, summary, {**_tables(done), "metrics.json": metrics})
    folder, keeper = _place(folder, "run")
    return Run(scene, options, _run_program(scene, folder, options), {}, folder, keeper)


def _run_here(scene, options):
    """The run of a scene with objects in this process; None for a series."""
    from ghtrack import _world

    changes = [f"{key}={as_yaml(value)}" for key, value in options["set"].items()]
    changes += [f"--{key}={options[key]}" for key in ("seed", "duration") if options[key] is not None]
    try:
        return _world.run(scene.text, scene._document, changes)
    except _world.SceneError as error:
        raise InputError(str(error)) from error


class Picture:
    """A video or a picture that Jupyter shows."""

    _VIDEOS = {".mp4": "video/mp4", ".webm": "video/webm"}

    def __init__(self, path, keeper=None):
        self.path, self._keeper = pathlib.Path(path), keeper

    @property
    def data(self):
        """The bytes of the file."""
        return self.path.read_bytes()

    def _repr_png_(self):
        return self.data if self.path.suffix == ".png" else None

    def _repr_html_(self):
        import base64

        if self.path.suffix == ".svg":
            return self.path.read_text(encoding="utf-8")
        kind = self._VIDEOS.get(self.path.suffix)
        content = base64.b64encode(self.data).decode() if kind or self.path.suffix == ".gif" else None
        if kind:
            return f'<video controls src="data:{kind};base64,{content}"></video>'
        return f'<img src="data:image/gif;base64,{content}">' if content else None

    def __repr__(self):
        return f"<Picture {self.path.name}, {self.path.stat().st_size} bytes>"


def _scene_and_options(run_or_scene):
    """A scene, and the options that a run of it had."""
    if isinstance(run_or_scene, Run):
        return run_or_scene.scene, run_or_scene._options
    return load_scene(run_or_scene), {}


def render(run_or_scene, path=None, **options):
    """The annotated video of a run or scene, as `ghtrack video` makes it.

    Parameters
    ----------
    path : file that ends in mp4, webm, avi, mkv, gif or png; without it a picture of the end,
        which goes when the returned value does
    options : those of the command, such as size="640x360", to=2, compare=True

    Returns a Picture.
    """
    scene, base = _scene_and_options(run_or_scene)
    path, keeper = _place(path, "picture.png")
    with scene._as_file() as file:
        call("--quiet", "video", file, "-o", path, *option_list({**base, **options}))
    return Picture(path, keeper)


def plot(source, path=None, **options):
    """Tracks or a filtered series as a figure, as `ghtrack plot` draws it.

    Parameters
    ----------
    source : Run, path of a run's folder, of tracks or of a series, or a Table of these
    path : file that ends in svg, pdf or png; without it a PNG that goes when the returned value does
    options : those of the command, such as panels="path,x,y", truth=path, size="column", dark=True

    Returns a Picture.
    """
    path, keeper = _place(path, "plot.png")
    if isinstance(source, Run):
        source = source.folder
    with _input(source, ("t", "x", "y")) as given:
        call("plot", given, "-o", path, *option_list(options))
    return Picture(path, keeper)


class Page:
    """A web page that Jupyter shows; path is that of its file."""

    def __init__(self, path, keeper=None):
        self.path, self._keeper = pathlib.Path(path), keeper

    def _repr_html_(self):
        page = html.escape(self.path.read_text(encoding="utf-8"))
        return f'<iframe srcdoc="{page}" style="width:100%;height:48em;border:0"></iframe>'

    def __repr__(self):
        return f"<Page {self.path.name}, {self.path.stat().st_size} bytes>"


def view(run_or_scene, path=None, **options):
    """The page on which a run or scene can be played with, as `ghtrack view` makes it.

    Parameters
    ----------
    path : HTML file; without it one that goes when the returned value does
    options : those of the command, such as seed=3, duration=10

    Returns a Page.
    """
    scene, base = _scene_and_options(run_or_scene)
    path, keeper = _place(path, "page.html")
    words = option_list({**base, **options})
    with scene._as_file() as file:  # the page names it
        call("--quiet", "view", file.name, "--no-open", "-o", path.absolute(), *words, folder=file.parent)
    return Page(path, keeper)


def gains(rule, **options):
    """Gains by a rule and what they do: the JSON of `ghtrack gains` as a dict.

    gains("benedict-bordner", g=0.4), gains("tracking-index", process_noise=5, noise=0.5, dt=0.05),
    gains("manual", g=0.5, h=0.2, k=0.02)
    """
    return json.loads(call("gains", rule, "--json", *option_list(options)))


def _as_table(data, names):
    """A table from an array of these columns, a DataFrame, a dict or a Table."""
    if isinstance(data, Table):
        return data
    if hasattr(data, "columns") or isinstance(data, dict):
        return Table({str(name): _plain(data[name]) for name in data})
    array = np.asarray(data, dtype=float)
    if array.ndim != 2 or array.shape[1] > len(names) or array.shape[1] < 3:
        raise InputError(f"an array needs a row for each detection: {', '.join(names)}")
    return Table(dict(zip(names, array.T)))


def _plain(column):
    """A column as files have it: durations in seconds, dates in UTC."""
    array = np.asarray(column)
    if array.dtype.kind == "m":
        return array / np.timedelta64(1, "s")
    if array.dtype.kind == "M":
        return np.datetime_as_string(array, timezone="UTC")
    return array


def _input(data, names):
    """The path of a file, or of one that has the data for a while."""
    if isinstance(data, (str, os.PathLike)):
        return _kept(data)
    return _written(_as_table(data, names).to_csv(), "table.csv")


def track(detections, config=None, **options):
    """Runs the tracker over detections.

    Parameters
    ----------
    detections : path, DataFrame, Table, dict of columns, or array of rows t, x, y
    config : path, text or dict, as the file of `ghtrack track --config`
    options : those of the command

    Returns the tracks, a Table with the columns of tracks.csv.
    """
    with contextlib.ExitStack() as files:
        path = files.enter_context(_input(detections, ("t", "x", "y")))
        if isinstance(config, dict):
            config = json.dumps(config, indent=1)
        if isinstance(config, str) and "\n" in config:
            config = files.enter_context(_written(config, "config.yaml"))
        return Table.from_csv(call("track", path, *option_list({"config": config, **options})))


def score(truth, tracks, **options):
    """Scores tracks against the truth: the JSON of `ghtrack score` as a dict.

    truth and tracks are paths or tables (t, truth_id, x, y and t, track_id, x, y); options are
    those of the command, such as gospa_c=3, match_distance=2.
    """
    with _input(truth, ("t", "truth_id", "x", "y")) as true, _input(
        tracks, ("t", "track_id", "x", "y")
    ) as tracked:
        return json.loads(
            call("score", "--truth", true, "--tracks", tracked, "--json", *option_list(options))
        )


class _Reported:
    """Results in a folder, with what the program prints of them and a page."""

    def __init__(self, folder, summary, keeper):
        self.folder, self.summary, self._keeper = pathlib.Path(folder), summary, keeper
        self.report = self.folder / "report.html"

    def __repr__(self):
        return self.summary

    def _repr_html_(self):
        return Page(self.report)._repr_html_()


class Comparison(_Reported):
    """The results of a comparison.

    Attributes
    ----------
    table : a row for each scene, object, filter and metric, as in comparison.csv
    report : path of the page, folder : of all files; a folder of its own goes when this does
    """

    def __init__(self, folder, summary, keeper):
        super().__init__(folder, summary, keeper)
        self._contents = {}

    table = _file_property("comparison.csv", Table.from_csv)


def compare(scenes, filters=None, folder=None, **options):
    """Compares filters over many runs, every filter on the same detections.

    Parameters
    ----------
    scenes : a path, text, dict or Scene, or a list of these
    filters : {name: filter}, instead of what the scenes name
    options : those of `ghtrack compare`, such as runs=20, seed=1, jobs=2

    Returns a Comparison.
    """
    several = isinstance(scenes, (list, tuple))
    loaded = [load_scene(scene) for scene in (scenes if several else [scenes])]
    folder, keeper = _place(folder, "comparison")
    with contextlib.ExitStack() as files:
        paths = [files.enter_context(scene._as_file()) for scene in loaded]
        if filters:
            text = json.dumps({"filters": filters})
            options["filters"] = files.enter_context(_written(text, "filters.yaml"))
        summary = call("--quiet", "compare", *paths, "-o", folder, *option_list(options))
    return Comparison(folder, summary, keeper)


class Tuning(_Reported, dict):
    """The content of tuning.json.

    Attributes
    ----------
    report : path of the page, folder : of all files, among them gains.yaml, the winners as a piece of
        a scene; a folder of its own goes when this does
    summary : the table that the program prints
    """

    def __init__(self, folder, summary, keeper):
        _Reported.__init__(self, folder, summary, keeper)
        dict.__init__(self, json.loads((self.folder / "tuning.json").read_text(encoding="utf-8")))


def tune(scene, folder=None, **options):
    """The best gains for each regime of a scene.

    Parameters
    ----------
    scene : path, text, dict or Scene
    folder : where to keep the files
    options : those of `ghtrack tune`, such as runs=20, filter="gh"

    Returns a Tuning, which is a dict.
    """
    scene = load_scene(scene)
    folder, keeper = _place(folder, "tuning")
    with scene._as_file() as path:
        summary = call("--quiet", "tune", path, "-o", folder, *option_list(options))
    return Tuning(folder, summary, keeper)
