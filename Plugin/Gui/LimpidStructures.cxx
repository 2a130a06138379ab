// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause
#include "LimpidStructures.h"

#include "LimpidBestView.h"
#include "LimpidLabels.h"
#include "LimpidOptimizedVolumes.h"
#include "StructureTableFile.h"

#include "pqCoreUtilities.h"
#include "pqRenderView.h"
#include "vtkCommand.h"
#include "vtkEventQtSlotConnect.h"
#include "vtkRenderWindowInteractor.h"
#include "vtkSMProperty.h"
#include "vtkSMPropertyHelper.h"
#include "vtkSMProxy.h"
#include "vtkSMRenderViewProxy.h"

#include <QColorDialog>
#include <QDoubleSpinBox>
#include <QFileDialog>
#include <QGridLayout>
#include <QHeaderView>
#include <QLabel>
#include <QMouseEvent>
#include <QPushButton>
#include <QStyledItemDelegate>
#include <QTableView>
#include <QVBoxLayout>

#include <algorithm>
#include <exception>

namespace
{
const int HEIGHT = 200; // of the table [pixels]
const int ROW_HEIGHT = 24;
const int NAME_WIDTH = 80; // names may be long

// Keeps several selected rows selected if a value of one of them is clicked, to change it in all of
// them.
class StructureTable : public QTableView
{
public:
  using QTableView::QTableView;

protected:
  QItemSelectionModel::SelectionFlags selectionCommand(
    const QModelIndex& index, const QEvent* event) const override
  {
    const int column = index.column();
    const bool isValue = column == LimpidStructureModel::IMPORTANT ||
      column == LimpidStructureModel::COLOR || column == LimpidStructureModel::IMPORTANCE ||
      column == LimpidStructureModel::TARGET;
    const auto* mouse = dynamic_cast<const QMouseEvent*>(event);
    const bool keeps = isValue && mouse && mouse->modifiers() == Qt::NoModifier &&
      this->selectionModel()->isSelected(index);
    return keeps ? QItemSelectionModel::SelectionFlags(QItemSelectionModel::NoUpdate)
                 : this->QTableView::selectionCommand(index, event);
  }
};

// Edits importances between 0 and 1.
class ImportanceDelegate : public QStyledItemDelegate
{
public:
  using QStyledItemDelegate::QStyledItemDelegate;

  QWidget* createEditor(
    QWidget* parent, const QStyleOptionViewItem&, const QModelIndex&) const override
  {
    auto* editor = new QDoubleSpinBox(parent);
    editor->setObjectName("Importance");
    editor->setRange(0, 1);
    editor->setSingleStep(0.1);
    editor->setDecimals(2);
    editor->setFrame(false);
    return editor;
  }
};

// Gives editors of targets a name, as those of importances have, by which recorded events find
// them.
class TargetDelegate : public QStyledItemDelegate
{
public:
  using QStyledItemDelegate::QStyledItemDelegate;

  QWidget* createEditor(
    QWidget* parent, const QStyleOptionViewItem& option, const QModelIndex& index) const override
  {
    QWidget* editor = this->QStyledItemDelegate::createEditor(parent, option, index);
    editor->setObjectName("Target");
    return editor;
  }
};
}

LimpidStructures::LimpidStructures(
  vtkSMProxy* owner, vtkSMProperty* structures, QWidget* parentWidget)
  : pqPropertyWidget(owner, parentWidget)
  , Model(new LimpidStructureModel(this))
  , Sorted(new QSortFilterProxyModel(this))
  , Table(new StructureTable(this))
  , Hint(new QLabel(this))
  , Volume(structures->GetParent())
{
  this->setShowLabel(false);
  this->createTable();
  this->Hint->setObjectName("Hint");
  this->Hint->setWordWrap(true);

  auto* fromData = this->newButton("FromData", tr("From Data"),
    tr("Add a row for each label in the data that has none, with its name if there is one."));
  auto* all = this->newButton("All", tr("All"), tr("Make all structures important."));
  auto* none = this->newButton("None", tr("None"), tr("Make all structures unimportant."));
  auto* load = this->newButton("LoadNames", tr("Load Names ..."),
    tr("Name the labels by a text file: a table with the columns label and name, a color table of "
       "FreeSurfer, or the label descriptions of ITK-SNAP."));
  auto* buttons = new QGridLayout();
  buttons->addWidget(fromData, 0, 0);
  buttons->addWidget(load, 0, 1);
  buttons->addWidget(all, 1, 0);
  buttons->addWidget(none, 1, 1);
  auto* rows = new QVBoxLayout(this);
  rows->setContentsMargins(0, 0, 0, 0);
  rows->addWidget(this->Table);
  rows->addWidget(this->Hint);
  rows->addLayout(buttons);

  this->connect(fromData, &QPushButton::clicked, this, &LimpidStructures::fillFromData);
  this->connect(all, &QPushButton::clicked, this, [this] { this->setAllImportant(true); });
  this->connect(none, &QPushButton::clicked, this, [this] { this->setAllImportant(false); });
  this->connect(load, &QPushButton::clicked, this, &LimpidStructures::loadNames);
  this->connect(this->Model, &LimpidStructureModel::edited, this, &LimpidStructures::takeEdit);
  this->addPropertyLink(this, "structures", SIGNAL(structuresChanged()), structures);
  vtkSMProperty* colors = owner->GetProperty("LabelColors");
  this->Table->setColumnHidden(LimpidStructureModel::COLOR, !colors);
  if (colors)
  {
    this->addPropertyLink(this, "colors", SIGNAL(colorsChanged()), colors);
    this->connect(this->Table, &QTableView::doubleClicked, this, &LimpidStructures::chooseColor);
  }
  vtkSMProperty* shares = owner->GetProperty("StructureShares");
  this->Table->setColumnHidden(LimpidStructureModel::VISIBLE, !shares);
  if (shares)
  {
    pqCoreUtilities::connect(shares, vtkCommand::ModifiedEvent, this, SLOT(followShares()));
    this->followShares();
    auto* measure = this->newButton("Measure", tr("Measure Visibility"),
      tr("Measure how much the picture shows of each structure. Without a remote server, this "
         "happens by itself when ParaView is idle."));
    auto* best = this->newButton("BestView", tr("Best View of Selected"),
      tr("Look from where the most of the selected structures can be seen, whatever else is "
         "important. Camera Undo goes back."));
    best->setIcon(BestViewIcon());
    best->setEnabled(false);
    buttons->addWidget(measure, 2, 0, 1, 2);
    buttons->addWidget(best, 3, 0, 1, 2);
    const auto follow = [this, best]
    { best->setEnabled(this->Table->selectionModel()->hasSelection()); };
    this->connect(
      this->Table->selectionModel(), &QItemSelectionModel::selectionChanged, best, follow);
    this->connect(this->Sorted, &QAbstractItemModel::modelReset, best, follow);
    this->connect(best, &QPushButton::clicked, this, &LimpidStructures::findBestView);
    this->connect(measure, &QPushButton::clicked, this, &LimpidStructures::measure);
    this->connect(this, &pqPropertyWidget::viewChanged, this, &LimpidStructures::watchView);
  }
}

void LimpidStructures::createTable()
{
  this->Sorted->setSourceModel(this->Model);
  this->Sorted->setSortRole(LimpidStructureModel::SORT_ROLE);
  this->Sorted->setDynamicSortFilter(false); // rows stay where they are while they are edited
  this->Table->setObjectName("Structures");
  this->Table->setModel(this->Sorted);
  this->Table->setFixedHeight(HEIGHT);
  this->Table->setSelectionBehavior(QAbstractItemView::SelectRows);
  this->Table->setSelectionMode(QAbstractItemView::ExtendedSelection);
  this->Table->setSortingEnabled(true);
  this->Table->sortByColumn(-1, Qt::AscendingOrder); // as the property has them
  this->Table->setItemDelegateForColumn(
    LimpidStructureModel::IMPORTANCE, new ImportanceDelegate(this));
  this->Table->setItemDelegateForColumn(LimpidStructureModel::TARGET, new TargetDelegate(this));
  QHeaderView* left = this->Table->verticalHeader();
  left->hide();
  left->setMinimumSectionSize(1);
  left->setDefaultSectionSize(ROW_HEIGHT);
  QHeaderView* header = this->Table->horizontalHeader();
  header->setHighlightSections(false);
  header->setMinimumSectionSize(ROW_HEIGHT);
  header->setSectionResizeMode(QHeaderView::ResizeToContents);
  header->setSectionResizeMode(LimpidStructureModel::NAME, QHeaderView::Interactive);
  header->resizeSection(LimpidStructureModel::NAME, NAME_WIDTH);
}

QPushButton* LimpidStructures::newButton(
  const char* name, const QString& text, const QString& toolTip)
{
  auto* button = new QPushButton(text, this);
  button->setObjectName(name);
  button->setToolTip(toolTip);
  return button;
}

QVariantList LimpidStructures::structures() const
{
  return this->Model->texts();
}

void LimpidStructures::setStructures(const QVariantList& texts)
{
  if (texts != this->structures())
  {
    this->Model->setTexts(texts);
    Q_EMIT this->structuresChanged();
  }
  this->setHint(QString());
}

QVariantList LimpidStructures::colors() const
{
  return this->Model->colors();
}

void LimpidStructures::setColors(const QVariantList& numbers)
{
  if (numbers != this->colors())
  {
    this->Model->setColors(numbers);
    Q_EMIT this->colorsChanged();
  }
}

// Shows a text below the table, or what to do if no structure is important.
void LimpidStructures::setHint(const QString& text)
{
  QString advice;
  if (this->Model->rowCount() == 0)
  {
    advice = tr("All labels but 0 are equally important. Fill the table to choose among them.");
  }
  else if (!this->Model->isAnyImportant())
  {
    advice = tr("Tick what matters.");
  }
  this->Hint->setText(text.isEmpty() ? advice : text);
  this->Hint->setVisible(!this->Hint->text().isEmpty());
}

void LimpidStructures::change()
{
  this->setHint(QString());
  Q_EMIT this->structuresChanged();
}

// Sets the properties, of which names and colours may have changed.
void LimpidStructures::changeLooks(const QVariantList& formerColors)
{
  this->change();
  if (this->colors() != formerColors)
  {
    Q_EMIT this->colorsChanged();
  }
}

// Returns the numbers of the selected rows in the model.
std::vector<int> LimpidStructures::selectedRows() const
{
  std::vector<int> rows;
  for (const QModelIndex& index : this->Table->selectionModel()->selectedRows())
  {
    rows.push_back(this->Sorted->mapToSource(index).row());
  }
  return rows;
}

void LimpidStructures::takeEdit(int row, int column)
{
  const std::vector<int> selected = this->selectedRows();
  if (std::find(selected.begin(), selected.end(), row) != selected.end())
  {
    this->Model->copy(row, column, selected);
  }
  this->change();
}

// Gives the selected rows a colour if that of one of them was double-clicked.
void LimpidStructures::chooseColor(const QModelIndex& index)
{
  if (index.column() != LimpidStructureModel::COLOR)
  {
    return;
  }
  QColorDialog dialog(this->Model->colorOf(this->Sorted->mapToSource(index).row()), this);
  dialog.setObjectName("ColorDialog");
  dialog.setWindowTitle(tr("Color of Structures"));
  if (dialog.exec() == QDialog::Accepted)
  {
    this->Model->paint(this->selectedRows(), dialog.selectedColor());
    Q_EMIT this->colorsChanged();
  }
}

void LimpidStructures::followShares()
{
  this->Model->setShares(vtkSMPropertyHelper(this->proxy(), "StructureShares").GetDoubleArray());
}

void LimpidStructures::measure()
{
  MeasureStructures(this->Volume);
  if (this->view())
  {
    this->view()->render(); // tells it
  }
}

void LimpidStructures::findBestView()
{
  if (auto* view = qobject_cast<pqRenderView*>(this->view()))
  {
    FindBestViewOf(this->proxy(), view, this->Model->importantTexts(this->selectedRows()));
  }
}

// Returns what gets the mouse's events in the view; null: none.
vtkRenderWindowInteractor* LimpidStructures::interactor() const
{
  auto* view =
    this->view() ? vtkSMRenderViewProxy::SafeDownCast(this->view()->getProxy()) : nullptr;
  return view ? view->GetInteractor() : nullptr;
}

void LimpidStructures::watchView(pqView*)
{
  this->Clicks->Disconnect();
  if (vtkRenderWindowInteractor* mouse = this->interactor())
  {
    constexpr float first = 1; // a priority above that of ParaView's own observer
    this->Clicks->Connect(
      mouse, vtkCommand::LeftButtonPressEvent, this, SLOT(beginClick()), nullptr, first);
    this->Clicks->Connect(
      mouse, vtkCommand::LeftButtonReleaseEvent, this, SLOT(endClick()), nullptr, first);
  }
}

void LimpidStructures::beginClick()
{
  std::copy_n(this->interactor()->GetEventPosition(), 2, this->ClickBegan.begin());
}

// Selects the row of the structure under the mouse, unless it was moved.
void LimpidStructures::endClick()
{
  const int* place = this->interactor()->GetEventPosition();
  const int* size = this->interactor()->GetSize();
  if (!this->isVisible() || !std::equal(this->ClickBegan.begin(), this->ClickBegan.end(), place))
  {
    return;
  }
  const int row =
    PickStructure(this->Volume, (place[0] + 0.5) / size[0], (place[1] + 0.5) / size[1]);
  if (row >= 0 && row < this->Model->rowCount())
  {
    const QModelIndex index = this->Sorted->mapFromSource(this->Model->index(row, 0));
    this->Table->selectRow(index.row());
    this->Table->scrollTo(index);
  }
}

void LimpidStructures::setAllImportant(bool important)
{
  this->Model->setAllImportant(important);
  this->change();
}

void LimpidStructures::fillFromData()
{
  const LimpidLabels labels = LabelsOf(this->proxy());
  if (!labels.Problem.isEmpty())
  {
    this->setHint(labels.Problem);
    return;
  }
  const QVariantList former = this->colors();
  this->Model->add(labels.Looks, true);
  this->changeLooks(former);
}

void LimpidStructures::loadNames()
{
  const QString path = QFileDialog::getOpenFileName(this, tr("Names of Labels"), QString(),
    tr("Names of labels") + " (*.csv *.tsv *.txt *.ctbl *.lut *.label)");
  if (path.isEmpty())
  {
    return;
  }
  try
  {
    limpid::StructureTableFile file = limpid::ReadStructureTable(path.toStdString());
    const QVariantList former = this->colors();
    if (this->Model->rowCount() == 0)
    {
      file.looks.erase(0); // the background
      this->Model->add(file.looks, true);
    }
    this->Model->rename(file.looks);
    this->changeLooks(former);
    this->setHint(QString::fromStdString(file.warning));
  }
  catch (const std::exception& error)
  {
    this->setHint(error.what());
  }
}
