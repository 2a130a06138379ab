// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

// Compiled for each device, see CompiledDevice.h.

#include "backend/CompiledDevice.h"
#include "methods/Ament2017.h"
#include "methods/Marchesin2010.h"
#include "methods/MethodScene.h"
#include "methods/Viola2004.h"

namespace limpid
{
template <class AnyDevice>
MethodPasses<AnyDevice> PassesOf(Method method)
{
  switch (method)
  {
    case Method::Viola2004:
      return { &FindViola2004<AnyDevice>, nullptr };
    case Method::Marchesin2010:
      return { nullptr, &SeeMarchesin2010<AnyDevice> };
    case Method::Ament2017:
      return { &FindAment2017<AnyDevice>, nullptr };
    case Method::Optimized:
    case Method::Ordinary:
      break;
  }
  return {};
}

template MethodPasses<CompiledDevice> PassesOf(Method);
}
