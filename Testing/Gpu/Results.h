// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

// What is measured. A figure that could not be had says why.

#ifndef limpid_testing_gpu_Results_h
#define limpid_testing_gpu_Results_h

#include <cstddef>
#include <string>
#include <vector>

namespace limpid::benchmark
{
/// Wall time, median of the repetitions.
struct Figure
{
  double seconds = 0;
  double spread = 0; ///< range of the repetitions over their median
  int repetitions = 0;
  std::string missing = "not measured"; ///< why there is no figure; empty: there is

  bool Measured() const { return this->missing.empty(); }
};

/// Launches of a kind in one iteration, by the device's own clock.
struct Part
{
  std::string name;
  double launches = 0;
  double seconds = 0;
  double bytes = 0; ///< see Traffic.h; 0: not counted
};

struct IterationResult
{
  Figure wall;
  std::vector<Part> parts;
  double bytes = 0;             ///< of all parts
  std::size_t deviceMemory = 0; ///< most that was allocated at a time [bytes]
};

struct SceneResult
{
  std::string name;
  int nodes = 0;     ///< along each axis
  double filled = 0; ///< share of the voxels that are swept [0, 1]

  Figure prepare; ///< host: checks, importance of nodes, spans; once per scene
  Figure upload;  ///< the fields of a scene; once per scene
  Figure plan;    ///< host: the rays of camera and light; once per view
  Figure begin;   ///< plan, tables and first iterate on the device; once per view
  IterationResult policy;
  IterationResult adam;
  Figure run; ///< `begin` and iterations with default settings until they converge
  int runIterations = 0;
  Figure download; ///< the result
  Figure sphere;   ///< scores of `directions` directions
  int directions = 0;
  Figure picture;       ///< 1024 x 1024 pixels of another extinction, with its shadows
  Figure pictureAtRest; ///< ... of the same extinction
  Figure processor;     ///< a policy iteration on the processor of the same machine
};

struct DeviceResult
{
  std::string name;
  Figure copy;          ///< from one place on the device to another
  double copyBytes = 0; ///< read and written by it
  std::vector<SceneResult> scenes;

  /// Bytes read and written per second; 0: not measured.
  double Bandwidth() const
  {
    return this->copy.Measured() ? this->copyBytes / this->copy.seconds : 0.0;
  }
};
}

#endif
