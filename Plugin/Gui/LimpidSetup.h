// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

/**
 * @class   LimpidSetup
 * @brief   reuses the settings of a volume for new filters and displays in ParaView's window
 *
 * A filter of Limpid that is created for a displayed volume starts with the settings of the display
 * and the camera of the view. A volume that is shown in another view, too, has the look that it had
 * where it was shown last. Both are part of the undo step and of the trace that create the filter
 * or the display. In pvpython, filters and displays have their own defaults. Volumes that were
 * displayed before the plugin was loaded get new displays with the types that the plugin adds.
 *
 * ParaView creates one object of this class when the plugin is loaded.
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
