// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#include "render/HostTrace.h"

namespace limpid
{
template TraceOneRay HostTraceBy<Compositing::FromObject, false>(bool lit, bool overlaid);
template TraceOneRay HostTraceBy<Compositing::FromObject, true>(bool lit, bool overlaid);
}
