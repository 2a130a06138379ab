# SPDX-FileCopyrightText: Copyright (c) Limpid developers
# SPDX-License-Identifier: BSD-3-Clause

"""Prints the defaults of a filter's properties as JSON, by the package's names of settings.

  python3 print_defaults.py vtkExtinctionOptimizer|vtkViewpointSearch NAME ...
"""

import json
import sys

from limpid import vtkLimpidFilters

made = getattr(vtkLimpidFilters, sys.argv[1])()
defaults = {}
for name in sys.argv[2:]:
    words = name.split("_")
    getter = "Get" + "".join(word.capitalize() for word in words)
    defaults[name] = getattr(made, getter)()
print(json.dumps(defaults))
