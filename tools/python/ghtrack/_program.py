"""Runs the program `ghtrack`: what it computes here is what it computes on the command line."""

import json
import os
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile


class InputError(ValueError):
    """What was given is wrong: a scene, a table, an option. The text names place, key and remedy."""


class EnvironmentFailure(RuntimeError):
    """The surroundings failed: a folder that cannot be written, a full disk, a missing codec."""


def executable():
    """The path of the program that belongs to this module: of the same build or installation.

    Raises EnvironmentFailure if there is none.
    """
    package = pathlib.Path(__file__).resolve().parent
    for parent in package.parents:
        candidate = parent / "bin" / "ghtrack"
        if candidate.is_file() and os.access(candidate, os.X_OK):
            return str(candidate)
    found = shutil.which("ghtrack")
    if found is None:
        raise EnvironmentFailure("the program ghtrack is neither beside the module nor on the PATH")
    return found


def call(*arguments, folder=None):
    """Standard output of `ghtrack ARGUMENTS`, in a folder; what it says beside is shown on standard
    error.

    Raises InputError or EnvironmentFailure with the program's own words.
    """
    command = [executable(), *map(str, arguments)]
    # Arguments are passed as they are: no shell takes part.
    done = subprocess.run(command, cwd=folder, capture_output=True, text=True, check=False)
    said = _without_scratch(done.stderr)
    if done.returncode == 0:
        if said:
            print(said, end="", file=sys.stderr)
        return done.stdout
    words = said.strip() or f"ghtrack ended with status {done.returncode}"
    raise (InputError if done.returncode == 2 else EnvironmentFailure)(words)


def _without_scratch(text):
    """The text without the folders in which this module keeps files for the program for a while."""
    return re.sub(re.escape(tempfile.gettempdir()) + r"/ghtrack-[^/\s]*/", "", text)


def option_list(options):
    """{"jobs": 2, "match_distance": 3} as ["--jobs", "2", "--match-distance", "3"].

    None leaves an option out, True is a flag, a dict is KEY=VALUE for each of its items, a list
    repeats the option.
    """
    words = []
    for name, value in options.items():
        flag = "--" + name.rstrip("_").replace("_", "-")
        if value is None or value is False:
            continue
        if value is True:
            words.append(flag)
        elif isinstance(value, dict):
            for key, entry in value.items():
                words += [flag, f"{key}={as_yaml(entry)}"]
        elif isinstance(value, (list, tuple)):
            for entry in value:
                words += [flag, str(entry)]
        else:
            words += [flag, str(value)]
    return words


def as_yaml(value):
    """A value as a scene file may have it; JSON is YAML, but for plain words."""
    return value if isinstance(value, str) else json.dumps(value)
