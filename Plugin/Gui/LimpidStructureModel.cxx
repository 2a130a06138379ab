// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause
#include "LimpidStructureModel.h"

#include "StructurePalette.h"

#include <QIcon>
#include <QPixmap>

#include <algorithm>

namespace
{
const int SWATCH = 16;            // side of a colour's square [pixels]
const std::size_t SHARES = 4;     // per row of StructureShares
const std::size_t ATTAINABLE = 3; // the last of them

// Returns an iterator to the colour that a label was given, or the end.
template <class LabelColors>
auto Find(LabelColors& colors, double label)
{
  return std::find_if(
    colors.begin(), colors.end(), [label](const auto& given) { return given[0] == label; });
}

// Returns an icon that looks the same in selected rows.
QIcon Swatch(const QColor& color)
{
  QPixmap square(SWATCH, SWATCH);
  square.fill(color);
  QIcon icon(square);
  icon.addPixmap(square, QIcon::Selected);
  return icon;
}

QString Percent(double share, int decimals)
{
  return QString("%1 %").arg(100 * share, 0, 'f', decimals);
}

// Returns a share as the property has it for what a person typed as a percentage. `isNumber`:
// whether it is one, or nothing.
QString ShareOf(QString text, bool& isNumber)
{
  text = text.remove('%').trimmed();
  isNumber = true;
  if (text.isEmpty())
  {
    return text;
  }
  const double percent = text.toDouble(&isNumber);
  isNumber = isNumber && percent >= 0 && percent <= 100;
  return QString::number(percent / 100, 'g', 10);
}
}

LimpidStructureModel::LimpidStructureModel(QObject* parentObject)
  : QAbstractTableModel(parentObject)
{
}

QVariantList LimpidStructureModel::texts() const
{
  QVariantList texts;
  for (const Row& row : this->Rows)
  {
    std::copy(row.begin(), row.end(), std::back_inserter(texts));
  }
  return texts;
}

QVariantList LimpidStructureModel::importantTexts(const std::vector<int>& rows) const
{
  QVariantList texts;
  for (const int number : rows)
  {
    Row row = this->Rows[static_cast<std::size_t>(number)];
    row[IMPORTANCE_TEXT] = this->lastImportance(row);
    std::copy(row.begin(), row.end(), std::back_inserter(texts));
  }
  return texts;
}

void LimpidStructureModel::setTexts(const QVariantList& texts)
{
  std::vector<Row> rows(static_cast<std::size_t>(texts.size()) / TEXTS);
  for (std::size_t i = 0; i < rows.size() * TEXTS; ++i)
  {
    rows[i / TEXTS][i % TEXTS] = texts[static_cast<int>(i)].toString();
  }
  const auto haveSameLabel = [](const Row& one, const Row& other)
  { return one[LABEL_TEXT] == other[LABEL_TEXT]; };
  if (std::equal(rows.begin(), rows.end(), this->Rows.begin(), this->Rows.end(), haveSameLabel))
  {
    this->Rows = rows;
    this->tellOfAll(); // selected rows stay so
    return;
  }
  this->beginResetModel();
  this->Rows = rows;
  this->Shares.clear();
  this->endResetModel();
}

void LimpidStructureModel::tellOfAll()
{
  if (!this->Rows.empty())
  {
    Q_EMIT this->dataChanged(
      this->index(0, 0), this->index(static_cast<int>(this->Rows.size()) - 1, COLUMNS - 1));
  }
}

QVariantList LimpidStructureModel::colors() const
{
  QVariantList numbers;
  for (const LabelColor& given : this->GivenColors)
  {
    std::copy(given.begin(), given.end(), std::back_inserter(numbers));
  }
  return numbers;
}

void LimpidStructureModel::setColors(const QVariantList& numbers)
{
  this->GivenColors.resize(static_cast<std::size_t>(numbers.size()) / LabelColor().size());
  int next = 0;
  for (LabelColor& given : this->GivenColors)
  {
    std::generate(given.begin(), given.end(), [&] { return numbers[next++].toDouble(); });
  }
  this->tellOfAll();
}

QColor LimpidStructureModel::colorOf(int row) const
{
  const auto given = Find(this->GivenColors, this->value(row, LABEL).toDouble());
  if (given != this->GivenColors.end())
  {
    const auto channel = [&given](std::size_t at) { return std::clamp((*given)[at], 0., 1.); };
    return QColor::fromRgbF(channel(1), channel(2), channel(3));
  }
  const auto& bytes = limpid::PaletteColor(static_cast<std::size_t>(row));
  return { bytes[0], bytes[1], bytes[2] };
}

void LimpidStructureModel::paint(const std::vector<int>& rows, const QColor& color)
{
  for (const int row : rows)
  {
    this->paint(this->value(row, LABEL).toDouble(),
      { color.red() / 255., color.green() / 255., color.blue() / 255. });
  }
  this->tellOfAll();
}

void LimpidStructureModel::paint(double label, const limpid::Color& color)
{
  auto given = Find(this->GivenColors, label);
  if (given == this->GivenColors.end())
  {
    given = this->GivenColors.insert(given, LabelColor());
  }
  *given = { { label, color[0], color[1], color[2] } };
}

void LimpidStructureModel::setShares(const std::vector<double>& shares)
{
  this->Shares = shares.size() == SHARES * this->Rows.size() ? shares : std::vector<double>();
  this->tellOfAll();
}

// Returns a name that no other row has: structures with the same name are an error.
QString LimpidStructureModel::freeName(const QString& wanted, const QString& label) const
{
  const bool isTaken = std::any_of(this->Rows.begin(), this->Rows.end(),
    [&](const Row& row) { return row[NAME_TEXT] == wanted && row[LABEL_TEXT] != label; });
  return isTaken ? wanted + " " + label : wanted;
}

void LimpidStructureModel::add(const limpid::StructureLooks& looks, bool important)
{
  this->beginResetModel();
  for (const auto& given : looks)
  {
    const QString label = QString::number(given.first);
    const bool isThere = std::any_of(this->Rows.begin(), this->Rows.end(),
      [&](const Row& row) { return row[LABEL_TEXT].toLongLong() == given.first; });
    if (!isThere)
    {
      const QString name = QString::fromStdString(given.second.name);
      this->Rows.push_back({ { label, this->freeName(name, label), important ? "1" : "0", "" } });
      if (given.second.color)
      {
        this->paint(static_cast<double>(given.first), *given.second.color);
      }
    }
  }
  this->Shares.clear();
  this->endResetModel();
}

void LimpidStructureModel::rename(const limpid::StructureLooks& looks)
{
  for (Row& row : this->Rows)
  {
    const auto look = looks.find(row[LABEL_TEXT].toLongLong());
    if (look != looks.end())
    {
      row[NAME_TEXT] = this->freeName(QString::fromStdString(look->second.name), row[LABEL_TEXT]);
      if (look->second.color)
      {
        this->paint(static_cast<double>(look->first), *look->second.color);
      }
    }
  }
  this->tellOfAll();
}

// Returns the importance of a structure, or what it was when it was important.
QString LimpidStructureModel::lastImportance(const Row& row) const
{
  return isImportant(row) ? row[IMPORTANCE_TEXT]
                          : this->FormerImportance.value(row[LABEL_TEXT], "1");
}

void LimpidStructureModel::setImportance(Row& row, const QString& importance)
{
  if (isImportant(row))
  {
    this->FormerImportance[row[LABEL_TEXT]] = row[IMPORTANCE_TEXT];
  }
  row[IMPORTANCE_TEXT] = importance;
}

void LimpidStructureModel::setImportant(Row& row, bool important)
{
  if (important != isImportant(row))
  {
    this->setImportance(row, important ? this->lastImportance(row) : QString("0"));
  }
}

bool LimpidStructureModel::isAnyImportant() const
{
  return std::any_of(this->Rows.begin(), this->Rows.end(), isImportant);
}

void LimpidStructureModel::setAllImportant(bool important)
{
  for (Row& row : this->Rows)
  {
    this->setImportant(row, important);
  }
  this->tellOfAll();
}

void LimpidStructureModel::copy(int row, int column, const std::vector<int>& others)
{
  const Row from = this->Rows[static_cast<std::size_t>(row)];
  for (const int other : others)
  {
    Row& to = this->Rows[static_cast<std::size_t>(other)];
    if (column == IMPORTANT)
    {
      this->setImportant(to, isImportant(from));
    }
    else if (column == IMPORTANCE)
    {
      this->setImportance(to, from[IMPORTANCE_TEXT]);
    }
    else if (column == TARGET)
    {
      to[TARGET_TEXT] = from[TARGET_TEXT];
    }
  }
  this->tellOfAll();
}

int LimpidStructureModel::rowCount(const QModelIndex& parentIndex) const
{
  return parentIndex.isValid() ? 0 : static_cast<int>(this->Rows.size());
}

int LimpidStructureModel::columnCount(const QModelIndex& parentIndex) const
{
  return parentIndex.isValid() ? 0 : COLUMNS;
}

// Returns the text of what is visible; empty: unknown.
QString LimpidStructureModel::visibleText(int row) const
{
  const std::size_t begin = SHARES * static_cast<std::size_t>(row);
  return this->Shares.empty()
    ? QString()
    : tr("%1 of at most %2")
        .arg(Percent(this->Shares[begin], 1), Percent(this->Shares[begin + ATTAINABLE], 1));
}

// Returns the value of a cell as a number or, of names, as a text; invalid: there is none.
QVariant LimpidStructureModel::value(int row, int column) const
{
  const Row& here = this->Rows[static_cast<std::size_t>(row)];
  switch (column)
  {
    case IMPORTANT:
      return isImportant(here);
    case COLOR:
      return this->colorOf(row).hue();
    case NAME:
      return here[NAME_TEXT];
    case LABEL:
      return here[LABEL_TEXT].toLongLong();
    case IMPORTANCE:
      return here[IMPORTANCE_TEXT].toDouble();
    case TARGET:
      return here[TARGET_TEXT].isEmpty() ? QVariant() : here[TARGET_TEXT].toDouble();
    default:
      return this->Shares.empty() ? QVariant()
                                  : this->Shares[SHARES * static_cast<std::size_t>(row)];
  }
}

QVariant LimpidStructureModel::data(const QModelIndex& index, int role) const
{
  const int column = index.column();
  if (role == SORT_ROLE)
  {
    return this->value(index.row(), column);
  }
  if (column == IMPORTANT)
  {
    const bool isChecked = this->value(index.row(), column).toBool();
    return role == Qt::CheckStateRole ? QVariant(isChecked ? Qt::Checked : Qt::Unchecked)
                                      : QVariant();
  }
  if (column == COLOR)
  {
    return role == Qt::DecorationRole ? Swatch(this->colorOf(index.row())) : QVariant();
  }
  if (role == Qt::ToolTipRole && column == NAME)
  {
    return this->value(index.row(), column); // the column may be too narrow for it
  }
  if (role != Qt::DisplayRole && role != Qt::EditRole)
  {
    return {};
  }
  if (column == VISIBLE)
  {
    return this->visibleText(index.row());
  }
  const QVariant value = this->value(index.row(), column);
  return column == TARGET && value.isValid() ? QString("%1 %").arg(100 * value.toDouble()) : value;
}

bool LimpidStructureModel::setData(const QModelIndex& index, const QVariant& value, int role)
{
  Row& row = this->Rows[static_cast<std::size_t>(index.row())];
  const Row before = row;
  if (index.column() == IMPORTANT && role == Qt::CheckStateRole)
  {
    this->setImportant(row, value.toInt() == Qt::Checked);
  }
  else if (index.column() == IMPORTANCE)
  {
    this->setImportance(row, QString::number(std::clamp(value.toDouble(), 0., 1.)));
  }
  else if (index.column() == TARGET)
  {
    bool isNumber = false;
    const QString share = ShareOf(value.toString(), isNumber);
    row[TARGET_TEXT] = isNumber ? share : row[TARGET_TEXT];
  }
  else if (index.column() == NAME)
  {
    row[NAME_TEXT] = this->freeName(value.toString().trimmed(), row[LABEL_TEXT]);
  }
  if (row == before)
  {
    return false;
  }
  this->tellOfAll();
  Q_EMIT this->edited(index.row(), index.column());
  return true;
}

QVariant LimpidStructureModel::headerData(int section, Qt::Orientation orientation, int role) const
{
  if (orientation != Qt::Horizontal)
  {
    return {};
  }
  if (section == IMPORTANT && role == Qt::DecorationRole)
  {
    return QIcon(":/pqWidgets/Icons/pqEyeball.svg");
  }
  static const std::array<const char*, COLUMNS> titles{ { "", "", QT_TR_NOOP("Name"),
    QT_TR_NOOP("Label"), QT_TR_NOOP("Importance"), QT_TR_NOOP("Target"), QT_TR_NOOP("Visible") } };
  static const std::array<const char*, COLUMNS> toolTips{
    { QT_TR_NOOP("Whether the structure is important."),
      QT_TR_NOOP("Color of the structure, which the picture has with StructureColors. Double-click "
                 "to choose another. Of several selected rows, all are changed."),
      QT_TR_NOOP("Name of the structure."), QT_TR_NOOP("Its value in the structure array."),
      QT_TR_NOOP("How important it is, from 0 to 1. Of several selected rows, all are changed."),
      QT_TR_NOOP("Share that should be visible (%), or nothing. Of several selected rows, all are "
                 "changed."),
      QT_TR_NOOP("How much of it the last picture shows, and could show at most from there. It is "
                 "measured once the picture is finished.") }
  };
  const auto at = static_cast<std::size_t>(section);
  if (role == Qt::DisplayRole)
  {
    return tr(titles[at]);
  }
  return role == Qt::ToolTipRole ? QVariant(tr(toolTips[at])) : QVariant();
}

Qt::ItemFlags LimpidStructureModel::flags(const QModelIndex& index) const
{
  const Qt::ItemFlags usual = Qt::ItemIsEnabled | Qt::ItemIsSelectable;
  switch (index.column())
  {
    case IMPORTANT:
      return usual | Qt::ItemIsUserCheckable;
    case NAME:
    case IMPORTANCE:
    case TARGET:
      return usual | Qt::ItemIsEditable;
    default:
      return usual;
  }
}
