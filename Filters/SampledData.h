// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

// Images of data whose points are not uniformly spaced.

#ifndef limpid_SampledData_h
#define limpid_SampledData_h

#include "vtkLimpidFiltersModule.h" // for export macro
#include "vtkSmartPointer.h"
#include "vtkType.h"

#include <array>
#include <set>
#include <string>

class vtkDataObject;
class vtkImageData;
class vtkInformationVector;

namespace limpid
{
class Communicator;

/// How to sample data.
struct DataSampling
{
  std::array<int, 3> dimensions{ { 0, 0, 0 } }; ///< points along each axis; 0: see SampleData
  vtkIdType mostPoints = 0;     ///< for dimensions that are chosen; 0: as memory allows
  std::set<std::string> labels; ///< point arrays that are never interpolated

  /// The arrays that are wanted; "": the active scalars. If there are none, or one of them is
  /// missing, all arrays are sampled, so that messages can name them.
  std::set<std::string> wanted;
  std::set<std::string> further; ///< arrays that are sampled, too, if they are there
  bool isWholeOnAll = false;     ///< whether each rank gets the whole image instead of a piece
};

/// An image of data.
struct SampledData
{
  vtkSmartPointer<vtkImageData> image;                  ///< on ranks, a piece of it
  std::array<int, 6> extent{ { 0, -1, 0, -1, 0, -1 } }; ///< of the whole image
  std::string text; ///< such as "sampled at 100 x 80 x 60 points"
};

/**
 * Samples a data set, or all those of a collection, at the points of an image over their bounds.
 * Point arrays are interpolated in the cells, those of labels taken from the nearest point; cell
 * arrays have the values of the cells in which the cells of the image have their centres. Points
 * that are in no cell, or in cells that are blanked, are blanked (vtkGhostType). Of overlapping
 * data, the finest level of an AMR and otherwise the first block counts.
 *
 * Dimensions that are not given are such that the image is as fine as the data: the distance of
 * points along an axis is the median of the cells' extents along it, on the finest level of an
 * AMR; or larger, if the image would have too many points. Rectilinear grids are sampled as finely
 * as their thinnest layers (a twentieth may be thinner), unless that makes more than four million
 * points and four per cell.
 *
 * Ranks, each of which has some of the data, get pieces of the image; points that several have are
 * sampled by the first. Collective.
 *
 * Throws limpid::Error if no cell has a volume.
 */
VTKLIMPIDFILTERS_EXPORT SampledData SampleData(
  vtkDataObject* data, const DataSampling& sampling, const Communicator& ranks);

/// Returns the information of an input port with samples in place of its data.
VTKLIMPIDFILTERS_EXPORT vtkSmartPointer<vtkInformationVector> WithImage(
  vtkInformationVector* input, const SampledData& sampled);
/// Copies data to `output`, with the arrays that `result` has in addition to the image that it was
/// made of: point arrays are interpolated at the points of the data, or at the centres of the cells
/// of a hyper tree grid, which has no points; field data are copied. Collective.
VTKLIMPIDFILTERS_EXPORT void BringBack(const SampledData& sampled, vtkImageData* result,
  vtkDataObject* data, vtkDataObject* output, const Communicator& ranks);
}

#endif
