// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

/**
 * @class   LimpidStructureModel
 * @brief   the structures of a segmentation as an editable table
 *
 * A row each: whether it is important, colour, name, label, importance, target share, and what the
 * last picture shows of it. A structure that becomes unimportant keeps its importance in memory,
 * and has it again when it becomes important.
 */

#ifndef LimpidStructureModel_h
#define LimpidStructureModel_h

#include "StructureLooks.h"

#include <QAbstractTableModel>
#include <QColor>
#include <QHash>
#include <QString>
#include <QVariant>

#include <array>
#include <vector>

class LimpidStructureModel : public QAbstractTableModel
{
  Q_OBJECT

public:
  enum Column
  {
    IMPORTANT = 0,
    COLOR = 1,
    NAME = 2,
    LABEL = 3,
    IMPORTANCE = 4,
    TARGET = 5,
    VISIBLE = 6,
    COLUMNS = 7
  };

  /// Data by which rows are sorted.
  static constexpr int SORT_ROLE = Qt::UserRole;

  explicit LimpidStructureModel(QObject* parent);

  ///@{
  /// The rows as the property Structures has them: label, name, importance and target of each.
  QVariantList texts() const;
  void setTexts(const QVariantList& texts);
  ///@}

  ///@{
  /// The colours that labels were given, as the property LabelColors has them: label, red, green
  /// and blue of each. Other rows have colours of the palette.
  QVariantList colors() const;
  void setColors(const QVariantList& numbers);
  ///@}

  QColor colorOf(int row) const;

  /// Gives rows a colour.
  void paint(const std::vector<int>& rows, const QColor& color);

  /// Some rows as the property Structures has them, with the importance that they had last if they
  /// have none.
  QVariantList importantTexts(const std::vector<int>& rows) const;

  /// Sets what the last picture shows, as the property StructureShares has it. Ignored unless it is
  /// for all rows.
  void setShares(const std::vector<double>& shares);

  /// Adds structures for labels that have no row, with names and colours.
  void add(const limpid::StructureLooks& looks, bool important);

  /// Gives names and colours to the rows of labels.
  void rename(const limpid::StructureLooks& looks);

  bool isAnyImportant() const;

  /// Makes all structures important or unimportant.
  void setAllImportant(bool important);

  /// Gives other rows the value that a row has in a column.
  void copy(int row, int column, const std::vector<int>& others);

  int rowCount(const QModelIndex& parent = QModelIndex()) const override;
  int columnCount(const QModelIndex& parent = QModelIndex()) const override;
  QVariant data(const QModelIndex& index, int role = Qt::DisplayRole) const override;
  bool setData(const QModelIndex& index, const QVariant& value, int role = Qt::EditRole) override;
  QVariant headerData(int section, Qt::Orientation orientation, int role) const override;
  Qt::ItemFlags flags(const QModelIndex& index) const override;

Q_SIGNALS:
  void edited(int row, int column); ///< by setData

private:
  // Columns of the property.
  enum Text
  {
    LABEL_TEXT = 0,
    NAME_TEXT = 1,
    IMPORTANCE_TEXT = 2,
    TARGET_TEXT = 3,
    TEXTS = 4
  };
  using Row = std::array<QString, TEXTS>;

  using LabelColor = std::array<double, 4>; // label, red, green and blue

  void paint(double label, const limpid::Color& color);
  static bool isImportant(const Row& row) { return row[IMPORTANCE_TEXT].toDouble() > 0; }
  QString lastImportance(const Row& row) const;
  void setImportance(Row& row, const QString& importance);
  void setImportant(Row& row, bool important);
  QString freeName(const QString& wanted, const QString& label) const;
  QString visibleText(int row) const;
  QVariant value(int row, int column) const;
  void tellOfAll();

  std::vector<Row> Rows;
  std::vector<LabelColor> GivenColors;      // see setColors
  std::vector<double> Shares;               // see setShares; empty: unknown
  QHash<QString, QString> FormerImportance; // of unimportant structures, by label
};

#endif
