// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

/**
 * @class   LimpidStructures
 * @brief   the table of structures in the properties panel
 *
 * For the property Structures, with panel_widget="LimpidStructures": a LimpidStructureModel, of
 * which a change of one selected row changes all selected ones, and buttons that fill it from the
 * labels in the data or name them from a file. Of a display it also has the colours of structures
 * (LabelColors) and what the last picture shows of each (StructureShares), and a click in the view
 * selects the row of the structure that is seen there; a button looks from where most of the
 * selected ones can be seen. It only sets the properties, so that undo, trace and state contain all
 * changes.
 */

#ifndef LimpidStructures_h
#define LimpidStructures_h

#include "LimpidStructureModel.h"
#include "pqPropertyWidget.h"
#include "vtkNew.h"

#include <QSortFilterProxyModel>

#include <array>
#include <vector>

class QLabel;
class QPushButton;
class QTableView;
class vtkEventQtSlotConnect;
class vtkRenderWindowInteractor;

class LimpidStructures : public pqPropertyWidget
{
  Q_OBJECT
  Q_PROPERTY(QVariantList structures READ structures WRITE setStructures NOTIFY structuresChanged)
  Q_PROPERTY(QVariantList colors READ colors WRITE setColors NOTIFY colorsChanged)

public:
  LimpidStructures(vtkSMProxy* proxy, vtkSMProperty* structures, QWidget* parent = nullptr);

  QVariantList structures() const;
  void setStructures(const QVariantList& texts);
  QVariantList colors() const;
  void setColors(const QVariantList& numbers);

Q_SIGNALS:
  void structuresChanged();
  void colorsChanged();

private Q_SLOTS:
  void takeEdit(int row, int column);
  void chooseColor(const QModelIndex& index);
  void followShares();
  void fillFromData();
  void loadNames();
  void measure();
  void findBestView();
  void watchView(pqView* view);
  void beginClick(); // events of the view's interactor
  void endClick();

private:
  void createTable();
  std::vector<int> selectedRows() const;
  QPushButton* newButton(const char* name, const QString& text, const QString& toolTip);
  void setAllImportant(bool important);
  void change();
  void changeLooks(const QVariantList& formerColors);
  void setHint(const QString& text);
  vtkRenderWindowInteractor* interactor() const;

  LimpidStructureModel* Model;
  QSortFilterProxyModel* Sorted;
  QTableView* Table;
  QLabel* Hint;       // what to do, or what was wrong
  vtkSMProxy* Volume; // owner of the property, which a display exposes
  vtkNew<vtkEventQtSlotConnect> Clicks;
  std::array<int, 2> ClickBegan{}; // where the mouse was pressed [pixels]
};

#endif
