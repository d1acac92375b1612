"""report_test.py PAGE.html: a report in a browser, with scripts and without."""

import sys
import unittest
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[1] / "browser"))
from browser import Browser  # noqa: E402
from selenium.webdriver import ActionChains  # noqa: E402

PAGE = sys.argv[1]

COLUMN = """
const table = document.querySelector(".matrix");
return [...table.tBodies[0].rows].map((row) => row.cells[arguments[0]].dataset.sort);"""


class Report(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.browser = cls.enterClassContext(Browser())
        cls.browser.open(PAGE)
        cls.browser.driver.implicitly_wait(10)

    # Property: a header is a button, and the keyboard sorts by it, both ways.
    def test_the_keyboard_sorts_a_table(self):
        button = self.browser.driver.find_elements("css selector", ".matrix th button")[2]
        button.send_keys("\n")
        values = [float(value) for value in self.browser.run(COLUMN, 2)]
        self.assertEqual(values, sorted(values))
        header = self.browser.run("return arguments[0].parentNode.getAttribute('aria-sort')", button)
        self.assertEqual(header, "ascending")
        button.send_keys(" ")
        values = [float(value) for value in self.browser.run(COLUMN, 2)]
        self.assertEqual(values, sorted(values, reverse=True))

    # Property: names stay text: in tables, in charts, in what the scripts show.
    def test_hostile_names_make_no_element(self):
        self.assertEqual(self.browser.run("return document.querySelectorAll('img').length"), 0)
        self.assertIn("<img src=x onerror=alert(1)>", self.browser.run("return document.body.textContent"))

    # Property: scripts turn the error charts into ones that can be read, as they come into view.
    def test_error_charts_come_alive_and_can_be_read(self):
        figure = self.browser.driver.find_element("css selector", ".error-chart")
        self.browser.run("arguments[0].scrollIntoView()", figure)
        canvas = self.browser.driver.find_element("css selector", ".error-chart .live-chart canvas")
        ActionChains(self.browser.driver).move_to_element(canvas).perform()
        reading = self.browser.driver.find_element("css selector", ".error-chart .reading").text
        self.assertRegex(reading, r"^At [0-9.]+ s: sluggish [0-9.]+ m, nimble ")
        self.assertIn('<b>bold</b> & "quoted"', reading)
        self.assertTrue(canvas.is_displayed())

    # Property: a chart for paper is still there when scripts have made it a live one.
    def test_paper_gets_the_static_charts(self):
        self.browser.driver.execute_cdp_cmd("Emulation.setEmulatedMedia", {"media": "print"})
        shown = self.browser.run("""
            return [...document.querySelectorAll(".chart")].every((chart) =>
              getComputedStyle(chart).display !== "none");""")
        self.browser.driver.execute_cdp_cmd("Emulation.setEmulatedMedia", {"media": ""})
        self.assertTrue(shown)

    # Property: nothing is wider than a phone.
    def test_a_phone_needs_no_horizontal_scrolling(self):
        self.browser.resize(400, 800)
        width = self.browser.run("return document.documentElement.scrollWidth")
        self.browser.resize(1280, 900)
        self.assertLessEqual(width, 400)

    # Property: without scripts all tables and charts are there.
    def test_without_scripts_tables_and_charts_stay(self):
        with Browser(scripts=False) as plain:
            plain.open(PAGE)
            charts = plain.driver.find_elements("css selector", ".chart")
            self.assertGreater(len(charts), 5)
            self.assertTrue(all(chart.is_displayed() for chart in charts))
            self.assertGreater(len(plain.driver.find_elements("css selector", ".matrix tbody tr")), 5)
            self.assertEqual(plain.driver.find_elements("css selector", "th button"), [])

    @classmethod
    def tearDownClass(cls):
        # Property: the page is quiet and alone.
        cls.browser.run("window.scrollTo(0, document.body.scrollHeight)")
        complaints, requests = cls.browser.complaints(), cls.browser.requests()
        assert not complaints, complaints
        assert not requests, requests


if __name__ == "__main__":
    unittest.main(argv=[sys.argv[0], "-v"])
