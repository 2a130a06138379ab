// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

// For the CUDA compiler.

#include "backend/LaunchEvents.h"

#include "backend/CudaDevice.h"

namespace limpid
{
LaunchEvents::~LaunchEvents()
{
  for (const Span& span : this->Spans)
  {
    for (cudaEvent_t event : { span.begin, span.end })
    {
      if (event)
      {
        cudaEventDestroy(event);
      }
    }
  }
}

void LaunchEvents::Begin(const Launch& launch)
{
  Span& span = this->Spans.emplace_back();
  span.launch = launch;
  LIMPID_CUDA(cudaEventCreate(&span.begin));
  LIMPID_CUDA(cudaEventCreate(&span.end));
  LIMPID_CUDA(cudaEventRecord(span.begin, this->Stream));
}

void LaunchEvents::End()
{
  cudaEventRecord(this->Spans.back().end, this->Stream); // Collect reports failures
}

void LaunchEvents::Collect()
{
  for (const Span& span : this->Spans)
  {
    float milliseconds = 0;
    LIMPID_CUDA(cudaEventElapsedTime(&milliseconds, span.begin, span.end));
    this->Times->Add(span.launch, 1e-3 * double(milliseconds));
  }
}
}
