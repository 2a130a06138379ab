// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef limpid_sweep_RayHere_h
#define limpid_sweep_RayHere_h

#include "sweep/RaySteps.h"

namespace limpid
{
namespace detail
{
/// The values that one ray carries (RayStates), kept in registers.
struct RayHere
{
  double opticalDepth = 0;
  double collected = 0;
  float behind = 0;
  float visible = notEntered;
  float unattenuated = 0;
  float transmittance = 1;
  float density = 0;
  float ahead = 0;
  float rearImportance = 0;
  float keptBehind = 0;
  float keptVisible = notEntered;
  float keptUnattenuated = 0;
  float alternativeBehind = 0;
  float cost = 0;
  float reach = 0;
  float effect = 0;
  float effectBehind = 0;

  LIMPID_HD LIMPID_INLINE RayStates States()
  {
    return { &this->opticalDepth, &this->collected, &this->behind, &this->visible,
      &this->unattenuated, &this->transmittance, &this->density, &this->ahead,
      &this->rearImportance, &this->keptBehind, &this->keptVisible, &this->keptUnattenuated,
      &this->alternativeBehind, &this->cost, &this->reach, &this->effect, &this->effectBehind };
  }

  LIMPID_HD LIMPID_INLINE void Load(const RayStates& ray)
  {
    this->opticalDepth = *ray.opticalDepth;
    this->behind = *ray.behind;
    this->visible = *ray.visible;
    this->unattenuated = *ray.unattenuated;
    this->transmittance = *ray.transmittance;
    this->density = *ray.density;
    this->keptBehind = *ray.keptBehind;
    this->keptVisible = *ray.keptVisible;
    this->keptUnattenuated = *ray.keptUnattenuated;
    this->effect = *ray.effect;
    this->effectBehind = *ray.effectBehind;
  }

  LIMPID_HD LIMPID_INLINE void Store(const RayStates& ray) const
  {
    *ray.opticalDepth = this->opticalDepth;
    *ray.behind = this->behind;
    *ray.visible = this->visible;
    *ray.unattenuated = this->unattenuated;
    *ray.transmittance = this->transmittance;
    *ray.density = this->density;
    *ray.keptBehind = this->keptBehind;
    *ray.keptVisible = this->keptVisible;
    *ray.keptUnattenuated = this->keptUnattenuated;
    *ray.effect = this->effect;
    *ray.effectBehind = this->effectBehind;
  }
};
}
}

#endif
