// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

// Tables in one block of memory that host and device read in the same way. Copying the block
// copies all tables.

#ifndef limpid_sweep_FlatTables_h
#define limpid_sweep_FlatTables_h

#include "math/Macros.h"
#include "math/Require.h"
#include "math/Vec.h"

#include <cstdlib>
#include <limits>
#include <memory>
#include <new>

namespace limpid
{
/// Linear interpolation of a row: target t is the sum of source[index[t]] and source[index[t] + 1]
/// with the weights 1 - weight[t] and weight[t].
struct LinearMap
{
  const int* index;
  const float* weight;
};

/// Location of a table of `Value` in FlatTables: rows of equal length.
template <class Value>
struct Table
{
  Index offset = 0; ///< of the first row, relative to FlatTables::tables [bytes]
  int rowLength = 0;
};

/// Returns a map whose targets count from `begin`.
LIMPID_HD LIMPID_INLINE LinearMap From(const LinearMap& map, int begin)
{
  return { map.index - begin, map.weight - begin };
}

struct MapTable
{
  Table<int> index;
  Table<float> weight;
};

/// Base address of all tables. Derived classes declare the tables.
struct FlatTables
{
  const unsigned char* tables = nullptr;

  /// Returns row `row` of a table. No table has 2^31 values or more.
  template <class Value>
  LIMPID_HD LIMPID_INLINE const Value* Row(const Table<Value>& table, int row = 0) const
  {
    return reinterpret_cast<const Value*>(this->tables + table.offset) + row * table.rowLength;
  }

  template <class Value>
  LIMPID_HD LIMPID_INLINE Value At(const Table<Value>& table, int row, int column) const
  {
    return this->Row(table)[row * table.rowLength + column];
  }

  LIMPID_HD LIMPID_INLINE LinearMap Row(const MapTable& table, int row) const
  {
    return { this->Row(table.index, row), this->Row(table.weight, row) };
  }
};

/// Tables that are being filled.
template <class Tables>
struct WritableTables : Tables
{
  WritableTables() = default;

  LIMPID_HD explicit WritableTables(const Tables& tables)
    : Tables(tables)
  {
  }

  /// Returns a row of a table for writing.
  template <class Value>
  LIMPID_HD LIMPID_INLINE Value* Room(const Table<Value>& table, int row = 0) const
  {
    return const_cast<Value*>(this->Row(table, row));
  }
};

/// Tables together with the memory that holds them.
template <class Tables>
struct OwnedTables : WritableTables<Tables>
{
  struct Free
  {
    void operator()(unsigned char* room) const noexcept { std::free(room); }
  };
  std::unique_ptr<unsigned char[], Free> memory; ///< the block that `tables` points to
  std::size_t bytes = 0;
};

/// Lays out tables in one block of memory and allocates it.
class TableRoom
{
public:
  template <class Value>
  void Add(Table<Value>& table, Index rows, int rowLength)
  {
    constexpr Index alignment = 256;
    LIMPID_EXPECT(rows * rowLength <= std::numeric_limits<int>::max());
    table.offset = this->End;
    table.rowLength = rowLength;
    const Index end = this->End + rows * rowLength * Index(sizeof(Value));
    this->End = (end + alignment - 1) / alignment * alignment;
  }

  void Add(MapTable& table, Index rows, int rowLength)
  {
    this->Add(table.index, rows, rowLength);
    this->Add(table.weight, rows, rowLength);
  }

  /// Allocates the block, filled with zeros. For large blocks the system provides zero pages.
  template <class Tables>
  void Give(OwnedTables<Tables>& to) const
  {
    to.bytes = this->Bytes();
    to.memory.reset(static_cast<unsigned char*>(std::calloc(to.bytes, 1)));
    if (!to.memory)
    {
      throw std::bad_alloc();
    }
    to.tables = to.memory.get();
  }

  /// Size of all tables so far [bytes].
  std::size_t Bytes() const { return static_cast<std::size_t>(this->End); }

private:
  Index End = 0;
};
}

#endif
