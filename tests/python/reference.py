"""Reads tests/reference/filters: inputs, and values that an independent program has computed."""

import json
import pathlib

FOLDER = pathlib.Path(__file__).parents[1] / "reference" / "filters"


def cases(name):
    """The cases of one file, each ready to be a parameter of a test."""
    with open(FOLDER / f"{name}.json", encoding="utf-8") as file:
        return json.load(file)["cases"]


def name_of(case):
    return case["id"]
