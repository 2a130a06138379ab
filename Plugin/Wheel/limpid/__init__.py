# SPDX-FileCopyrightText: Copyright (c) Limpid developers
# SPDX-License-Identifier: BSD-3-Clause

"""Limpid: see what matters in a volume, with arrays of numpy and images of PyVista.

  optimize(...)    finds the extinction that makes important structures visible;
  viewpoints(...)  finds from where most of it can be seen;
  render(...)      draws a volume, before or after, lit and shadowed;
  load(...)        reads a result that was saved.

"Eq. (n)" is an equation of [HG24]: P. Himmler, T. Günther, Transmittance-based Extinction and
Viewpoint Optimization, Computer Graphics Forum 2024.
"""

import pkgutil

# The VTK modules of Limpid are a package of this name, too: both can be on one path.
__path__ = pkgutil.extend_path(__path__, __name__)

from ._core import version as __version__  # noqa: E402
from .optimization import Optimization, optimize  # noqa: E402
from .png_file import png  # noqa: E402
from .progress import ProgressBar  # noqa: E402
from .rendering import render  # noqa: E402
from .settings import Settings  # noqa: E402
from .storage import load  # noqa: E402
from .structures import StructureShares  # noqa: E402
from .viewpoint_search import Viewpoint, Viewpoints, viewpoints  # noqa: E402
from .views import Camera, Light  # noqa: E402

__all__ = ["Camera", "Light", "Optimization", "ProgressBar", "Settings", "StructureShares",
           "Viewpoint", "Viewpoints", "__version__", "load", "optimize", "png", "render",
           "viewpoints"]
