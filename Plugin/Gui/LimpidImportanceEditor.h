// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

/**
 * @class   LimpidImportanceEditor
 * @brief   an editor of the importance function over the histogram of the data, in its row
 *
 * It is below the fields of ParaView's own row of a property ImportanceFunction and replaces the
 * button that opens a dialog. Points are dragged, added by a click on the curve, and removed by the
 * key Delete. Two fields have value and importance of the point that was clicked last. The
 * histogram has a logarithmic scale. The row's reset button sets the function to the suggestion for
 * the data.
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
  /// Adds the editor to the row.
  LimpidImportanceEditor(pqPropertyWidget* row, vtkSMProxy* function);

protected:
  void showEvent(QShowEvent* event) override;

private Q_SLOTS:
  void follow();      // shows changes of the function
  void followPoint(); // shows the current point
  void outdate();     // marks the histogram as outdated
  void count();       // computes the histogram
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
  std::array<double, 2> Range{}; // of the function, hence of the histogram
  bool Outdated = true;
};

#endif
