// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

// Agreement on a frame that processes draw together.

#ifndef limpid_SharedView_h
#define limpid_SharedView_h

#include "SceneLight.h"
#include "ViewGeometry.h"

#include "distributed/Communicator.h"

namespace limpid
{
/// Broadcasts the view of a frame and its light in data coordinates from the first process, since
/// those of the other processes differ by rounding.
void TakeFirstOf(const Communicator& ranks, ViewGeometry& geometry);
void TakeFirstOf(const Communicator& ranks, ChosenLight& light);
}

#endif
