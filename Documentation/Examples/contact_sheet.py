# SPDX-FileCopyrightText: Copyright (c) Limpid developers
# SPDX-License-Identifier: BSD-3-Clause

"""Puts the pictures of several demo folders on one sheet, four scenes a row: before, below it as in
the paper, below that after.

  python3 contact_sheet.py SHEET.png FOLDER...
"""

import os
import re
import sys

import matplotlib

matplotlib.use("Agg")

from matplotlib import pyplot  # pylint: disable=wrong-import-position

ACROSS = 4  # scenes in a row
HEAD = re.compile(r"^# (.*)$", re.MULTILINE)
ROWS = ("before", "paper", "after")
SHARE = re.compile(r"^\| visible share[^|]*\| ([^|]*) \| ([^|]*) \| ([^|]*) \|$", re.MULTILINE)
SCORE = re.compile(r"^\| visibility score[^|]*\| ([^|]*) \| ([^|]*) \| ([^|]*) \|$", re.MULTILINE)


def main(sheet, folders):
    if not folders:
        raise SystemExit("No folders are given (there is nothing to show). "
                         "Use: contact_sheet.py SHEET.png FOLDER...")
    across = min(len(folders), ACROSS)
    blocks = (len(folders) + across - 1) // across
    figure, axes = pyplot.subplots(len(ROWS) * blocks, across, squeeze=False,
                                   figsize=(3 * across, 9.7 * blocks), facecolor="white")
    for axis in axes.flat:
        axis.set_axis_off()
    for number, folder in enumerate(folders):
        with open(os.path.join(folder, "report.md"), encoding="utf-8") as file:
            report = file.read()
        title = HEAD.search(report).group(1)
        shares = SHARE.search(report).groups()
        scores = SCORE.search(report).groups()
        for row, name in enumerate(ROWS):
            axis = axes[len(ROWS) * (number // across) + row][number % across]
            axis.imshow(pyplot.imread(os.path.join(folder, name + ".png")))
            label = "{}\n".format(title) if row == 0 else ""
            axis.set_title("{}{}: S {} ({} visible)".format(label, name, scores[row], shares[row]),
                           fontsize=8)
    figure.tight_layout()
    figure.savefig(sheet, dpi=85)


if __name__ == "__main__":
    main(sys.argv[1], sys.argv[2:])
