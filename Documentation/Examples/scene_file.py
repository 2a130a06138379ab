# SPDX-FileCopyrightText: Copyright (c) Limpid developers
# SPDX-License-Identifier: BSD-3-Clause

"""Reads scene files (README.md) and checks them: whatever is wrong is told in one line.

  python3 scene_file.py FILE.scene.json...
"""

import json
import math
import os
import re
import sys

MOST_POINTS = 2**31
HEADER = 65536  # bytes of an image file that its extent is looked for in


class SceneError(SystemExit):
    """Ends a program with one line: file, key, what is wrong (why it matters), what to do."""

    def __init__(self, path, key, wrong, advice):
        where = "{}: {}".format(path, '"{}" '.format(key) if key else "")
        super().__init__(" ".join("{}{}. {}.".format(where, wrong, advice).split()))


def shown(value):
    text = json.dumps(value)
    return text if len(text) <= 40 else text[:37] + "..."


def is_number(value):
    """A finite number that is a float, too; true and false are none."""
    try:
        return not isinstance(value, bool) and isinstance(value, (int, float)) and \
            math.isfinite(value)
    except OverflowError:
        return False


def is_vector(value):
    return isinstance(value, list) and len(value) == 3 and all(map(is_number, value))


class SceneFile:
    """The description in a scene file, by keys like "camera.position"."""

    def __init__(self, path):
        self.path = path
        self.description = self.read()

    def read(self):
        try:
            with open(self.path, encoding="utf-8") as file:
                description = json.load(file)
        except OSError as error:
            self.refuse("", "cannot be read ({})".format(error.strerror),
                        "Name a file that is there")
        except (ValueError, RecursionError) as error:
            self.refuse("", "is not JSON ({})".format(error), "Correct it there")
        if not isinstance(description, dict):
            self.refuse("", "is {} (a scene has names for its parts)".format(shown(description)),
                        "Write an object, like {\"name\": ...}")
        return description

    def refuse(self, key, wrong, advice):
        raise SceneError(self.path, key, wrong, advice)

    def require(self, key, valid, why, advice):
        """The value of a key, for which valid(value) holds."""
        value = self.description
        parent = []
        for part in key.split("."):
            if not isinstance(value, dict):
                self.refuse(".".join(parent), "is {} ({})".format(shown(value), why),
                            "Write an object with \"{}\"".format(part))
            parent.append(part)
            if part not in value:
                self.refuse(".".join(parent), "is missing ({})".format(why), advice)
            value = value[part]
        if not valid(value):
            self.refuse(key, "is {} ({})".format(shown(value), why), advice)
        return value

    def check_text(self, key, why):
        return self.require(key, lambda value: isinstance(value, str) and value.strip(), why,
                            "Give a text")

    def check_vector(self, key, why):
        return self.require(key, is_vector, why, "Give three finite numbers, like [1, 2, 3]")

    def check_nodes(self, key, names, largest):
        """A transfer function: nodes of a value and what belongs to it, from 0 to `largest`."""
        advice = "Give nodes [value, {}], each {} in 0..{}".format(
            ", ".join(names), " and ".join(names), largest)

        def is_node(node):
            return isinstance(node, list) and len(node) == 1 + len(names) and \
                all(map(is_number, node)) and all(0 <= part <= largest for part in node[1:])

        why = "the volume is classified by it"
        nodes = self.require(key, lambda value: isinstance(value, list) and value, why, advice)
        for place, node in enumerate(nodes):
            if not is_node(node):
                self.refuse("{}[{}]".format(key, place), "is {} ({})".format(shown(node), why),
                            advice)
            if place > 0 and node[0] < nodes[place - 1][0]:
                self.refuse("{}[{}]".format(key, place), "has the value {}, below {} before it "
                            "({})".format(shown(node[0]), shown(nodes[place - 1][0]), why),
                            "Put nodes in the order of their values")
        return nodes

    def image_path(self):
        return os.path.join(os.path.dirname(os.path.abspath(self.path)),
                            self.description["data"]["file"])

    def check_image(self):
        """The head of the image file."""
        key = "data.file"
        name = self.check_text(key, "the volume is read from it")
        try:
            with open(self.image_path(), "rb") as file:
                head = file.read(HEADER)
        except (OSError, ValueError) as error:
            self.refuse(key, "is {}, which cannot be read ({})".format(
                shown(name), getattr(error, "strerror", None) or error),
                        "Name a file beside the scene")
        extent = re.search(rb'<VTKFile[^>]*type="ImageData".*<ImageData[^>]*WholeExtent="([^"]*)"',
                           head, re.DOTALL)
        try:
            ends = [int(end) for end in extent.group(1).split()]
            points = [last - first + 1 for first, last in zip(ends[0::2], ends[1::2])]
        except (AttributeError, ValueError):
            points = []
        if len(points) != 3:
            self.refuse(key, "is {}, which is no VTK XML image".format(shown(name)),
                        "Name a .vti file")
        if min(points) < 1 or math.prod(points) > MOST_POINTS:
            self.refuse(key, "is {}, an image of {} x {} x {} points (1 to {} can be read)".format(
                shown(name), *points, MOST_POINTS), "Name one that is not empty and not as large")

    def check(self):
        for key in ("name", "title", "becomes_visible"):
            self.check_text(key, "the report says it")
        self.check_image()
        self.check_text("data.array", "the scene is made from this array")
        self.check_nodes("color_tf", ["red", "green", "blue"], 1)
        self.check_nodes("importance_tf", ["importance"], 1)
        if not any(node[1] > 0
                   for node in self.check_nodes("extinction_tf", ["extinction"], 1e30)):
            self.refuse("extinction_tf", "has no extinction above 0 (nothing would be drawn)",
                        "Give one")
        position = self.check_vector("camera.position", "the camera is there")
        if self.check_vector("camera.focal_point", "the camera looks there") == position:
            self.refuse("camera.focal_point", "is \"camera.position\", {} (the camera looks in no "
                        "direction)".format(shown(position)), "Move one of the two")
        if not any(self.check_vector("camera.view_up", "it is up in the picture")):
            self.refuse("camera.view_up", "is [0, 0, 0] (nothing is up in the picture)",
                        "Give a direction")
        self.require("camera.view_angle", lambda value: is_number(value) and 0 < value < 180,
                     "it is how much the picture shows", "Give degrees above 0 and below 180")
        self.check_vector("light.position", "the light is there")
        return self


if __name__ == "__main__":
    for scene in sys.argv[1:]:
        SceneFile(scene).check()
