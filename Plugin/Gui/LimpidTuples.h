// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef LimpidTuples_h
#define LimpidTuples_h

#include "math/Vec.h"

#include "vtkDataArray.h"
#include "vtkFieldData.h"

#include <string>
#include <vector>

/// The tuples of an array; zeros if there is no array.
class LimpidTuples
{
public:
  LimpidTuples(vtkFieldData* arrays, const std::string& name)
    : Array(arrays->GetArray(name.c_str()))
  {
  }

  /// Returns one vector for every three components of a tuple.
  std::vector<limpid::Vec3> Vectors(vtkIdType tuple) const
  {
    std::vector<limpid::Vec3> vectors;
    const int count = this->Array && this->Has(tuple) ? this->Array->GetNumberOfComponents() : 0;
    for (int i = 0; i + 2 < count; i += 3)
    {
      vectors.emplace_back(this->Array->GetComponent(tuple, i),
        this->Array->GetComponent(tuple, i + 1), this->Array->GetComponent(tuple, i + 2));
    }
    return vectors;
  }

  limpid::Vec3 Vector(vtkIdType tuple) const
  {
    const std::vector<limpid::Vec3> vectors = this->Vectors(tuple);
    return vectors.empty() ? limpid::Vec3(0.0) : vectors.front();
  }

  double Number(vtkIdType tuple) const
  {
    return this->Array && this->Has(tuple) ? this->Array->GetComponent(tuple, 0) : 0.0;
  }

private:
  bool Has(vtkIdType tuple) const { return tuple < this->Array->GetNumberOfTuples(); }

  vtkDataArray* Array;
};

#endif
