// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#include "methods/Method.h"

namespace limpid
{
const MethodInfo& InfoOf(Method method)
{
  static const MethodInfo all[methodCount] = {
    { "Optimized", Compositing::FrontToBack, true, false, true },
    { "Ordinary", Compositing::FrontToBack, false, false, true },
    { "Viola 2004", Compositing::FromObject, false, false, false },
    { "Marchesin 2010", Compositing::ImportanceMean, false, false, false },
    { "Ament 2017", Compositing::FrontToBack, false, true, true },
  };
  return all[static_cast<int>(method)];
}
}
