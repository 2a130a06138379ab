// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef limpid_optimize_FieldsOnDevice_h
#define limpid_optimize_FieldsOnDevice_h

#include "backend/CompiledDevice.h"
#include "backend/SumOnDevice.h"
#include "energy/TermOnDevice.h"
#include "optimize/Problem.h"

#include <memory>
#include <optional>

namespace limpid
{
/// What stays on a device as long as a scene does: its fields.
template <class Device>
struct FieldsOnDevice
{
  using Field = DeviceArray<Device, float>;

  FieldsOnDevice(std::shared_ptr<Device> device, const Problem& problem);

  std::shared_ptr<Device> device;
  Field base;
  Field importance;
  Field nodeImportance;

  /// Those of a problem, which are moved to the device when first asked for.
  static std::shared_ptr<FieldsOnDevice> Of(
    const std::shared_ptr<Device>& device, const Problem& problem);
};

/// What an iteration has changed, on a device.
struct ChangeOnDevice
{
  const float* after;
  const float* before; ///< null: `after` is the difference itself
};

/// The visibility terms of a problem on a device, see Terms, and what is measured there.
template <class Device>
class TermsOnDevice
{
public:
  using Field = DeviceArray<Device, float>;

  TermsOnDevice(std::shared_ptr<FieldsOnDevice<Device>> fields, const Problem& problem);

  /// Where a sweep that sees an extinction puts its sums, for the next record.
  double* SumsOfCamera() { return this->Sums.Data() + SeenByCamera; }
  double* SumsOfLight() { return this->Sums.Data() + SeenByLight; }

  /// Sums what an iteration has changed, for the next record.
  void SumChanges(const ChangeOnDevice& change);

  /// Energy and score of an extinction that all terms have seen. Waits.
  IterationRecord RecordOf(const Problem& problem, const Field& now);

  /// The same, after all terms have looked; leaves the optical depths of all rays in the terms.
  IterationRecord Measure(const Problem& problem, const Field& now);

  FieldsOnDevice<Device>& Fields() const { return *this->Resident; }

  std::optional<TermOnDevice<Device>> camera;
  std::optional<TermOnDevice<Device>> light;

private:
  /// Where the sums of a record are.
  enum SumOf : int
  {
    SeenByCamera,
    ThereForCamera,
    SeenByLight,
    ThereForLight,
    Squares,
    Changes,
    SumCount
  };

  std::shared_ptr<FieldsOnDevice<Device>> Resident;
  SumOnDevice<Device> Sum;
  DeviceArray<Device, double> Sums;
};
}

#endif
