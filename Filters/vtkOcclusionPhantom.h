// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

/**
 * @class   vtkOcclusionPhantom
 * @brief   generate a volume in which important structures are hidden
 *
 * Procedural test volumes on [-1, 1]^3 with point arrays
 *   "Scalars"        a value per material [0, 1],
 *   "Importance"     importance of the structure [0, 1],
 *   "BaseExtinction" extinction of the material [1/length],
 *   "Structure"      label of the shape that has most of the point, as below; 0: none.
 * Shapes have smooth edges, at least one and a half voxels wide, so that results do not depend on
 * the position of the grid.
 *
 * Scenes:
 *   HEAD         skin (1) and soft tissue (2) around a brain (3) in a skull (4), with two vessels
 *                (5) and a tumour (6) inside;
 *   FLAME        a flickering plume of smoke (1) and hot gas (2) with a thin reaction front (3) and
 *                a core (4) inside;
 *   SHELLS       four nested spheres (1 to 4, from outside); the inner ones are more important;
 *   HOMOGENEOUS  extinction 1 and importance 1 everywhere (1), for comparison with closed forms;
 *   VESSELS      thin vessels (3) in tissue (2) with noise, which is constant within cells of size
 *                1/64, in a skin (1).
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
