// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

/**
 * @class   LimpidRows
 * @brief   adds to rows of the properties panel that ParaView makes
 *
 * Without it, and so without LimpidGui, they are ParaView's own rows.
 */

#ifndef LimpidRows_h
#define LimpidRows_h

#include "pqPropertyWidgetInterface.h"

#include <QList>
#include <QObject>
#include <QPointer>

class pqPropertyWidget;

class LimpidRows
  : public QObject
  , public pqPropertyWidgetInterface
{
  Q_OBJECT
  Q_INTERFACES(pqPropertyWidgetInterface)

public:
  explicit LimpidRows(QObject* parent = nullptr);

  void createDefaultWidgetDecorators(pqPropertyWidget* row) override;

private Q_SLOTS:
  void addEditors();

private:
  QList<QPointer<pqPropertyWidget>> Waiting; // rows whose function is not there yet
};

#endif
