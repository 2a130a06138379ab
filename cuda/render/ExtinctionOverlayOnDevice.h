// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef limpid_render_ExtinctionOverlayOnDevice_h
#define limpid_render_ExtinctionOverlayOnDevice_h

#include "backend/CompiledDevice.h"
#include "render/OverlayKernels.h"
#include "scene/Grid.h"

#include <memory>

namespace limpid
{
/// ExtinctionOverlay on a device. Arrays are there; nothing waits.
template <class Device>
class ExtinctionOverlayOnDevice
{
public:
  explicit ExtinctionOverlayOnDevice(std::shared_ptr<Device> device)
    : Home(std::move(device))
  {
  }

  /// See ExtinctionOverlay. `shown`: out, the extinction that is shown then [1/length]; null: not
  /// wanted.
  void MoveTo(const Grid& grid, const float* base, const float* extinction, float unit,
    double share, float* shown);

  void Clear();
  void ClearShadow();

  /// Takes a transmittance at the nodes of a grid over the same box, interpolated.
  void SetShadow(const Int3& nodes, const float* transmittance);

  const std::int16_t* Packed() const { return this->Numbers.Data(); }
  const Int3& Nodes() const { return this->Count; }
  float Majorant() const { return this->Unit; } ///< unit of what is added [1/length]
  bool Empty() const { return this->Numbers.Empty(); }

  /// Whether a change may not be zero: whether another extinction than the base was ever given.
  bool Changed() const { return this->MayChange; }

  bool Shadowed() const { return this->HasShadow; }

private:
  /// Makes room for the nodes of a grid, with what is shown now.
  void Fit(const Grid& grid);

  std::shared_ptr<Device> Home;
  DeviceArray<Device, std::int16_t> Numbers; ///< see OverlayField
  Grid Place;
  Int3 Count{ 0 };
  float Unit = 0;
  bool MayChange = false;
  bool HasShadow = false;
};

inline NodeCounts CountsOf(const Int3& nodes)
{
  return { nodes.x, nodes.y, nodes.z };
}
}

#endif
