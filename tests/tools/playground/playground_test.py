"""playground_test.py PAGE.html GHTRACK SCENE.yaml: the page in a browser against the program."""

import csv
import io
import re
import sys
import tempfile
import unittest
from pathlib import Path
from urllib.parse import unquote

sys.path.insert(0, str(Path(__file__).resolve().parents[1] / "browser"))
from browser import Browser, output_of  # noqa: E402

PAGE, PROGRAM, SCENE = sys.argv[1:4]

SET = """
for (const [name, value] of Object.entries(arguments[0])) {
  const slider = document.getElementById(`play-${name}`);
  slider.value = value;
  slider.dispatchEvent(new Event("input", {bubbles: true}));
}"""

PLOTTED = """
const plot = document.getElementById("playground-plot");
const points = plot.querySelector("polyline.x").getAttribute("points");
return points.split(" ").map((point) => point.split(",").map(Number));"""


def columns(text):
    rows = list(csv.DictReader(io.StringIO(text)))
    return {name: [float(row[name]) for row in rows] for name in ("z", "x") if name in rows[0]}


class Playground(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.browser = cls.enterClassContext(Browser())
        cls.browser.open(PAGE)
        cls.browser.driver.implicitly_wait(10)
        cls.browser.driver.find_element("css selector", "#playground-live:not([hidden]) polyline.x")

    def plotted(self):
        points = self.browser.run(PLOTTED)
        self.assertEqual([step for step, _ in points], list(range(1, len(points) + 1)))
        return [value for _, value in points]

    def measurements(self):
        link = self.browser.run("return document.getElementById('playground-download').href")
        return unquote(link.removeprefix("data:text/csv,"))

    def command(self):
        shown = self.browser.run("return document.getElementById('playground-command').textContent")
        return [PROGRAM, "--quiet"] + shown.replace("measurements.csv", "-").split()[1:]

    def expect_the_programs_estimates(self):
        printed = columns(output_of(self.command(), self.measurements()))["x"]
        self.assertEqual(self.plotted(), printed)  # all digits

    # Property: the page computes what the program computes, to the last bit, wherever the sliders are.
    def test_moving_a_slider_plots_exactly_what_the_program_prints(self):
        for moved in ({"g": "0.29"}, {"h": "0.083"}, {"x0": "-200"}, {"dx0": "-37.5"},
                      {"noise": "3"}, {"k": "0.0025"}, {"g": "1.3"}, {"noise": "200", "h": "0.5"},
                      {"g": "0.01", "h": "0", "k": "0", "x0": "200", "dx0": "50"}):
            with self.subTest(**moved):
                self.browser.run(SET, moved)
                for name, value in moved.items():
                    if name != "noise":
                        self.assertIn(f"--{name} {float(value):g}", " ".join(self.command()) + " --k 0")
                self.expect_the_programs_estimates()

    # Property: the same for the chapter's experiments behind the buttons.
    def test_every_experiment_plots_exactly_what_the_program_prints(self):
        buttons = self.browser.driver.find_elements("css selector", "#playground-form button")
        self.assertGreaterEqual(len(buttons), 5)
        for button in buttons:
            with self.subTest(button.text):
                self.browser.run("arguments[0].click()", button)
                self.expect_the_programs_estimates()

    # Property: the first experiment is the filter "mine" of the textbook's interactive scene.
    def test_the_first_experiment_is_the_interactive_scene(self):
        self.browser.run("document.querySelector('#playground-form button').click()")
        with tempfile.TemporaryDirectory() as folder:
            output_of([PROGRAM, "--quiet", "run", SCENE, "-o", folder + "/out"])
            with open(folder + "/out/series.csv", encoding="utf-8") as file:
                rows = [row for row in csv.DictReader(file) if row["filter"] == "mine"]
        self.assertEqual(columns(self.measurements())["z"], [float(row["z"]) for row in rows])
        self.assertEqual(self.plotted(), [float(row["x"]) for row in rows])

    # Property: stability, noise reduction and lag are those of `ghtrack gains`, as far as they are shown.
    def test_the_figures_are_those_of_the_program(self):
        import json
        for g, h, k in (("0.29", "0.05", "0"), ("0.5", "0.2", "0.01"), ("1.9", "0.4", "0")):
            self.browser.run(SET, {"g": g, "h": h, "k": k})
            third = ["--k", k] if float(k) > 0 else []
            told = json.loads(output_of([PROGRAM, "gains", "manual", "--g", g, "--h", h, *third,
                                         "--accel", "1", "--jerk", "1", "--json"]))
            text = lambda name: self.browser.run(
                "return document.getElementById(arguments[0]).textContent", name)
            number = lambda name: float(re.match(r"[-0-9.e+]+", text(name)).group())
            verdict = text("playground-verdict")
            self.assertEqual(verdict.startswith("Stable"), told["stable"])
            self.assertTrue(text("figure-damping").startswith(told["damping"]))
            if told["stable"]:
                self.assertAlmostEqual(number("figure-vrf") / told["vrf"]["x"], 1, delta=0.006)
                self.assertAlmostEqual(number("figure-lag") / told["lag"]["x"], 1, delta=0.006)
            else:
                self.assertIn(told["violated"], verdict)

    # Property: the sliders obey the keyboard.
    def test_an_arrow_key_moves_a_slider_and_the_plot(self):
        self.browser.run(SET, {"g": "0.4", "k": "0"})
        before = self.plotted()
        slider = self.browser.driver.find_element("id", "play-g")
        slider.send_keys("\ue014")  # arrow right
        self.assertEqual(slider.get_property("value"), "0.41")
        self.assertNotEqual(self.plotted(), before)
        self.expect_the_programs_estimates()

    # Property: the table under the plot follows, rounded.
    def test_the_table_shows_what_is_plotted(self):
        self.browser.run(SET, {"x0": "-150", "g": "0.35"})
        cells = self.browser.driver.execute_async_script("""
            const done = arguments[0];
            setTimeout(() => done([...document.querySelectorAll("#playground-rows tr")].map(
                (row) => Number(row.cells[5].textContent))), 500);""")
        self.assertEqual(cells, [round(value, 3) for value in self.plotted()])

    # Property: nothing is wider than a phone.
    def test_a_phone_needs_no_horizontal_scrolling(self):
        self.browser.resize(400, 800)
        width = self.browser.run("return document.documentElement.scrollWidth")
        self.browser.resize(1280, 900)
        self.assertLessEqual(width, 400)

    # A figure to look at, no assertion: machines differ.
    def test_a_redraw_is_timed(self):
        times = self.browser.run("""
            const slider = document.getElementById("play-g");
            return Array.from({length: 60}, (_, i) => {
              const start = performance.now();
              slider.value = 0.1 + i / 100;
              slider.dispatchEvent(new Event("input", {bubbles: true}));
              document.getElementById("playground").getBoundingClientRect();  // with layout
              return performance.now() - start;
            });""")
        times.sort()
        print(f"\nredraw: median {times[30]:.1f} ms, slowest {times[-1]:.1f} ms; a frame has 16.7 ms")

    @classmethod
    def tearDownClass(cls):
        # Property: the page is quiet and alone.
        complaints, requests = cls.browser.complaints(), cls.browser.requests()
        assert not complaints, complaints
        assert not requests, requests


if __name__ == "__main__":
    unittest.main(argv=[sys.argv[0], "-v"])
