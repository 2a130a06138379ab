// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#include "Head.h"

#include "PhantomScenes.h"

#include "backend/Backend.h"

namespace limpid::benchmark
{
SceneOfFile MakeHead(int nodes)
{
  truth::SceneFile head;
  head.name = "phantom_head";
  head.extinctionPoints = { { 0.0, 0.0 }, { 0.15, 1.5 }, { 0.25, 3.0 }, { 0.4, 9.0 },
    { 0.65, 14.0 }, { 0.85, 25.0 }, { 1.0, 25.0 } };
  head.colorPoints = { { 0.0, 0.2, 0.15, 0.2 }, { 0.15, 0.75, 0.5, 0.55 },
    { 0.25, 0.8, 0.45, 0.35 }, { 0.4, 0.87, 0.66, 0.53 }, { 0.55, 0.9, 0.85, 0.7 },
    { 0.65, 0.95, 0.92, 0.8 }, { 0.75, 0.8, 0.2, 0.15 }, { 0.85, 0.75, 0.05, 0.1 },
    { 0.93, 0.3, 0.7, 0.3 }, { 1.0, 0.1, 0.8, 0.35 } };
  head.majorant = 25.0;
  head.cameraPosition = { 1.9, -4.7, 1.5 };
  head.cameraFocalPoint = { 0.0, 0.0, 0.0 };
  head.cameraViewUp = { 0.0, 0.0, 1.0 };
  head.cameraViewAngle = 30.0;
  head.lightPosition = { -2.5, -4.5, 4.5 };

  const double spacing = 2.0 / (nodes - 1);
  const double edge = PhantomEdge(spacing);
  head.lattice.nodes = { nodes, nodes, nodes };
  head.lattice.spacing = { spacing, spacing, spacing };
  head.lattice.origin = { -1.0, -1.0, -1.0 };
  const std::size_t count = std::size_t(nodes) * nodes * nodes;
  head.scalars.resize(count);
  head.extinction.resize(count);
  head.importance.resize(count);
  ParallelFor(nodes,
    [&](Index k)
    {
      std::size_t node = std::size_t(k) * nodes * nodes;
      for (int j = 0; j < nodes; ++j)
      {
        for (int i = 0; i < nodes; ++i, ++node)
        {
          const Material material =
            HeadScene({ i * spacing - 1.0, j * spacing - 1.0, k * spacing - 1.0 }, edge);
          head.scalars[node] = float(material.scalar);
          head.extinction[node] =
            float(truth::PiecewiseLinear(head.extinctionPoints, material.scalar));
          head.importance[node] = float(material.importance);
        }
      }
    });
  return SceneOfFile(std::move(head));
}
}
