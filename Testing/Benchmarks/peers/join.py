# SPDX-FileCopyrightText: Copyright (c) Limpid developers
# SPDX-License-Identifier: BSD-3-Clause

"""Puts the numbers of one run.sh into one file:
  python3 join.py OUTPUT.json COMMAND PICTURES.json ENERGY.json [ABSENT ...]
"""

import json
import os
import sys

HERE = os.path.dirname(os.path.abspath(__file__))
sys.path.append(os.path.join(HERE, "..", "pages"))
import machine  # noqa: E402 pylint: disable=wrong-import-position


def main():
    output, command, *paths = sys.argv[1:5]
    joined = {}
    for path in paths:
        with open(path, encoding="utf-8") as file:
            part = json.load(file)
        joined = {**part, **joined}  # the first machine: its load is that before the start
    joined["machine"]["command"] = command
    joined["machine"]["load_after"] = os.getloadavg()[0]
    machine.save({**joined, "absent": sys.argv[5:]}, output)


if __name__ == "__main__":
    main()
