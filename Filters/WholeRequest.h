// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef limpid_WholeRequest_h
#define limpid_WholeRequest_h

#include "vtkInformation.h"
#include "vtkStreamingDemandDrivenPipeline.h"

namespace limpid
{
/// Requests all of an input in one piece, whichever piece is requested from the filter.
inline void RequestWhole(vtkInformation* info)
{
  using Pipeline = vtkStreamingDemandDrivenPipeline;
  info->Set(Pipeline::UPDATE_PIECE_NUMBER(), 0);
  info->Set(Pipeline::UPDATE_NUMBER_OF_PIECES(), 1);
  info->Set(Pipeline::UPDATE_NUMBER_OF_GHOST_LEVELS(), 0);
  if (info->Has(Pipeline::WHOLE_EXTENT()))
  {
    info->Set(Pipeline::UPDATE_EXTENT(), info->Get(Pipeline::WHOLE_EXTENT()), 6);
  }
}
}

#endif
