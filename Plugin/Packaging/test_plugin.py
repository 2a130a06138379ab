# SPDX-FileCopyrightText: Copyright (c) Limpid developers
# SPDX-License-Identifier: BSD-3-Clause

"""Loads the installed plugin, optimises a small phantom and looks at what came out.

    pvpython test_plugin.py PLUGIN
"""

import sys

from paraview import simple

simple.LoadPlugin(sys.argv[1], remote=False, ns=vars(simple))
head = simple.OcclusionPhantom(Resolution=32, Scene="Head")
optimizer = simple.ExtinctionOptimizer(Input=head, ExtinctionSource="Array")
optimizer.ExtinctionArray = ["POINTS", "BaseExtinction"]
optimizer.UpdatePipeline()

after, before = (optimizer.FieldData[name].GetRange()[0]
                 for name in ("VisibleFraction", "BaseVisibleFraction"))
print(f"Visible: {100 * after:.1f} % of the important structures, {100 * before:.1f} % before")
if not 1 >= after > before > 0:
    sys.exit("The optimisation does not let more of the important structures be seen.")
