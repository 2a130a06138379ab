# SPDX-FileCopyrightText: Copyright (c) Limpid developers
# SPDX-License-Identifier: BSD-3-Clause

"""Prints the defaults of the filter's properties as JSON, by the package's names of settings."""

import json
import sys

from limpid.vtkLimpidFilters import vtkExtinctionOptimizer

defaults = {}
for name in sys.argv[1:]:
    words = name.split("_")
    getter = "Get" + "".join(word.capitalize() for word in words)
    defaults[name] = getattr(vtkExtinctionOptimizer(), getter)()
print(json.dumps(defaults))
