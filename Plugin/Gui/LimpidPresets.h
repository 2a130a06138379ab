// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

/**
 * @class   LimpidPresets
 * @brief   adds the color presets of Plugin/Presets to ParaView's
 *
 * ParaView creates one object of this class when the plugin is loaded. Existing presets of the same
 * name are not changed. Arrays of visibility scores use their preset by default, and their colors
 * span the scores of the last search, unless the user's settings say otherwise. (By default,
 * ParaView's ranges only grow.) What is shown by a script beside other scores does not narrow their
 * range.
 */

#ifndef LimpidPresets_h
#define LimpidPresets_h

#include <QObject>

class pqRepresentation;
class pqView;

class LimpidPresets : public QObject
{
  Q_OBJECT

public:
  explicit LimpidPresets(QObject* parent = nullptr);

  void onStartup();
  void onShutdown() {}

private Q_SLOTS:
  void addView(pqView* view);
  void keepRange(pqRepresentation* representation);
};

#endif
