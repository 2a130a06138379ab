// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef limpid_render_RendererOnDevice_h
#define limpid_render_RendererOnDevice_h

#include "backend/CompiledDevice.h"
#include "energy/TransmittanceVolume.h"
#include "render/BrickKernels.h"
#include "render/ExtinctionOverlayOnDevice.h"
#include "render/GradientKernels.h"
#include "render/PictureEngine.h"

#include <memory>
#include <optional>
#include <vector>

namespace limpid
{
/**
 * What a Renderer does, on a device. All fields stay there; what travels is what the renderer was
 * given anew, the depths of opaque things, and the picture back. Only Cast and LightTransmittanceAt
 * wait.
 *
 * Bytes on the device per node: scalars 4, gradient 8, overlay 8, what casts the shadows 4, and 8
 * for two extinctions on their way in or a transmittance; 28 in all when extinctions are there
 * already, 32 otherwise. At 256^3 nodes: 0.47 or 0.54 GB, and the plan of the shadows (0.1 GB).
 *
 * Bytes that a picture moves, counted: 1024^2 pixels of which half see a box of 256^3 nodes, 92 M
 * samples at the distance of the nodes if nothing is empty or opaque. A lit sample in a overlay
 * reads 8 scalars, 8 nodes each of overlay and gradient, and 4 entries of the table: 224
 * bytes, 20.6 GB through the first-level caches; its neighbours read the same nodes, and the fields
 * themselves are 0.34 GB. The picture that comes back is 4.2 MB, as are the depths that go there,
 * if any. With new shadows add those of TransmittanceVolumeOnDevice.
 */
template <class Device>
class RendererOnDevice : public PictureEngine
{
public:
  explicit RendererOnDevice(std::shared_ptr<Device> device);

  void SetScalars(const Grid& grid, const float* scalars) override;
  void SetTransferFunctions(const Classification& classification) override;
  void SetExtinction(const Grid& grid, const float* base, const float* extinction, double share,
    const float* lightExtinction) override;
  void ShowThere(const Grid& grid, const float* base, const float* extinction, double share,
    const float* lightExtinction) override;
  void UseTransferFunction(const Grid& grid) override;
  void ClearExtinction() override;
  bool HasNoExtinction() const override { return this->Shown.Empty(); }
  void CastShadows(const Grid& grid, const RaySource& light, double rayDensity) override;
  void ClearShadows() override { this->Shown.ClearShadow(); }
  void FindGradient() override;
  void FindEmptyBricks() override;
  void Cast(const Casting& casting, const View& view, Picture& picture) override;
  double LightTransmittanceAt(const Vec3& position) override;

private:
  using Field = DeviceArray<Device, float>;

  /// The shadows' rays from one light through one grid, whatever the extinction.
  struct ShadowPlan
  {
    Grid grid;
    RaySource light;
    double rayDensity;
    TransmittanceSweep<Device> volume;

    bool IsOf(const Grid& nodes, const RaySource& eye, double density) const;
  };

  /// An array of at least so many values, whose content is lost if it has to grow.
  template <class Value>
  static Value* RoomFor(DeviceArray<Device, Value>& array, std::size_t count,
    const std::shared_ptr<Device>& device, const char* what);

  ClassifiedNode Classified() const;
  NodeCounts BrickCounts() const;
  RaySceneOf<FourFloats> SceneOf(const Casting& casting) const;
  void Restrict(const Grid& from, const float* field, const Grid& to, Field& result);
  const float* ShadowExtinction(const Grid& grid);
  void PlanShadows(const Grid& grid, const RaySource& light, double rayDensity);

  std::shared_ptr<Device> Home;
  Grid Scene; ///< of the scalars
  Field Scalars;
  Field Filled; ///< empty: all nodes are
  DeviceArray<Device, FourFloats> Entries;
  DeviceArray<Device, FourFloats> Integrals;
  Field Largest; ///< see OpticalTable
  OpticalTable<FourFloats> Table;
  float Majorant = 0;
  DeviceArray<Device, std::int16_t> Gradient;
  Field Steepness; ///< lanes of the search for the largest gradient
  DeviceArray<Device, ScalarRange> Ranges;
  DeviceArray<Device, std::uint8_t> Distance;
  DeviceArray<Device, std::uint8_t> OtherDistance; ///< between the axes

  ExtinctionOverlayOnDevice<Device> Shown;
  Grid ExtinctionGrid;
  Field Opaque;       ///< casts the shadows, at the nodes of the extinction
  Field CoarseOpaque; ///< the same on a coarser grid; empty: not current, or not wanted
  Int3 CoarseNodes{ 0 };
  Field Passing; ///< two extinctions that arrive, or transmittance; may be larger
  std::optional<ShadowPlan> Plan;
  Field Depth;
  DeviceArray<Device, std::uint32_t> Pixels;
};

/// Draws for a Renderer on a device.
template <class Device>
std::unique_ptr<PictureEngine> PicturesOn(std::shared_ptr<Device> device);
}

#endif
