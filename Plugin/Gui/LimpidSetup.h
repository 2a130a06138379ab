// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

/**
 * @class   LimpidSetup
 * @brief   what was set up for a volume once counts everywhere in ParaView's window
 *
 * A filter of Limpid that is created from a volume on display starts with what the display has, and
 * with the camera of the view. A volume that is shown in another view, too, looks there as it does
 * where it was shown last. Both are part of the step that creates the filter or the display, for
 * undo and trace. In pvpython filters and displays have their own defaults. Volumes that were on
 * display before the plugin was loaded are displayed anew, with the types that the plugin adds.
 *
 * ParaView makes one object of this class when the plugin is loaded.
 */

#ifndef LimpidSetup_h
#define LimpidSetup_h

#include <QObject>

class pqPipelineSource;
class pqRepresentation;
class pqView;

class LimpidSetup : public QObject
{
  Q_OBJECT

public:
  explicit LimpidSetup(QObject* parent = nullptr);

  void onStartup();
  void onShutdown() {}

private Q_SLOTS:
  void setUpFilter(pqPipelineSource* filter);
  void addView(pqView* view);
  void setUpDisplay(pqRepresentation* display);
  void renewDisplays();
  void renewNow();
};

#endif
