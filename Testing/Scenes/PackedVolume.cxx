// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

// A volume as Testing/Gpu/pack-scenes.py writes it, for where there is no VTK.

#include "SceneFile.h"
#include "SceneVolume.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <fstream>
#include <stdexcept>

namespace truth
{
namespace
{
template <class Element>
void ReadAll(std::ifstream& file, Element* to, std::size_t count)
{
  file.read(
    reinterpret_cast<char*>(to), static_cast<std::streamsize>(count * sizeof(Element))); // NOLINT
}
}

void ReadVolume(const std::string& path, const std::string&, SceneFile& scene)
{
  std::ifstream file(path, std::ios::binary);
  std::array<std::int32_t, 3> nodes{};
  std::array<double, 2> range{};
  ReadAll(file, nodes.data(), nodes.size());
  ReadAll(file, scene.lattice.spacing.data(), 3);
  ReadAll(file, scene.lattice.origin.data(), 3);
  ReadAll(file, range.data(), range.size());
  if (!file || *std::min_element(nodes.begin(), nodes.end()) < 2)
  {
    throw std::runtime_error(path + " is missing or was not written by pack-scenes.py.");
  }
  std::copy(nodes.begin(), nodes.end(), scene.lattice.nodes.begin());
  std::vector<std::uint16_t> values(scene.lattice.Count());
  ReadAll(file, values.data(), values.size());
  if (!file)
  {
    throw std::runtime_error(path + " ends too early.");
  }
  scene.scalars.resize(values.size());
  std::transform(values.begin(), values.end(), scene.scalars.begin(),
    [&](std::uint16_t value) { return range[0] + (range[1] - range[0]) * value / 65535; });
}
}
