// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

// Lists of the tiles that have work in each phase of a sweep on a device.

#ifndef limpid_sweep_PhaseLists_h
#define limpid_sweep_PhaseLists_h

#include "backend/DeviceArray.h"
#include "backend/Extent.h"
#include "math/Macros.h"
#include "math/Vec.h"

#include <algorithm>
#include <cstddef>
#include <memory>
#include <vector>

namespace limpid
{
/// A phase in which at least one tile has work.
struct alignas(16) PhaseOfTiles
{
  int number;  ///< of all phases, also those without work
  int count;   ///< number of tiles
  Index first; ///< position of the first tile in PhasesOfTiles::numbers
};

/// The lists that a sweep reads.
struct PhasesOfTiles
{
  const int* numbers;
  const PhaseOfTiles* phases;
  int phaseCount;
  int mostTiles; ///< largest number of tiles in a phase
};

namespace detail
{
/// The marks of all tiles in all phases; a group is a number of successive tiles.
struct TileMarks
{
  static constexpr int group = 64;

  const unsigned char* marks; ///< [phase][tile]: whether it has work
  int tiles;
  int* found; ///< [phase][group]: marked tiles of the group; then those of the groups before it

  int GroupCount() const { return (this->tiles + group - 1) / group; }

  LIMPID_HD LIMPID_INLINE int EndOf(int number) const
  {
    const int end = (number + 1) * group;
    return end < this->tiles ? end : this->tiles;
  }

  LIMPID_HD LIMPID_INLINE int* FoundIn(Index phase) const
  {
    return this->found + phase * ((this->tiles + group - 1) / group);
  }

  /// Calls visit(tile) for the marked tiles of a group.
  template <class Visit>
  LIMPID_HD LIMPID_INLINE void ForMarked(int number, Index phase, const Visit& visit) const
  {
    for (int tile = number * group; tile < this->EndOf(number); ++tile)
    {
      if (this->marks[phase * this->tiles + tile] != 0)
      {
        visit(tile);
      }
    }
  }
};

template <class Mark>
struct MarkedTile
{
  Mark mark;
  int tiles;
  unsigned char* marks; ///< see TileMarks

  LIMPID_HD void operator()(int tile, int phase) const
  {
    this->marks[Index(phase) * this->tiles + tile] = this->mark(tile, phase) ? 1 : 0;
  }
};

struct CountedTiles
{
  TileMarks marks;

  LIMPID_HD void operator()(int group, int phase) const
  {
    int count = 0;
    this->marks.ForMarked(group, phase, [&count](int) { ++count; });
    this->marks.FoundIn(phase)[group] = count;
  }
};

struct SummedGroups
{
  TileMarks marks;
  int groups;
  int* counts; ///< [phase]

  LIMPID_HD void operator()(Index phase) const
  {
    int* found = this->marks.FoundIn(phase);
    int before = 0;
    for (int group = 0; group < this->groups; ++group)
    {
      const int here = found[group];
      found[group] = before;
      before += here;
    }
    this->counts[phase] = before;
  }
};

struct ListedTiles
{
  TileMarks marks;
  int* numbers; ///< [phase][]

  LIMPID_HD void operator()(int group, int phase) const
  {
    int* next =
      this->numbers + Index(phase) * this->marks.tiles + this->marks.FoundIn(phase)[group];
    this->marks.ForMarked(group, phase,
      [&next](int tile)
      {
        *next = tile;
        ++next;
      });
  }
};
}

/// Lists the tiles that have work in each phase.
template <class AnyDevice>
class PhaseLists
{
public:
  /// `mark(tile, phase)`: returns whether a tile has work, on the device.
  template <class Mark>
  PhaseLists(const std::shared_ptr<AnyDevice>& device, int tiles, int phases, const Mark& mark)
    : Device(device)
  {
    this->ListPhases(tiles, this->ListTiles(tiles, phases, mark));
  }

  const PhasesOfTiles& Lists() const { return this->Addresses; }

private:
  static constexpr const char* label = "plan";
  static constexpr const char* what = "the plan of a sweep";

  template <class Value>
  DeviceArray<AnyDevice, Value> Make(Index count) const
  {
    return { this->Device, static_cast<std::size_t>(count), what };
  }

  /// Returns the number of tiles in each phase.
  template <class Mark>
  std::vector<int> ListTiles(int tiles, int phases, const Mark& mark)
  {
    AnyDevice& device = *this->Device;
    DeviceArray<AnyDevice, unsigned char> bytes = this->Make<unsigned char>(Index(phases) * tiles);
    device.ForEach(label, { tiles, phases }, detail::MarkedTile<Mark>{ mark, tiles, bytes.Data() });
    detail::TileMarks marks{ bytes.Data(), tiles, nullptr };
    const int groups = marks.GroupCount();
    DeviceArray<AnyDevice, int> inGroups = this->Make<int>(Index(phases) * groups);
    DeviceArray<AnyDevice, int> counts = this->Make<int>(phases);
    this->Numbers = this->Make<int>(Index(phases) * tiles);
    marks.found = inGroups.Data();
    device.ForEach(label, { groups, phases }, detail::CountedTiles{ marks });
    device.ForIndices(label, phases, detail::SummedGroups{ marks, groups, counts.Data() });
    device.ForEach(label, { groups, phases }, detail::ListedTiles{ marks, this->Numbers.Data() });
    std::vector<int> found(static_cast<std::size_t>(phases));
    counts.Download(found.data());
    return found;
  }

  /// `counts`: number of tiles in each phase.
  void ListPhases(int tiles, const std::vector<int>& counts)
  {
    std::vector<PhaseOfTiles> phases;
    for (std::size_t phase = 0; phase < counts.size(); ++phase)
    {
      if (counts[phase] > 0)
      {
        phases.push_back({ static_cast<int>(phase), counts[phase], Index(phase) * tiles });
      }
    }
    this->Phases = { this->Device, phases, what };
    this->Addresses = { this->Numbers.Data(), this->Phases.Data(), static_cast<int>(phases.size()),
      *std::max_element(counts.begin(), counts.end()) };
  }

  std::shared_ptr<AnyDevice> Device;
  DeviceArray<AnyDevice, int> Numbers;
  DeviceArray<AnyDevice, PhaseOfTiles> Phases;
  PhasesOfTiles Addresses{};
};
}

#endif
