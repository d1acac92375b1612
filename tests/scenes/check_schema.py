"""Checks scenes/scene.schema.json against the scenes that the reader accepts and refuses.

Usage: check_schema.py SOURCE_FOLDER. Needs python3-jsonschema and python3-yaml.
"""

import json
import pathlib
import re
import sys

import jsonschema
import yaml

# What a schema cannot say: conditions between values, and the text of the file itself.
BEYOND_A_SCHEMA = {
    "clutter_without_field_of_view", "curve_without_length", "field_of_view_upside_down",
    "name_with_a_slash", "odd_video_size", "sweep_out_of_bounds", "repeated_sensor_name", "repeated_target_name",
    "series_repeated_filter_name", "series_truth_of_another_length", "train_drive_without_time",
    "unstable_gains", "design_of_too_much_noise", "filter_for_no_class", "video_after_the_end", "video_follows_nobody", "video_from_after_to",
    "empty_name", "long_text", "balls_inside_each_other", "camera_sees_the_horizon",
    "nearest_target_that_is_not_there", "sector_the_wrong_way_round", "ball_inside_a_box", "sprung_train_that_holds",
    "below_the_ground", "drone_plan_backwards", "ground_profile_backwards", "juggled_with_a_velocity",
    "released_by_nobody", "released_too_early", "too_many_copies", "no_models",
    "drone_lighter_than_paper", "juggled_too_far",
    "schedule_without_process_noise", "carried_by_no_wind", "cars_ahead_overlap", "order_of_no_filter",
    "recording_backwards", "recording_of_nothing", "route_leg_too_short", "route_turn_too_wide",
    "route_without_speed",
    # YAML's own matters, and numbers that only a YAML 1.1 reader takes for numbers:
    "anchor_and_alias", "duplicate_key", "merge_key", "number_with_leading_zero", "number_in_hex",
    "number_with_plus", "number_with_underscore", "not_finite", "second_document", "tag",
    "too_small_for_a_double", "yes_for_true", "quote_over_two_lines",
}


class Loader(yaml.SafeLoader):
    """Takes 1e-3 for a number, as YAML 1.2 does and YAML 1.1 does not."""


Loader.add_implicit_resolver("tag:yaml.org,2002:float",
                             re.compile(r"^-?(\d+\.?\d*|\.\d+)([eE][-+]?\d+)?$"), list("-.0123456789"))


def load(path):
    return yaml.load(path.read_bytes(), Loader)


def main():
    root = pathlib.Path(sys.argv[1])
    schema = json.loads((root / "scenes/scene.schema.json").read_text())
    jsonschema.Draft7Validator.check_schema(schema)
    validator = jsonschema.Draft7Validator(schema)
    wrong = []
    for folder in ("scenes", "tests/scenes/accepted"):
        for path in sorted((root / folder).rglob("*.yaml")):
            error = jsonschema.exceptions.best_match(validator.iter_errors(load(path)))
            if error:
                wrong.append(f"{path}: the schema refuses it: {error.message[:200]}")
    for path in sorted((root / "tests/scenes/rejected").glob("*.yaml")):
        if path.stem in BEYOND_A_SCHEMA:
            continue
        try:
            document = load(path)
        except yaml.YAMLError:
            continue
        if validator.is_valid(document):
            wrong.append(f"{path}: the schema accepts it")
    print("\n".join(wrong))
    return 1 if wrong else 0


sys.exit(main())
