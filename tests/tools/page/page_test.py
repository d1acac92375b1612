"""page_test.py GHTRACK SCENES: the page of a scene in a browser against the program."""

import csv
import json
import re
import shlex
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[1] / "browser"))
from browser import Browser  # noqa: E402

PROGRAM, SCENES = sys.argv[1:3]

# The columns of tracks.csv, and the rows that the page has of one of its trackers.
ROWS = """
const [columns, which] = arguments;
const {tracks, scans} = lab.state.result.answers[which];
const words = lab.state.result.words;
// Of several scans at one instant the file has what was said after the last.
const isLast = (scan) => scan + 1 === scans.length || scans.get(scan + 1, "time") !== scans.get(scan, "time");
return Array.from({length: tracks.length}, (_, row) => row).filter((row) => isLast(tracks.get(row, "scan")))
  .map((row) => columns.map((name) => {
  const get = (field) => tracks.get(row, field);
  const value = name === "t" ? scans.get(get("scan"), "time") : name === "track_id" ? get("id")
    : name === "status" ? lab.statuses[get("status")] : name === "filter" ? words[get("filter")] : get(name);
  return Number.isNaN(value) ? "" : value;
}));"""

SLIDE = """
const slider = document.getElementById(arguments[0]);
slider.value = arguments[1];
slider.dispatchEvent(new Event("input", {bubbles: true}));"""

CHOOSE = """
const list = document.getElementById(arguments[0]);
list.value = arguments[1];
list.dispatchEvent(new Event("change", {bubbles: true}));"""

CLASS = """
for (const button of document.querySelectorAll("#lab-classes button"))
  if (button.textContent === arguments[0]) button.click();"""

SETTLED = "const done = arguments[0]; requestAnimationFrame(() => setTimeout(() => done(lab.state.metrics), 700));"


def program(*words, folder):
    return subprocess.run([PROGRAM, "--quiet", *words], cwd=folder, check=True, capture_output=True, text=True)


def page_of(scene, folder, *words):
    path = Path(folder) / "page.html"
    program("view", str(Path(SCENES) / scene), "-o", str(path), "--no-open", *words, folder=folder)
    return path


class Page(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = cls.enterClassContext(tempfile.TemporaryDirectory())
        cls.browser = cls.enterClassContext(Browser())
        cls.open("three_regimes.yaml")

    @classmethod
    def open(cls, scene, *words):
        cls.page = page_of(scene, cls.folder, *words)
        cls.browser.open(cls.page)
        cls.browser.driver.implicitly_wait(20)
        cls.browser.driver.find_element("css selector", "#lab-live:not([hidden])")
        cls.settle()

    @classmethod
    def settle(cls):
        return cls.browser.driver.execute_async_script(SETTLED)

    def text(self, name):
        return self.browser.run("return document.getElementById(arguments[0]).textContent", name)

    def expect_what_the_program_says(self, which=0):
        """Runs the command that the page shows, and compares every number of tracks.csv and metrics.json."""
        metrics = self.settle()[which]
        command = shlex.split(self.text("lab-command").splitlines()[which])
        self.assertEqual(command[0], "ghtrack")
        out = Path(self.folder) / "out"
        program(*command[1:], "--no-video", "-o", str(out), folder=self.folder)
        with open(out / "tracks.csv", encoding="utf-8") as file:
            columns, *rows = csv.reader(file)
        said = self.browser.run(ROWS, columns, which)
        words = {columns.index("status"), columns.index("filter")}
        wanted = [[cell if i in words or cell == "" else float(cell) for i, cell in enumerate(row)] for row in rows]
        self.assertEqual(len(said), len(wanted))
        self.assertEqual(said, wanted)  # all digits
        self.expect_metrics(json.loads(metrics), json.loads((out / "metrics.json").read_text(encoding="utf-8")))

    def expect_metrics(self, said, wanted, path=""):
        """What the page has is the program's: measured to the last digit, predicted to all but the last few.

        Predictions and their bounds go through sums that a machine with vectors adds up in another order.
        """
        if isinstance(wanted, dict):
            self.assertEqual(said.keys(), wanted.keys(), path)
            for key in wanted:
                # What hindsight would have done is not computed on the page.
                if key in ("best_fixed_gains", "crlb", "smoother"):
                    self.assertIsNone(said[key])
                    continue
                self.expect_metrics(said[key], wanted[key], f"{path}.{key}")
        elif isinstance(wanted, float) and re.search(r"\.(predicted|nees_bounds|nis_bounds)", path):
            self.assertAlmostEqual(said, wanted, delta=1e-9 * max(1, abs(wanted)), msg=path)
        elif isinstance(wanted, list):
            self.assertEqual(len(said), len(wanted), path)
            for i, value in enumerate(wanted):
                self.expect_metrics(said[i], value, f"{path}[{i}]")
        else:
            self.assertEqual(said, wanted, path)

    # Property: as it is opened, the page has what the program writes.
    def test_it_begins_with_what_the_program_writes(self):
        self.browser.run("document.getElementById('lab-reset').click()")
        self.expect_what_the_program_says()

    # Property: and so it stays, whatever is turned.
    def test_sliders_say_what_the_program_says(self):
        self.browser.run("document.getElementById('lab-reset').click()")
        for name, place in (("lab-filter-process_noise", 730), ("lab-sensor-0-noise", 610),
                            ("lab-sensor-0-detection_probability", 700), ("lab-sensor-0-clutter", 640),
                            ("lab-gate", 420)):
            self.browser.run(SLIDE, name, place)
        self.browser.run(CLASS, "balloon")
        self.browser.run(SLIDE, "lab-filter-g", 300)
        self.assertIn("tracker.filters.balloon=", self.text_after_settling("lab-command"))
        self.expect_what_the_program_says()

    def text_after_settling(self, name):
        self.settle()
        return self.text(name)

    # Property: what is beside a slider are words, whatever the filter.
    def test_labels_are_words(self):
        self.browser.run("document.getElementById('lab-reset').click()")
        kinds = self.browser.run("return [...document.getElementById('lab-kind').options].map((o) => o.value)")
        for kind in kinds:
            self.browser.run(CHOOSE, "lab-kind", kind)
            labels = self.browser.run("return [...document.querySelectorAll('#lab-controls label')].map((e) => e.textContent)")
            self.assertGreater(len(labels), 5)
            self.assertEqual([label for label in labels if "_" in label], [], kind)
        self.browser.run("document.getElementById('lab-reset').click()")

    # Property: the same for every kind of filter that a scene may ask for.
    def test_every_filter_says_what_the_program_says(self):
        kinds = self.browser.run("return [...document.getElementById('lab-kind').options].map((o) => o.value)")
        self.assertGreaterEqual(len(kinds), 8)
        for kind in kinds:
            with self.subTest(kind):
                self.browser.run("document.getElementById('lab-reset').click()")
                self.browser.run(CLASS, "ball")
                self.browser.run(CHOOSE, "lab-kind", kind)
                self.expect_what_the_program_says()

    # Property: the same for every association.
    def test_every_association_says_what_the_program_says(self):
        for association in ("nearest-greedy", "probabilistic", "multi-scan", "known"):
            with self.subTest(association):
                self.browser.run("document.getElementById('lab-reset').click()")
                self.browser.run(CHOOSE, "lab-association", association)
                self.expect_what_the_program_says()

    # Property: occlusion, several sensors, radar and late scans come out the same, too.
    def test_other_scenes_begin_with_what_the_program_writes(self):
        for scene in ("sensors/crossing.yaml", "sensors/late_radar.yaml", "sensors/radar_and_camera.yaml",
                      "sensors/manoeuvre.yaml", "sensors/heavy_tails.yaml"):
            with self.subTest(scene):
                self.open(scene)
                self.expect_what_the_program_says()
        self.open("three_regimes.yaml")

    # Property: two filters side by side are two runs on the same detections.
    def test_two_filters_are_two_runs(self):
        self.browser.run("document.getElementById('lab-reset').click()")
        self.browser.run(CHOOSE, "lab-compare", "copy")
        self.browser.run(CHOOSE, "lab-kind", "kalman-cv")
        self.expect_what_the_program_says(0)
        self.expect_what_the_program_says(1)
        self.assertEqual(self.browser.run("return document.getElementById('lab-views').dataset.count"), "2")

    # Property: a filter that is typed is read as a scene is, and a wrong one is refused in its words.
    def test_a_typed_filter_is_read_as_a_scene_is(self):
        self.browser.run("document.getElementById('lab-reset').click()")
        self.browser.run(CHOOSE, "lab-text", "{gh: {g: 0.4, h: 0.1}}")
        self.expect_what_the_program_says()
        self.browser.run(CHOOSE, "lab-text", "{gh: {g: 0.4, hh: 0.1}}")
        self.settle()
        self.assertIn("unknown key", self.text("lab-problem"))
        self.browser.run(CHOOSE, "lab-text", "{gh: {g: 1, h: 3}}")
        self.settle()
        self.assertIn("2g + h < 4", self.text("lab-problem"))
        self.browser.run("document.getElementById('lab-reset').click()")
        self.expect_what_the_program_says()

    # Property: keys play, step and seek; the description follows.
    def test_it_can_be_played_from_the_keyboard(self):
        body = self.browser.driver.find_element("css selector", "body")
        time = lambda: self.browser.run("return lab.state.time")
        body.send_keys("\ue011")  # home
        self.assertEqual(time(), 0)
        body.send_keys("...")
        self.assertAlmostEqual(time(), 0.15)
        body.send_keys(",")
        self.assertAlmostEqual(time(), 0.1)
        self.assertIn("At 0.10 s", self.text("lab-said"))
        body.send_keys(" ")
        self.settle()
        body.send_keys(" ")
        self.assertGreater(time(), 0.2)
        self.assertFalse(self.browser.run("return lab.state.isPlaying"))

    # Property: a click selects who is there, and its history appears.
    def test_a_click_shows_the_history_of_a_track(self):
        self.browser.run("lab.state.select(null, 0); lab.state.seek(10)")
        self.settle()
        self.browser.run("""
            const canvas = document.getElementById("lab-view-0"), box = canvas.getBoundingClientRect();
            const [x, y] = lab.state.truth.at(0, 10);
            const at = {clientX: box.left + lab.views[0].x(x), clientY: box.top + lab.views[0].y(y),
                        pointerId: 1, bubbles: true};
            canvas.setPointerCapture = () => {};
            canvas.dispatchEvent(new PointerEvent("pointerdown", at));
            canvas.dispatchEvent(new PointerEvent("pointerup", at));""")
        self.assertEqual(self.browser.run("return lab.state.selected"), 0)
        self.assertIn("which follows", self.text("lab-history-title"))
        rows = self.browser.run("return document.querySelectorAll('#lab-history-table tbody tr').length")
        self.assertGreater(rows, 50)

    # Property: two fingers that part magnify, one moves.
    def test_fingers_zoom_and_pan(self):
        zoom, moved = self.browser.run("""
            const canvas = document.getElementById("lab-view-0"), {camera} = lab.state;
            canvas.setPointerCapture = () => {};
            const send = (type, id, x, y) => canvas.dispatchEvent(new PointerEvent(type,
              {pointerId: id, clientX: x, clientY: y, pointerType: "touch", bubbles: true}));
            camera.fit();
            send("pointerdown", 1, 300, 200); send("pointerdown", 2, 340, 200);
            send("pointermove", 2, 420, 200);
            const zoom = camera.zoom;
            send("pointerup", 1, 300, 200); send("pointerup", 2, 420, 200);
            const before = camera.center[0];
            send("pointerdown", 3, 300, 200); send("pointermove", 3, 200, 200); send("pointerup", 3, 200, 200);
            const moved = camera.center[0] - before;
            camera.fit();
            return [zoom, moved];""")
        self.assertAlmostEqual(zoom, 3, places=6)
        self.assertGreater(moved, 0)

    # Property: at no width does the page need scrolling to the side.
    def test_it_fits_phones_laptops_and_beamers(self):
        for width in (400, 1280, 1920):
            with self.subTest(width=width):
                self.browser.resize(width, 900)
                self.settle()
                self.assertLessEqual(self.browser.run("return document.documentElement.scrollWidth"), width)
        self.browser.resize(1280, 900)

    # Property: everything that can be turned has a name for those who do not see it.
    def test_everything_has_a_name(self):
        nameless = self.browser.run("""
            return [...document.querySelectorAll("input, select, button, canvas")].filter((e) => {
              const labelled = e.labels?.length > 0 || e.getAttribute("aria-label") || e.getAttribute("aria-labelledby");
              return !labelled && e.textContent.trim() === "";
            }).map((e) => e.outerHTML.slice(0, 80));""")
        self.assertEqual(nameless, [])

    # Property: dark and light are different pictures of the same.
    def test_dark_and_light(self):
        look = lambda: self.browser.run("""
            const canvas = document.getElementById("lab-view-0");
            const copy = new OffscreenCanvas(1, 1).getContext("2d", {willReadFrequently: true});
            copy.drawImage(canvas, 3, canvas.height - 3, 1, 1, 0, 0, 1, 1);
            return [...copy.getImageData(0, 0, 1, 1).data].slice(0, 3);""")
        light = look()
        self.browser.driver.execute_cdp_cmd("Emulation.setEmulatedMedia", {"features": [
            {"name": "prefers-color-scheme", "value": "dark"}]})
        self.settle()
        dark = look()
        self.browser.driver.execute_cdp_cmd("Emulation.setEmulatedMedia", {"features": [
            {"name": "prefers-color-scheme", "value": "light"}]})
        self.settle()
        self.assertLess(sum(dark), sum(light))

    # Property: at most one value in fifty may be left out of a plot, and only if it is far from the others.
    def test_few_far_values_do_not_set_the_scale(self):
        far = """
const points = Array.from({length: 200}, (_, i) => [i, Math.sin(i)]).concat(arguments[0].map((value) => [200, value]));
return lab.farValues([{points}]);"""
        self.assertIsNone(self.browser.run(far, [1.5, None]))
        self.assertEqual(self.browser.run(far, [-40, 70])["count"], 2)
        self.assertEqual(self.browser.run(far, [-40, 70])["most"], 70)
        self.assertLess(self.browser.run(far, [-40, 70])["limit"], 2.1)
        self.assertIsNone(self.browser.run(far, [5.0] * 100))

    # Property: the page of the flagship is small.
    def test_its_size(self):
        self.assertLess(page_of("three_regimes.yaml", self.folder).stat().st_size, 3_000_000)

    # A figure to look at, no assertion: machines differ.
    def test_a_redraw_is_timed(self):
        times = self.browser.run("""
            return Array.from({length: 40}, (_, i) => {
              const start = performance.now();
              const slider = document.getElementById("lab-gate");
              slider.value = 300 + 5 * i;
              slider.dispatchEvent(new Event("input", {bubbles: true}));
              lab.draw();
              return performance.now() - start;
            });""")
        times.sort()
        print(f"\nredraw: median {times[20]:.1f} ms, slowest {times[-1]:.1f} ms; 30 a second leave 33 ms")
        self.browser.run("document.getElementById('lab-reset').click()")

    @classmethod
    def tearDownClass(cls):
        # Property: the page is quiet and alone.
        complaints, requests = cls.browser.complaints(), cls.browser.requests()
        assert not complaints, complaints
        assert not requests, requests


class Series(unittest.TestCase):
    # Property: the page of a series says what the program says, as it is opened and when it is turned.
    def test_sliders_say_what_the_program_says(self):
        with tempfile.TemporaryDirectory() as folder, Browser() as browser:
            browser.open(page_of("textbook/interactive.yaml", folder))
            browser.driver.implicitly_wait(10)
            browser.driver.find_element("css selector", "#lab-live:not([hidden])")
            for slider, place in ((None, None), ("lab-filter-g", 700), ("lab-filter-x0", 100), ("lab-data-noise", 200)):
                if slider:
                    browser.run(SLIDE, slider, place)
                browser.driver.execute_async_script("const done = arguments[0]; setTimeout(done, 300);")
                command = shlex.split(browser.run("return document.getElementById('lab-command').textContent"))
                program(*command[1:], "-o", "out", folder=folder)
                with open(Path(folder) / "out/series.csv", encoding="utf-8") as file:
                    wanted = [float(row["x"]) for row in csv.DictReader(file)]
                said = browser.run("return lab.state.result.tracks.flatMap((track) => track.x)")
                self.assertEqual(said, wanted)
            self.assertEqual(browser.complaints(), [])

    # Property: readings of doors are not drawn as places, and no curve crosses the hallway where its ends meet.
    def test_a_hallway_is_a_ring_and_its_readings_are_no_places(self):
        with tempfile.TemporaryDirectory() as folder, Browser() as browser:
            for scene, dots in (("bayes/dog-in-a-hallway.yaml", 0), ("bayes/dog-by-gaussians.yaml", 1)):
                browser.open(page_of(scene, folder))
                browser.driver.implicitly_wait(10)
                browser.driver.find_element("css selector", "#lab-live:not([hidden])")
                curves = browser.run("return lab.plots[0].curves().map(({dots, points}) => [dots ?? false, points.map(([, v]) => v)])")
                self.assertEqual(sum(is_dots for is_dots, _ in curves), dots, scene)
                if dots == 0:
                    steps = [abs(a - b) for _, points in curves for a, b in zip(points, points[1:]) if None not in (a, b)]
                    self.assertLessEqual(max(steps), 5)

    # Property: wherever a slider of a series is turned to, the filter can be read; whole numbers stay whole.
    def test_every_slider_says_what_can_be_read(self):
        with tempfile.TemporaryDirectory() as folder, Browser() as browser:
            for scene in ("bayes/dog-in-a-hallway.yaml", "bayes/prediction-alone.yaml", "bayes/dog-by-gaussians.yaml",
                          "textbook/train.yaml", "homework/q4-acceleration.yaml"):
                browser.open(page_of(scene, folder))
                browser.driver.implicitly_wait(10)
                browser.driver.find_element("css selector", "#lab-live:not([hidden])")
                sliders = browser.run("return [...document.querySelectorAll('input[type=range]')].map((e) => e.id)")
                self.assertGreater(len(sliders), 0, scene)
                for slider in sliders:
                    for place in (137, 618, 500):
                        browser.run(SLIDE, slider, place)
                        browser.driver.execute_async_script("requestAnimationFrame(() => setTimeout(arguments[0], 20))")
                        problem = browser.run("return document.getElementById('lab-problem').textContent")
                        self.assertNotRegex(problem, "integer|whole|expected|must be", f"{scene} {slider} {place}")
            self.assertEqual(browser.complaints(), [])


if __name__ == "__main__":
    unittest.main(argv=[sys.argv[0], "-v"])
