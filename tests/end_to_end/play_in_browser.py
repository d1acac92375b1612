#!/usr/bin/env python3
"""play_in_browser.py GHTRACK SCENE.yaml: do MP4 and WebM play to their end in a browser?

Property: a <video> with the file has its size and duration, and reaches `ended`.
"""

import shutil
import subprocess
import sys
import tempfile
import time
import unittest
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[1] / "tools" / "browser"))
from browser import Browser, skip  # noqa: E402

PROGRAM, SCENE = sys.argv[1:3]
STATE = """
const video = document.querySelector("video");
return {ended: video.ended, error: video.error && video.error.message,
        width: video.videoWidth, height: video.videoHeight, duration: video.duration};"""


class Video(unittest.TestCase):
    def test_plays_to_its_end(self):
        with Browser() as browser, tempfile.TemporaryDirectory() as folder:
            for name in ("x.mp4", "x.webm"):
                file = Path(folder) / name
                subprocess.run([PROGRAM, "video", SCENE, "--quiet", "--to", "1", "--size", "640x360",
                                "-o", str(file)], check=True)
                page = file.with_suffix(".html")
                page.write_text(f"<!DOCTYPE html><title>{name}</title>"
                                f"<video src='{name}' muted autoplay></video>")
                browser.open(page)
                state, end = browser.run(STATE), time.monotonic() + 60
                while not state["ended"] and state["error"] is None and time.monotonic() < end:
                    time.sleep(0.1)
                    state = browser.run(STATE)
                with self.subTest(name):
                    self.assertIsNone(state["error"])
                    self.assertTrue(state["ended"])
                    self.assertEqual((state["width"], state["height"]), (640, 360))
                    self.assertAlmostEqual(state["duration"], 1.0, delta=0.05)


if __name__ == "__main__":
    if not shutil.which("ffmpeg"):
        skip("ffmpeg is not installed")
    unittest.main(argv=sys.argv[:1])
