// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef limpid_testing_benchmarks_Head_h
#define limpid_testing_benchmarks_Head_h

#include "SceneForSolver.h"

namespace limpid::benchmark
{
/// The head of vtkOcclusionPhantom with the functions, camera and light of phantom_scene in
/// Documentation/Examples/scenes.py: the scene that the page of peers draws. `nodes`: along each
/// axis of [-1, 1]^3.
SceneOfFile MakeHead(int nodes);
}

#endif
