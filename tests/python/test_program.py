"""Scenes, runs and tracks in Python are those of the program."""

import json
import pathlib
import subprocess
import sys

import numpy as np
import pytest
from numpy.testing import assert_array_equal

import ghtrack
from ghtrack import _program

SCENES = pathlib.Path(__file__).parents[2] / "scenes"

SMALL = {
    "name": "one throw",
    "duration": 2,
    "world": {"ground": {"height": 0}},
    "targets": [{"name": "fly ball", "ball": {"type": "baseball", "position": [0, 1], "velocity": [20, 15]}}],
    "sensors": [{"name": "camera", "rate": 30, "noise": 0.5, "detection_probability": 0.9}],
    "tracker": {"filters": {"ball": {"ghk": {"design": "tracking-index", "process_noise": 10}}}},
}


def program(*arguments, folder=None):
    command = [_program.executable(), *map(str, arguments)]
    return subprocess.run(command, cwd=folder, check=True, capture_output=True, text=True)


# Property: a run has the bytes of the program's.
def test_a_run_is_the_programs(tmp_path):
    scene = SCENES / "throwing.yaml"
    program("run", scene, "--no-video", "--seed", 5, "--duration", 2, "-o", tmp_path / "theirs")
    run = ghtrack.run(scene, seed=5, duration=2, folder=tmp_path / "ours")
    for name in ("truth.csv", "detections.csv", "origins.csv", "tracks.csv", "metrics.json"):
        assert (tmp_path / "ours" / name).read_bytes() == (tmp_path / "theirs" / name).read_bytes()
    assert run.truth.x.dtype == float and len(run.truth) > 100
    assert set(run.tracks.status) <= {"tentative", "confirmed", "coasting"}
    again = ghtrack.Table.from_csv(run.tracks.to_csv())
    for name in run.tracks.columns:
        assert_array_equal(again[name], run.tracks[name])
    assert run.metrics["total"]["gospa"] is not None
    assert "RMSE" in run._repr_html_()


# Property: a run in this process has the bits of the program's files, and the same columns.
@pytest.mark.parametrize("scene", ["three_regimes.yaml", "sensors/crossing.yaml"])
def test_a_run_here_is_the_programs(tmp_path, scene):
    here = ghtrack.run(SCENES / scene, seed=5, duration=3)
    program("run", SCENES / scene, "--no-video", "--seed", 5, "--duration", 3, "-o", tmp_path / "run")
    for name in ("truth", "detections", "origins", "tracks"):
        theirs = ghtrack.Table.from_csv((tmp_path / "run" / f"{name}.csv").read_text())
        ours = getattr(here, name)
        assert ours.columns == theirs.columns
        for column in theirs.columns:
            assert_array_equal(ours[column], theirs[column], err_msg=f"{name} {column}")
    assert here.metrics == json.loads((tmp_path / "run" / "metrics.json").read_text())
    assert (here.folder / "tracks.csv").read_bytes() == (tmp_path / "run" / "tracks.csv").read_bytes()
    assert here.truth.x.base is not None  # it shares the memory of the run
    assert here.plot(panels="path")._repr_png_().startswith(b"\x89PNG")


# Property: a series reads its file as `ghtrack filter` does, from wherever the scene is.
def test_a_series_names_a_file(tmp_path):
    rows = "\n".join(f"{k // 2},{5 * (k % 2)};{3 + k},25" for k in range(20))
    (tmp_path / "height.txt").write_text("Time (s);Height (m)\n" + rows + "\n")
    scene = {
        "kind": "series",
        "name": "height",
        "given": {"file": str(tmp_path / "height.txt")},
        "filters": [{"name": "a", "x0": 3, "dx0": 2, "g": 0.4, "h": 0.1}],
    }
    run = ghtrack.run(scene)
    assert_array_equal(run.series.t, 0.5 * np.arange(20))
    assert run.series.z[3] == 6.25
    assert run.plot()._repr_png_().startswith(b"\x89PNG")


# Property: path, text and dict say the same.
def test_a_scene_is_a_path_a_text_or_a_dict(tmp_path):
    file = tmp_path / "scene.yaml"
    file.write_text(json.dumps(SMALL))
    runs = [ghtrack.run(source) for source in (file, str(file), json.dumps(SMALL, indent=1), SMALL)]
    for run in runs[1:]:
        assert_array_equal(run.tracks.x, runs[0].tracks.x)
    changed = ghtrack.run(SMALL, filters={"ball": {"gh": {"g": 0.4, "h": 0.1}}}, set={"sensors[0].noise": 0.1})
    assert set(changed.tracks.filter) == {"gh"}
    assert changed.metrics["total"]["raw"] < runs[0].metrics["total"]["raw"]


# Property: what is wrong raises an exception with the program's located words.
@pytest.mark.parametrize(
    "call, words",
    [
        (lambda: ghtrack.load_scene({**SMALL, "duratoin": 3}), "did you mean 'duration'"),
        (lambda: ghtrack.run(SMALL, set={"sensors[0].noise": -1}), "noise"),
        (lambda: ghtrack.run(SMALL, seed=-1), "seed"),
        (lambda: ghtrack.run("no such file.yaml"), "no such file.yaml"),
        (lambda: ghtrack.gains("benedict-bordner"), "--g"),
        (lambda: ghtrack.gains("benedict"), "benedict-bordner"),
        (lambda: ghtrack.track([[1.0, 2.0]]), "t, x, y"),
        (lambda: ghtrack.track([[0.0, 1.0, 2.0]], config={"nose": 1}), "noise"),
        (lambda: ghtrack.Tracker({"nose": 1}, period=1), "noise"),
        (lambda: ghtrack.Tracker(), "period"),
    ],
)
def test_what_is_wrong_raises_with_the_words_of_the_program(call, words):
    with pytest.raises(ghtrack.InputError, match=words):
        call()
    assert issubclass(ghtrack.InputError, ValueError)


def test_surroundings_that_fail_raise_another_exception(tmp_path):
    blocked = tmp_path / "file"
    blocked.write_text("")
    with pytest.raises(ghtrack.EnvironmentFailure):
        ghtrack.run(SMALL, folder=blocked / "run")


def crossing(seed=1):
    """Rows t, x, y of two objects with unit noise."""
    random = np.random.default_rng(seed)
    rows = []
    for k in range(40):
        for x, y in ((3.0 * k, 0.0), (120.0 - 3.0 * k, 30.0)):
            rows.append((0.5 * k, x + random.normal(), y + random.normal()))
    return np.array(rows)


CONFIG = {"noise": 1.0, "period": 0.5, "tracker": {"filters": {"default": {"kalman-cv": {}}}}}


# Property: array, dict and table are one; live tracking has the bits of the file's.
def test_tracks_are_the_same_however_detections_come(tmp_path):
    rows = crossing()
    columns = dict(zip("txy", rows.T))
    tracks = ghtrack.track(rows, config=CONFIG)
    assert_array_equal(ghtrack.track(columns, config=CONFIG).x, tracks.x)
    file = tmp_path / "detections.csv"
    file.write_text(ghtrack.Table(columns).to_csv())
    assert_array_equal(ghtrack.track(file, config=CONFIG).x, tracks.x)

    tracker = ghtrack.Tracker(CONFIG)
    for t in np.unique(rows[:, 0]):
        now = tracker.step(t, rows[rows[:, 0] == t, 1:])
        theirs = tracks[tracks.t == t]
        for name in ("track_id", "x", "y", "vx", "vy", "sigma_x", "rx"):
            assert_array_equal(now[name], theirs[name])
        assert list(now.status) == list(theirs.status)
    with pytest.raises(ghtrack.InputError):
        tracker.step(0.0, [])


# Property: a DataFrame says what an array of its rows says, in any order of rows, with times of any
# of pandas' kinds, missing entries and columns that the tracker does not know.
def test_data_frames_come_and_go():
    pandas = pytest.importorskip("pandas")
    rows = crossing()
    frame = pandas.DataFrame(rows, columns=["t", "x", "y"])
    tracks = ghtrack.track(rows, config=CONFIG)
    for like in (
        frame,
        frame.sample(frac=1, random_state=1),
        frame.assign(note="seen"),
        frame.rename(columns={"t": "time (s)", "x": "x (m)", "y": "y (m)"}),
        frame.assign(t=pandas.to_timedelta(frame.t, unit="s")),
        frame.assign(t=pandas.to_datetime(frame.t, unit="s")),
        frame.assign(t=pandas.to_datetime(frame.t, unit="s", utc=True).dt.tz_convert("Asia/Kolkata")),
        frame.astype({"x": "Float64"}),
        frame.set_index(pandas.Index(range(500, 500 + len(frame)))),
    ):
        assert_array_equal(ghtrack.track(like, config=CONFIG).x, tracks.x)
    rows[30, 1] = np.nan
    missed = frame.assign(x=frame.x.where(frame.index != 30))
    for like in (missed, missed.convert_dtypes(), missed.astype(object)):
        assert_array_equal(ghtrack.track(like, config=CONFIG).x, ghtrack.track(rows, config=CONFIG).x)
    back = tracks.to_pandas()
    assert list(back) == tracks.columns and back.track_id.dtype == np.int64
    assert_array_equal(ghtrack.Table.from_csv(back.to_csv(index=False)).x, tracks.x)


def test_scores_of_tables():
    rows = crossing()
    truth = ghtrack.Table(
        {
            "t": rows[:, 0],
            "truth_id": np.tile([1, 2], len(rows) // 2),
            "x": np.ravel([[3.0 * k, 120.0 - 3.0 * k] for k in range(40)]),
            "y": np.tile([0.0, 30.0], len(rows) // 2),
        }
    )
    perfect = ghtrack.Table({**{name: truth[name] for name in ("t", "x", "y")}, "track_id": truth.truth_id})
    result = ghtrack.score(truth, perfect, gospa_c=5)
    assert result["gospa"] == 0.0 and result["mota"] == 1.0
    assert ghtrack.score(truth, ghtrack.track(rows, config=CONFIG), gospa_c=5)["gospa"] > 0.0


def test_gains_compare_and_tune():
    assert ghtrack.gains("benedict-bordner", g=0.4)["h"] == pytest.approx(0.1)
    filters = {"slow": {"gh": {"g": 0.1, "h": 0.01}}, "quick": {"gh": {"g": 0.8, "h": 0.3}}}
    comparison = ghtrack.compare(SMALL, filters=filters, runs=2, jobs=1)
    assert set(comparison.table.filter) >= {"slow", "quick"}
    assert comparison.report.stat().st_size > 1000
    assert comparison._repr_html_().startswith("<iframe")
    tuning = ghtrack.tune(SMALL, runs=1, filter="gh", jobs=1)
    assert tuning and json.loads((tuning.folder / "tuning.json").read_text()) == tuning
    assert tuning._repr_html_().startswith("<iframe") and "gh" in repr(tuning)


def test_pictures_are_shown_by_jupyter(tmp_path):
    picture = ghtrack.render(ghtrack.run(SMALL), size="320x180", from_=1, to=1)
    assert picture._repr_png_().startswith(b"\x89PNG") and picture._repr_html_() is None
    assert tmp_path and picture.path.exists()


# Property: the page of a run is the program's, byte for byte, and Jupyter shows it in a frame.
def test_pages_are_shown_by_jupyter(tmp_path):
    try:
        page = ghtrack.run(SMALL, seed=3).view()
    except ghtrack.EnvironmentFailure as failure:
        pytest.skip(str(failure))  # no compiler for WebAssembly was there
    scene = tmp_path / "one_throw.yaml"
    scene.write_text(json.dumps(SMALL, indent=1))
    program("view", scene.name, "--seed", 3, "--no-open", "-o", "theirs.html", folder=tmp_path)
    assert page.path.read_bytes() == (tmp_path / "theirs.html").read_bytes()
    assert page._repr_html_().startswith("<iframe srcdoc=")
    assert ghtrack.view(SMALL, tmp_path / "ours.html", duration=1).path.stat().st_size > 100_000


# Property: importing costs next to nothing and brings no heavy library; measured in modules, not time.
def test_importing_loads_neither_numpy_nor_the_program():
    code = "import ghtrack, sys; print([m for m in sys.modules if m.split('.')[0] in ('numpy', 'subprocess')])"
    assert subprocess.run([sys.executable, "-c", code], check=True, capture_output=True, text=True).stdout == "[]\n"
    maps = "import ghtrack.live; print(open('/proc/self/maps').read())"
    text = subprocess.run([sys.executable, "-c", maps], check=True, capture_output=True, text=True).stdout
    assert "opencv" not in text
    assert "box2d" not in text or "libasan" in text or "libtsan" in text  # unoptimised code keeps what it does not use


# Property: threads and forks work side by side.
def test_threads_and_forks():
    import concurrent.futures
    import multiprocessing

    rows = crossing()
    alone = ghtrack.track(rows, config=CONFIG).x
    with concurrent.futures.ThreadPoolExecutor(4) as pool:
        for tracks in pool.map(lambda _: ghtrack.track(rows, config=CONFIG), range(4)):
            assert_array_equal(tracks.x, alone)
    with multiprocessing.get_context("fork").Pool(2) as pool:
        for x in pool.map(live_positions, [0, 1]):
            assert_array_equal(x, live_positions(0))


def live_positions(_):
    tracker = ghtrack.Tracker(CONFIG)
    rows = crossing()
    return np.concatenate([tracker.step(t, rows[rows[:, 0] == t, 1:]).x for t in np.unique(rows[:, 0])])
