// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef limpid_energy_TermOnDevice_h
#define limpid_energy_TermOnDevice_h

#include "backend/SumOnDevice.h"
#include "energy/TermKernels.h"
#include "energy/VisibilityTerm.h"
#include "sweep/FrustumOnDevice.h"

#include <memory>
#include <vector>

namespace limpid
{
/// The rays of one frustum on a device.
template <class Device>
class RaysOnDevice
{
public:
  RaysOnDevice(const std::shared_ptr<Device>& device, const FaceFrustum& frustum, const Grid& grid,
    const Occupancy& occupancy);

  const FrustumOnDevice<Device>& Plan() const { return this->Tables; }
  RayStates States();

  /// As at the back of the volume: nothing is behind. Optical depths stay.
  void Reset();

  /// Makes what was collected the optical depths.
  void KeepCollected() { this->Swapped = !this->Swapped; }

private:
  std::shared_ptr<Device> Home;
  FrustumOnDevice<Device> Tables;
  DeviceArray<Device, double> OpticalDepths; ///< two images
  DeviceArray<Device, float> Others;         ///< the other states, one behind another
  bool Swapped = false;                      ///< whether the second image has the optical depths
};

/// VisibilityTerm on a device: the fields are addresses there. Nothing waits.
template <class Device>
class TermOnDevice
{
public:
  TermOnDevice(std::shared_ptr<Device> device, const Grid& grid, const Occupancy& occupancy,
    const RaySource& eye, double rayDensity);

  /// Integral of g mu T and its bound into `sums` (2 values on the device); leaves the optical
  /// depths of all rays.
  void Forward(const float* extinction, const float* importance, double* sums);

  /// The same of the rays of one frustum, as far as their totals.
  void ForwardAt(std::size_t frustum, const float* extinction, const float* importance);

  /// The same; also finds the derivative. Leaves no optical depths.
  void Differentiate(
    const TermFields& fields, Derivative derivative, const GradientTarget& target, double* sums);

  std::vector<RaysOnDevice<Device>>& Frusta() { return this->Rays; }
  std::size_t FrustumCount() const { return this->Rays.size(); }

  /// Where the rays of a frustum tell what they have added up to.
  RayTotals TotalsOf(std::size_t frustum);

  /// Integral of g mu T and its bound, from the totals of all rays.
  void SumTotals(double* sums);

private:
  std::size_t MostRays() const;

  std::shared_ptr<Device> Home;
  std::vector<RaysOnDevice<Device>> Rays;
  SumOnDevice<Device> Sum;
  std::vector<std::size_t> First;      ///< of each frustum, in what is gathered
  DeviceArray<Device, float> Gathered; ///< of all frusta: visible importance, and its bound
  DeviceArray<Device, double> Shares;  ///< of all frusta, see FrustumView
  DeviceArray<Device, float> Images;   ///< see BackwardRay; made when first needed
};
}

#endif
