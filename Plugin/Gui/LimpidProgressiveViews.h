// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

/**
 * @class   LimpidProgressiveViews
 * @brief   creates a LimpidProgressiveView for every render view of ParaView's window
 *
 * ParaView creates one object of this class when the plugin is loaded.
 */

#ifndef LimpidProgressiveViews_h
#define LimpidProgressiveViews_h

#include <QList>
#include <QObject>
#include <QPointer>

class LimpidProgressiveView;
class pqProxy;
class pqView;

class LimpidProgressiveViews : public QObject
{
  Q_OBJECT

public:
  explicit LimpidProgressiveViews(QObject* parent = nullptr);

  void onStartup();
  void onShutdown();

private Q_SLOTS:
  void addView(pqView* view);
  void addScene(pqProxy* proxy);
  void pause();
  void resume();

private:
  void setPaused(bool paused);

  QList<QPointer<LimpidProgressiveView>> Views; // each belongs to its pqView
};

#endif
