// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

/**
 * @class   vtkSegmentationReader
 * @brief   read an image or a segmentation with its placement and its names
 *
 * Reads volumes with one number per point from files of NIfTI (.nii, .nii.gz), NRRD (.nrrd, .nhdr,
 * raw or gzip; .seg.nrrd of 3D Slicer) and MetaImage (.mha, .mhd).
 *
 * Output port 0: vtkImageData with the point array "Values", which has the type of the file, or
 *   float if the file rescales its values. Origin, spacing and direction are those of the file, in
 *   one world for all formats: x towards the patient's left, y towards the back, z towards the head
 *   (LPS, as in DICOM). Coordinates of NIfTI and of RAS files become these; those of files that
 *   name no space are kept. Axes are exchanged and reversed so that those of the image go along
 *   those of the world as far as they can: displays of ParaView 5.11 ignore the direction matrix,
 *   which is that of unity unless the image is oblique.
 *   If the file names its labels, its field data have them: "StructureLabels", "StructureNames"
 * and, if the file has colours, "StructureColors" (red, green and blue [0, 1]; NaN for labels
 * without). Files of 3D Slicer and NIfTI files with a label table (of TotalSegmentator or
 * Connectome Workbench) do.
 *
 * The sform of a NIfTI file is used, or else its qform; also the qform if the sform is sheared.
 *
 * @sa vtkAddStructures
 */

#ifndef vtkSegmentationReader_h
#define vtkSegmentationReader_h

#include "vtkImageAlgorithm.h"
#include "vtkLimpidFiltersModule.h"      // for export macro
#include "vtkVisibilitySettingsMacros.h" // for setters of strings

#include <string> // for the path of the file

class VTKLIMPIDFILTERS_EXPORT vtkSegmentationReader : public vtkImageAlgorithm
{
public:
  static vtkSegmentationReader* New();
  vtkTypeMacro(vtkSegmentationReader, vtkImageAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  ///@{
  /**
   * Path of the file, whose end says which format it has. Default is empty.
   */
  vtkSetStdStringFromCharMacro(FileName);
  vtkGetCharFromStdStringMacro(FileName);
  ///@}

  ///@{
  /**
   * Which layer is read from a segmentation whose segments overlap: 3D Slicer distributes these
   * over layers, within which they do not. A warning says which segments are in others. Default is
   * 0.
   */
  LIMPID_SET_CLAMPED(Layer, int, 0, VTK_INT_MAX);
  vtkGetMacro(Layer, int);
  ///@}

  /**
   * Returns whether a file has a header that can be read.
   */
  int CanReadFile(const char* path);

protected:
  vtkSegmentationReader();
  ~vtkSegmentationReader() override;

  int RequestInformation(vtkInformation*, vtkInformationVector** inputVector,
    vtkInformationVector* outputVector) override;
  int RequestData(vtkInformation*, vtkInformationVector** inputVector,
    vtkInformationVector* outputVector) override;

private:
  vtkSegmentationReader(const vtkSegmentationReader&) = delete;
  void operator=(const vtkSegmentationReader&) = delete;

  template <class Action>
  int Try(const Action& action);

  std::string FileName;
  int Layer = 0;
};

#endif
