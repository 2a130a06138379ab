// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef truth_SceneVolume_h
#define truth_SceneVolume_h

#include <string>

namespace truth
{
struct SceneFile;

/// Sets the lattice and the scalars of a scene to an array of a .vti file; throws where it cannot
/// be read. A file of its own: VTK renames the library that reads JSON, so none may include both.
void ReadVolume(const std::string& path, const std::string& array, SceneFile& scene);
}

#endif
