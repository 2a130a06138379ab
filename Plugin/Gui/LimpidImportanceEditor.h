// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

/**
 * @class   LimpidImportanceEditor
 * @brief   the curve of an importance function over the histogram of the data, in its row
 *
 * Stands below the fields of ParaView's own row of a property ImportanceFunction, in place of the
 * button that opens a dialog. Points are dragged, added by a click on the curve, and removed by
 * the key Delete; two fields have value and importance of the point that was clicked last. The
 * heights of the histogram are logarithms. The row's button for resetting sets the function to what
 * the data suggest.
 */

#ifndef LimpidImportanceEditor_h
#define LimpidImportanceEditor_h

#include <QTimer>
#include <QWidget>

#include <array>
#include <vector>

class pqLineEdit;
class pqPropertyWidget;
class pqTransferFunctionWidget;
class vtkPiecewiseFunction;
class vtkSMProxy;

class LimpidImportanceEditor : public QWidget
{
  Q_OBJECT

public:
  /// Adds itself to the row.
  LimpidImportanceEditor(pqPropertyWidget* row, vtkSMProxy* function);

protected:
  void showEvent(QShowEvent* event) override;

private Q_SLOTS:
  void follow();      // the function
  void followPoint(); // the current one
  void outdate();     // the histogram
  void count();       // the histogram
  void takeCurve();
  void takeFields();
  void suggest();

private:
  void takeOverRow();
  void setPoints(const std::vector<double>& points);
  std::vector<double> points() const;
  vtkPiecewiseFunction* curve() const;

  pqPropertyWidget* Row;
  vtkSMProxy* Function;
  pqTransferFunctionWidget* Chart;
  pqLineEdit* Value;
  pqLineEdit* Importance;
  QTimer Counting;
  std::array<double, 2> Range{}; // of the function, and so of the histogram
  bool Outdated = true;
};

#endif
