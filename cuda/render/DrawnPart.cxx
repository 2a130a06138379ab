// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#include "render/DrawnPart.h"

#include "distributed/FieldResampling.h"
#include "energy/TransmittanceOnRanks.h"
#include "math/Require.h"

namespace limpid
{
void DrawnPart::RequireOn(bool device) const
{
  LIMPID_REQUIRE(this->IsWhole() || !device,
    "Ranks share the picture, and a GPU draws it (distributed rendering is supported on CPUs "
    "only). Use the backend Auto or CPU.");
}

bool DrawnPart::HasSameNodes(const DrawnPart& other) const
{
  return this->All.nodes == other.All.nodes && this->Box() == other.Box();
}

bool DrawnPart::Covers(const DrawnPart& other) const
{
  return this->Box() == NodeBox::Of(this->All.nodes) || this->HasSameNodes(other);
}

DrawnPart DrawnPart::Coarse(int factor) const
{
  return factor > 1 ? DrawnPart(CoarseGrid(this->All, factor)) : *this;
}

float DrawnPart::LargestOf(float here) const
{
  return this->Shared->ranks->LargestOf(here);
}

bool DrawnPart::AnyOf(bool here) const
{
  return this->Shared->ranks->AnyOf(here);
}

void DrawnPart::Resample(const float* field, const Grid& to, float* result) const
{
  ResampleForAll(*this->Shared, this->All, field, to, result);
}

void DrawnPart::FillTransmittance(
  const float* extinction, const RaySource& source, double rayDensity, float* transmittance) const
{
  FindTransmittanceOnRanks(this->All, *this->Shared, source, rayDensity, extinction, transmittance);
}
}
