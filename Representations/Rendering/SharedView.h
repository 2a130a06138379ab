// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

// A frame that processes draw together.

#ifndef limpid_SharedView_h
#define limpid_SharedView_h

#include "SceneLight.h"
#include "ViewGeometry.h"

#include "backend/Communicator.h"

namespace limpid
{
/// Makes the view of a frame, and its light in data coordinates, those of the first process: what
/// the others are told of the camera, and find of it, differs by rounding.
void TakeFirstOf(const Communicator& ranks, ViewGeometry& geometry);
void TakeFirstOf(const Communicator& ranks, ChosenLight& light);
}

#endif
