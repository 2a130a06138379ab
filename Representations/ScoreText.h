// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

// The text of a view about the last picture of a mapper.

#ifndef limpid_ScoreText_h
#define limpid_ScoreText_h

#include <string>

class vtkTransmittanceVolumeMapper;

namespace limpid
{
/// Returns how much of the important structures is visible, how much could be at most, how much was
/// visible before the optimisation, and its progress; or that nothing important is in view. Then a
/// line for each structure with a target, or, if there is none, for up to three of the most
/// important ones, if their shares are known. Empty if unknown. `isInView`: whether the last
/// picture shows any of the volume. `name`: of the volume; empty: not in the text.
std::string ScoreText(vtkTransmittanceVolumeMapper* mapper, bool isInView, const std::string& name);

/// Returns whether the text would have lines of structures that were not measured yet.
bool NeedsShares(vtkTransmittanceVolumeMapper* mapper);

/// Returns the legend of the paint over the picture; empty if there is none.
std::string MissedText(vtkTransmittanceVolumeMapper* mapper);
}

#endif
