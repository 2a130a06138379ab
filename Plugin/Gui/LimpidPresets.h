// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

/**
 * @class   LimpidPresets
 * @brief   adds the color presets of Plugin/Presets to ParaView's
 *
 * ParaView makes one object of this class when the plugin is loaded. A preset that is there already
 * stays as it is. Arrays of visibility scores have their preset from the start, and colors that
 * span the scores of the last search (ParaView's own only ever span more), unless the user's own
 * settings say otherwise.
 */

#ifndef LimpidPresets_h
#define LimpidPresets_h

#include <QObject>

class LimpidPresets : public QObject
{
  Q_OBJECT

public:
  explicit LimpidPresets(QObject* parent = nullptr);

  void onStartup();
  void onShutdown() {}
};

#endif
