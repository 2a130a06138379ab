// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

/**
 * @class   vtkOcclusionPhantom
 * @brief   generate a volume in which important structures are hidden
 *
 * Procedural test volumes on [-1, 1]^3 with point arrays
 *   "Scalars"        a value per material [0, 1],
 *   "Importance"     importance of the structure [0, 1],
 *   "BaseExtinction" extinction of the material [1/length].
 * Shapes have smooth edges, at least one and a half voxels wide, so that results do not depend on
 * the position of the grid.
 *
 * Scenes:
 *   HEAD         skin and soft tissue around a skull, with two vessels and a tumour inside;
 *   FLAME        a flickering plume of hot gas with a thin reaction front inside;
 *   SHELLS       four nested spheres; the inner ones are more important;
 *   HOMOGENEOUS  extinction 1 and importance 1 everywhere, for comparison with closed forms;
 *   VESSELS      thin vessels in tissue with noise, which is constant within cells of size 1/64.
 *
 * @sa vtkExtinctionOptimizer
 */

#ifndef vtkOcclusionPhantom_h
#define vtkOcclusionPhantom_h

#include "vtkImageAlgorithm.h"
#include "vtkLimpidFiltersModule.h" // for export macro

class VTKLIMPIDFILTERS_EXPORT vtkOcclusionPhantom : public vtkImageAlgorithm
{
public:
  static vtkOcclusionPhantom* New();
  vtkTypeMacro(vtkOcclusionPhantom, vtkImageAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  enum Scenes
  {
    HEAD = 0,
    FLAME = 1,
    SHELLS = 2,
    HOMOGENEOUS = 3,
    VESSELS = 4
  };

  ///@{
  /**
   * Number of points along each axis, in [2, 4096]. Default is 64.
   */
  vtkSetClampMacro(Resolution, int, 2, 4096);
  vtkGetMacro(Resolution, int);
  ///@}

  ///@{
  /**
   * The scene to generate. Default is HEAD.
   */
  vtkSetClampMacro(Scene, int, HEAD, VESSELS);
  vtkGetMacro(Scene, int);
  ///@}

protected:
  vtkOcclusionPhantom();
  ~vtkOcclusionPhantom() override;

  int RequestInformation(
    vtkInformation*, vtkInformationVector**, vtkInformationVector* outputVector) override;
  int RequestData(
    vtkInformation*, vtkInformationVector**, vtkInformationVector* outputVector) override;

private:
  vtkOcclusionPhantom(const vtkOcclusionPhantom&) = delete;
  void operator=(const vtkOcclusionPhantom&) = delete;

  int Resolution = 64;
  int Scene = HEAD;
};

#endif
