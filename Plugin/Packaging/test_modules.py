# SPDX-FileCopyrightText: Copyright (c) Limpid developers
# SPDX-License-Identifier: BSD-3-Clause

"""Optimises a small phantom by the installed VTK modules and looks at what came out."""

import sys

from limpid.vtkLimpidFilters import vtkExtinctionOptimizer, vtkOcclusionPhantom
from limpid.vtkLimpidRendering import vtkTransmittanceVolumeMapper

head = vtkOcclusionPhantom()
head.SetResolution(32)
optimizer = vtkExtinctionOptimizer()
optimizer.SetInputConnection(head.GetOutputPort())
optimizer.SetExtinctionSource(vtkExtinctionOptimizer.ARRAY)
optimizer.Update()

results = optimizer.GetOutput().GetFieldData()
after, before = (results.GetArray(name).GetTuple1(0)
                 for name in ("VisibleFraction", "BaseVisibleFraction"))
print(f"Visible: {100 * after:.1f} % of the important structures, {100 * before:.1f} % before")
if not 1 >= after > before > 0:
    sys.exit("The optimisation does not let more of the important structures be seen.")
if vtkTransmittanceVolumeMapper().IsA("vtkVolumeMapper") != 1:
    sys.exit("The mapper is no vtkVolumeMapper.")
