// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

// Lists of the tiles that have work in each phase of a sweep on a device.

#ifndef limpid_sweep_PhaseLists_h
#define limpid_sweep_PhaseLists_h

#include "backend/DeviceArray.h"
#include "backend/Extent.h"
#include "math/Macros.h"
#include "math/Vec.h"

#include <cstddef>
#include <memory>

namespace limpid
{
/// A phase in which at least one tile has work.
struct alignas(16) PhaseOfTiles
{
  int number;  ///< of all phases, also those without work
  int count;   ///< number of tiles
  Index first; ///< position of the first tile in PhasesOfTiles::numbers
};

/// The lists that a sweep reads. They are made on the device, and the host does not wait for them.
struct PhasesOfTiles
{
  const int* numbers;         ///< on the device
  const PhaseOfTiles* phases; ///< on the device
  const int* phaseCount;      ///< on the device
  int mostTiles;              ///< no phase has more tiles
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

/// Lists the phases that have tiles.
struct ListedPhases
{
  const int* counts; ///< [phase]: number of tiles
  int all;           ///< number of phases, with those without tiles
  int tiles;
  PhaseOfTiles* phases;
  int* phaseCount;

  LIMPID_HD void operator()(Index phase) const
  {
    int before = 0;
    for (Index other = 0; other < phase; ++other)
    {
      before += this->counts[other] > 0 ? 1 : 0;
    }
    const int count = this->counts[phase];
    if (count > 0)
    {
      this->phases[before] = { static_cast<int>(phase), count, phase * this->tiles };
    }
    if (phase + 1 == this->all)
    {
      *this->phaseCount = before + (count > 0 ? 1 : 0);
    }
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
    , Numbers(this->Make<int>(Index(phases) * tiles))
    , Phases(this->Make<PhaseOfTiles>(phases))
    , PhaseCount(this->Make<int>(1))
    , MostTiles(tiles)
  {
    this->ListPhases(phases, this->ListTiles(phases, mark));
  }

  PhasesOfTiles Lists() const
  {
    return { this->Numbers.Data(), this->Phases.Data(), this->PhaseCount.Data(), this->MostTiles };
  }

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
  DeviceArray<AnyDevice, int> ListTiles(int phases, const Mark& mark)
  {
    AnyDevice& device = *this->Device;
    const int tiles = this->MostTiles;
    DeviceArray<AnyDevice, unsigned char> bytes = this->Make<unsigned char>(Index(phases) * tiles);
    device.ForEach(label, { tiles, phases }, detail::MarkedTile<Mark>{ mark, tiles, bytes.Data() });
    detail::TileMarks marks{ bytes.Data(), tiles, nullptr };
    const int groups = marks.GroupCount();
    DeviceArray<AnyDevice, int> inGroups = this->Make<int>(Index(phases) * groups);
    DeviceArray<AnyDevice, int> counts = this->Make<int>(phases);
    marks.found = inGroups.Data();
    device.ForEach(label, { groups, phases }, detail::CountedTiles{ marks });
    device.ForIndices(label, phases, detail::SummedGroups{ marks, groups, counts.Data() });
    device.ForEach(label, { groups, phases }, detail::ListedTiles{ marks, this->Numbers.Data() });
    return counts;
  }

  /// `counts`: number of tiles in each phase.
  void ListPhases(int phases, const DeviceArray<AnyDevice, int>& counts)
  {
    this->Device->ForIndices(label, phases,
      detail::ListedPhases{
        counts.Data(), phases, this->MostTiles, this->Phases.Data(), this->PhaseCount.Data() });
  }

  std::shared_ptr<AnyDevice> Device;
  DeviceArray<AnyDevice, int> Numbers;         ///< [phase][]
  DeviceArray<AnyDevice, PhaseOfTiles> Phases; ///< as many as there are phases; the first are set
  DeviceArray<AnyDevice, int> PhaseCount;
  int MostTiles;
};
}

#endif
