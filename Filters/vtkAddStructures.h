// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

/**
 * @class   vtkAddStructures
 * @brief   add the labels of a segmentation to an image
 *
 * Resamples the labels of structures from an image with a grid of its own to the points of another
 * image. Labels are never interpolated.
 *
 * Input port 0: vtkImageData, to which the labels are added.
 * Input port 1: vtkImageData with labels on its points or cells; origin, spacing and direction are
 *   its own. Array 0 (SetInputArrayToProcess(0, 1, 0, association, name)) has them, as integers of
 *   any type or as whole floating-point numbers. Default: the active scalars of the points, or else
 *   of the cells, or else the first array. NaN is 0. Values of blanked points and cells count, too.
 *   If the array has several components, or with MasksToLabels, the input has masks instead.
 * Output port 0: a shallow copy of port 0 with the point array "Structure". It has the type of the
 *   label array; int for floating-point numbers, and unsigned short for masks.
 * Output port 1: vtkTable with a row for each label but 0 of port 1, in ascending order:
 *   "Label", "Name" and "Points", the number of points that have it. Of several processes, each
 *   counts the points of its own piece. If any label has a colour, also "Red", "Green" and "Blue"
 *   [0, 1]; NaN for labels without.
 *
 * Names and colours are those of vtkSegmentationReader, which port 1 has as field data; names of
 * masks replace them, and those of TableFile replace both.
 *
 * Readers of VTK 9.2 and ParaView 5.11 ignore the directions in NRRD and MetaImage files, and
 * directions and origins in NIfTI files; vtkSegmentationReader does not. See ImageFile for an image
 * that came through such a reader.
 *
 * @sa vtkSegmentationReader vtkExtinctionOptimizer
 */

#ifndef vtkAddStructures_h
#define vtkAddStructures_h

#include "vtkImageAlgorithm.h"
#include "vtkLimpidFiltersModule.h"      // for export macro
#include "vtkVisibilitySettingsMacros.h" // for setters of values in a range

#include <string> // for the path of the table

class vtkTable;

class VTKLIMPIDFILTERS_EXPORT vtkAddStructures : public vtkImageAlgorithm
{
public:
  static vtkAddStructures* New();
  vtkTypeMacro(vtkAddStructures, vtkImageAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  enum Resamplings
  {
    MAJORITY = 0,
    NEAREST = 1
  };

  /**
   * The second output: labels, names and numbers of points.
   */
  vtkTable* GetStructureTable();

  ///@{
  /**
   * Which label a point gets. A label is sampled at the points or at the centres of the cells of
   * the label image, whose box ends half a sample beyond the outermost ones. Outside, it is 0.
   *
   * NEAREST: that of the nearest sample along each axis of the label image; where two are equally
   * near, to a millionth of their distance, that of the higher index.
   *
   * MAJORITY: the most frequent one among sub-samples of the point's own box, which reaches half a
   * spacing of the image to each side. Along an axis on which the image's spacing is L spacings of
   * the labels, there is 1 sub-sample if L < 1, and otherwise the least whole number from 2 L on,
   * at most 8, regularly spaced; an oblique axis has the L of its length in label spacings. Each
   * sub-sample has the label that NEAREST gives it; those outside do not count. If several labels
   * are as frequent, that of NEAREST at the point itself wins if it is one of them, or else the
   * smallest that is not 0. Where labels are coarser than the image, this is NEAREST. Default is
   * MAJORITY.
   */
  LIMPID_SET_CLAMPED(Resampling, int, MAJORITY, NEAREST);
  vtkGetMacro(Resampling, int);
  ///@}

  ///@{
  /**
   * Whether every array of port 1 is a mask, and each of its components if it has several. The
   * first mask becomes label 1, the next one 2 and so on, with the array's name. Integers other
   * than 0 and floating-point numbers above 0.5 are inside; where masks overlap, the last one
   * counts. The masks are all on points or all on cells. Default is off.
   */
  vtkSetMacro(MasksToLabels, bool);
  vtkGetMacro(MasksToLabels, bool);
  vtkBooleanMacro(MasksToLabels, bool);
  ///@}

  ///@{
  /**
   * Path of a text file with the names of labels, or empty. Names of the file replace those of
   * masks. It has a row per label; rows may differ in form, # begins a comment:
   *   label,name,...               separated by commas, semicolons or tabs; the first row may name
   *                                the columns, of which "label" and "name" are taken;
   *   label name r g b a           as of FreeSurfer, separated by blanks; colors may be missing;
   *   label r g b a v m "name"     as of ITK-SNAP.
   * If the file or a row cannot be read, a warning says so. A file that has changed is read again
   * when the filter runs again. Default is empty.
   */
  vtkSetStdStringFromCharMacro(TableFile);
  vtkGetCharFromStdStringMacro(TableFile);
  ///@}

  ///@{
  /**
   * Path of the file that port 0 was read from, or empty. If a reader has ignored where this file
   * places the image, the labels, which vtkSegmentationReader has placed, would be elsewhere. With
   * this path, each point gets the label at its place in the file instead. The file is one that
   * vtkSegmentationReader reads; it must have the points of the image, and their spacing. Default
   * is empty.
   */
  vtkSetStdStringFromCharMacro(ImageFile);
  vtkGetCharFromStdStringMacro(ImageFile);
  ///@}

protected:
  vtkAddStructures();
  ~vtkAddStructures() override;

  int FillInputPortInformation(int port, vtkInformation* info) override;
  int FillOutputPortInformation(int port, vtkInformation* info) override;
  int RequestUpdateExtent(
    vtkInformation*, vtkInformationVector** inputVector, vtkInformationVector*) override;
  int RequestData(vtkInformation*, vtkInformationVector** inputVector,
    vtkInformationVector* outputVector) override;

private:
  vtkAddStructures(const vtkAddStructures&) = delete;
  void operator=(const vtkAddStructures&) = delete;

  int Resampling = MAJORITY;
  bool MasksToLabels = false;
  std::string TableFile;
  std::string ImageFile;

  struct Internals;
};

#endif
