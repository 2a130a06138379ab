// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

// Prints the visibility score of a scene, or of a raw float32 extinction array on its nodes, by the
// independent ray march.

#include "RayMarch.h"
#include "SceneFile.h"

#include <chrono>
#include <cstdlib>
#include <exception>
#include <fstream>
#include <iostream>
#include <stdexcept>
#include <string>
#include <vector>

namespace
{
std::vector<float> ReadRaw(const std::string& path, std::size_t count)
{
  std::ifstream file(path, std::ios::binary | std::ios::ate);
  if (!file || static_cast<std::size_t>(file.tellg()) != count * sizeof(float))
  {
    throw std::runtime_error(
      path + " is missing or does not hold " + std::to_string(count) + " float32 values.");
  }
  std::vector<float> values(count);
  file.seekg(0);
  file.read(
    reinterpret_cast<char*>(values.data()), static_cast<std::streamsize>(count * sizeof(float)));
  return values;
}

void Print(const std::string& scenePath, const std::string& extinctionPath,
  const truth::Sampling& sampling, bool fromLight)
{
  const truth::SceneFile scene = truth::ReadSceneFile(scenePath);
  const std::vector<float> extinction =
    extinctionPath.empty() ? scene.extinction : ReadRaw(extinctionPath, scene.scalars.size());
  const truth::Volume<float> volume = scene.FieldsWith(extinction);

  const auto start = std::chrono::steady_clock::now();
  const double score =
    truth::VisibilityScore(volume, fromLight ? scene.Lamp() : scene.Eye(), sampling);
  const double total = truth::ImportantExtinction(volume);
  const std::chrono::duration<double> seconds = std::chrono::steady_clock::now() - start;

  std::cout.precision(10);
  std::cout << scene.name << "  S " << score << "  total " << total << "  fraction "
            << (total > 0 ? score / total : 0) << "  seconds " << seconds.count() << "\n";
}
}

int main(int count, char** arguments)
{
  truth::Sampling sampling;
  std::vector<std::string> files;
  bool fromLight = false;
  for (int n = 1; n < count; ++n)
  {
    const std::string argument = arguments[n];
    const bool hasValue = n + 1 < count;
    if (argument == "--rays" && hasValue)
    {
      sampling.raysPerVoxel = std::atof(arguments[++n]);
    }
    else if (argument == "--samples" && hasValue)
    {
      sampling.samplesPerVoxel = std::atoi(arguments[++n]);
    }
    else if (argument == "--light")
    {
      fromLight = true;
    }
    else
    {
      files.push_back(argument);
    }
  }
  if (files.empty() || files.size() > 2 || sampling.raysPerVoxel <= 0 ||
    sampling.samplesPerVoxel < 1)
  {
    std::cerr << "usage: limpid_march_score SCENE.json [EXTINCTION.raw] [--rays PER_VOXEL] "
                 "[--samples PER_VOXEL] [--light]\n"
                 "EXTINCTION.raw: float32, one value per node, first axis fastest [1/length].\n"
                 "--light: seen from the light instead of the camera.\n";
    return 2;
  }
  try
  {
    Print(files[0], files.size() > 1 ? files[1] : "", sampling, fromLight);
    return 0;
  }
  catch (const std::exception& error)
  {
    std::cerr << error.what() << "\n";
    return 1;
  }
}
