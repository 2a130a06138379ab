// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#include "render/HostTrace.h"

namespace limpid
{
template TraceOneRay HostTraceBy<Compositing::FrontToBack, false>(bool lit, bool overlaid);
template TraceOneRay HostTraceBy<Compositing::FrontToBack, true>(bool lit, bool overlaid);
}
