// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef limpid_testing_SceneInBoxes_h
#define limpid_testing_SceneInBoxes_h

#include "BoxScene.h"

#include "optimize/ControlledScene.h"
#include "scene/FieldView.h"

#include <vector>

namespace limpid
{
/// Makes the fields of a scene box by box. The scene must outlive the result.
inline FieldsOfBox BoxesOf(const BoxScene& scene)
{
  return [&scene](const NodeBox& box, float* base, float* importance)
  {
    const auto copy = [&](const std::vector<float>& field, float* to)
    {
      CopyNodes(box, FieldView::Whole(const_cast<float*>(field.data()), scene.grid.nodes),
        FieldView::Part(to, box));
    };
    copy(scene.extinction, base);
    copy(scene.importance, importance);
  };
}

inline ControlGrid Coarser(int factor)
{
  ControlGrid grid;
  grid.factor = factor;
  return grid;
}
}

#endif
