// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

// What is taken for important of an array that processes share.

#ifndef limpid_StartingImportance_h
#define limpid_StartingImportance_h

#include "scene/StartingImportance.h"

namespace limpid
{
class SharedArray;

/// RampOf the array's values; of magnitudes, if there are several components.
ImportanceRamp StartingImportance(const SharedArray& array);
}

#endif
