"""make.py TRACKEVAL: writes this folder's files anew with a checkout of TrackEval, commit 12c8791.

A street of boxes with every kind of row that KITTI's rules treat apart: other types, truncated and
occluded truth, boxes too small, false boxes in regions that are not labelled, gaps and switches."""

import json
import random
import sys
import tempfile
from pathlib import Path

import numpy as np

FRAMES = 40
KINDS = (["Car"] * 5 + ["Van"] * 2 + ["Pedestrian"] * 4 + ["Person"] * 2
         + ["Cyclist", "Truck", "Misc"])
SEEN = {"Van": "Car", "Person": "Pedestrian", "Truck": "Car"}
UNLABELLED = ((600, 90, 760, 330), (20, 300, 90, 360))


def row(frame, identity, kind, truncated, occluded, left, top, right, bottom, score=None):
    text = (f"{frame} {identity} {kind} {truncated} {occluded} -10 "
            f"{left:.2f} {top:.2f} {right:.2f} {bottom:.2f} -1 -1 -1 -1000 -1000 -1000 -10")
    return text if score is None else f"{text} {score:.2f}"


def street():
    """Rows of the truth and of the tracks."""
    random.seed(20260117)
    truth, tracks, objects = [], [], []
    for i, kind in enumerate(KINDS):
        height = random.uniform(18, 24) if i % 4 == 3 else random.uniform(30, 90)
        width = height * (1.5 if kind in ("Car", "Van", "Truck") else 0.45)
        objects.append([kind, random.uniform(0, 900), random.uniform(100, 250), width, height,
                        random.uniform(-6, 6), random.uniform(-1, 1)])
    identities, following = {}, 100
    for frame in range(FRAMES):
        truth += [row(frame, -1, "DontCare", -1, -1, *region) for region in UNLABELLED]
        for i, thing in enumerate(objects):
            kind, x, y, width, height, dx, dy = thing
            thing[1] += dx
            thing[2] += dy
            if i % 5 == 1 and 20 < frame < 32:
                continue
            truncated = 1 if i % 6 == 2 and frame < 15 else 0
            occluded = 3 if i % 7 == 0 and 25 < frame < 40 else (frame // 10 + i) % 3
            truth.append(row(frame, i, kind, truncated, occluded, x, y, x + width, y + height))
            if random.random() < 0.12:
                continue
            if i not in identities or random.random() < 0.02:
                identities[i] = following
                following += 1
            seen = SEEN.get(kind, kind)
            if seen == "Misc":
                continue
            e = [random.gauss(0, 0.06 * height) for _ in range(4)]
            tracks.append(row(frame, identities[i], seen, -1, -1, x + e[0], y + e[1],
                              x + width + e[2], y + height + e[3], random.random()))
        for k in range(3):  # false ones
            kind = random.choice(["Car", "Pedestrian", "Cyclist"])
            height = random.choice([20, 25, 25.0, 40])
            x = random.choice([620, 640, 30, random.uniform(0, 1100)])
            y = random.uniform(80, 320)
            tracks.append(row(frame, 900 + k + 3 * (frame // 8), kind, -1, -1, x, y,
                              x + 0.6 * height, y + height, 0.5))
    return "\n".join(truth) + "\n", "\n".join(tracks) + "\n"


def scores(truth, tracks):
    """What TrackEval makes of them, for each class."""
    import trackeval
    quiet = {"PRINT_CONFIG": False}
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        (folder / "truth/label_02").mkdir(parents=True)
        (folder / "tracks/ours/data").mkdir(parents=True)
        (folder / "truth/label_02/0000.txt").write_text(truth)
        (folder / "tracks/ours/data/0000.txt").write_text(tracks)
        (folder / "truth/evaluate_tracking.seqmap.training").write_text(
            f"0000 empty 000000 {FRAMES:06d}\n")
        data = trackeval.datasets.Kitti2DBox({
            "GT_FOLDER": str(folder / "truth"), "TRACKERS_FOLDER": str(folder / "tracks"), **quiet})
        evaluator = trackeval.Evaluator({
            "PRINT_RESULTS": False, "OUTPUT_SUMMARY": False, "OUTPUT_DETAILED": False,
            "PLOT_CURVES": False, "TIME_PROGRESS": False, **quiet})
        results, _ = evaluator.evaluate([data], [
            trackeval.metrics.HOTA(), trackeval.metrics.CLEAR(quiet),
            trackeval.metrics.Identity(quiet)])
    found = {}
    for kind, result in results["Kitti2DBox"]["ours"]["0000"].items():
        hota, clear, identity = result["HOTA"], result["CLEAR"], result["Identity"]
        found[kind] = {
            "hota": float(np.mean(hota["HOTA"])), "deta": float(np.mean(hota["DetA"])),
            "assa": float(np.mean(hota["AssA"])),
            **{key: float(clear[key]) for key in ("MOTA", "CLR_TP", "CLR_FN", "CLR_FP", "IDSW", "Frag")},
            **{key: float(identity[key]) for key in ("IDF1", "IDTP", "IDFP", "IDFN")}}
    return found


if __name__ == "__main__":
    np.float, np.int, np.bool = float, int, bool  # names that numpy has no longer
    sys.path.insert(0, sys.argv[1])
    here = Path(__file__).parent
    truth, tracks = street()
    (here / "truth.txt").write_text(truth)
    (here / "tracks.txt").write_text(tracks)
    (here / "expected.json").write_text(json.dumps(scores(truth, tracks), indent=1) + "\n")
