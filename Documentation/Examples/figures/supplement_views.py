# SPDX-FileCopyrightText: Copyright (c) Limpid developers
# SPDX-License-Identifier: BSD-3-Clause

"""The supplement's second views: the methods of Fig. 8 from another camera.

  pvpython supplement_views.py --plugin Limpid.so --output FOLDER [FILE.scene.json ...]
"""

import figure_8
import studio

VIEW = "right"


def make(run):
    return figure_8.compare(run, VIEW, "supplement-views.jpg")


def caption(numbers):
    return figure_8.caption(numbers)


if __name__ == "__main__":
    studio.main(__file__, __doc__)
