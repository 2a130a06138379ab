// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

// Files of images and segmentations: NIfTI, NRRD and MetaImage.

#ifndef limpid_ImageFile_h
#define limpid_ImageFile_h

#include "StructureLooks.h"
#include "VoxelFile.h"

#include "vtkSmartPointer.h"

#include "scene/Grid.h"

#include <array>
#include <cstdint>
#include <string>
#include <vector>

class vtkDataArray;

namespace limpid
{
/// A segment of a segmentation.
struct Segment
{
  std::int64_t label = 0;
  StructureLook look;
  int layer = 0; ///< which of the values of each point has its label
};

/// What the header of a file says. The world is that of NRRD and MetaImage files and of DICOM: x
/// towards the patient's left, y towards the back, z towards the head.
struct ImageFile
{
  Grid grid;        ///< of the values in the order of the file
  int type = 0;     ///< of VTK; VTK_VOID: not supported
  int layers = 1;   ///< values per point, stored one after the other
  double slope = 1; ///< values are slope times those stored, plus intercept
  double intercept = 0;
  VoxelFile voxels;
  std::vector<Segment> segments; ///< empty: the file has no names
};

/// Reads the header of a file; the end of its name says which format it has. Throws Error.
ImageFile ReadImageHeader(const std::string& path);

/// Which axes of a file become those of an image, in their order. Displays of ParaView ignore
/// directions, so those of the image are as near to the axes of the world as they can.
struct AxisOrder
{
  explicit AxisOrder(const Grid& file);

  std::array<int, 3> from;         ///< axis of the file
  std::array<bool, 3> isBackwards; ///< whether it is passed from its end
};

/// Returns the grid of the image. Its points are those of the file.
Grid InOrder(const Grid& file, const AxisOrder& order);

/// Reads the values of a layer in this order, x fastest. Throws Error if the file is too short or
/// damaged.
vtkSmartPointer<vtkDataArray> ReadValues(const ImageFile& file, int layer, const AxisOrder& order);

///@{
/// Reads a header of one format, see ReadImageHeader.
ImageFile ReadNiftiHeader(const std::string& path);
ImageFile ReadNrrdHeader(const std::string& path);
ImageFile ReadMetaHeader(const std::string& path);
///@}

/// Returns the grid of an image of which point `index` is at origin + steps index. Throws Error.
Grid GridOfSteps(const Int3& nodes, const Vec3& origin, const Mat3& steps);
}

#endif
