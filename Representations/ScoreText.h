// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

// What the view says about the last picture of a mapper.

#ifndef limpid_ScoreText_h
#define limpid_ScoreText_h

#include <string>

class vtkTransmittanceVolumeMapper;

namespace limpid
{
/// How much of the important structures can be seen, how much of them could be at most, how much
/// was before the optimisation, and how far the optimisation is; or that nothing important is in
/// view; empty where nobody knows. `isInView`: whether the last picture shows any of the volume.
/// `name`: of the volume; empty: the text has none.
std::string ScoreText(vtkTransmittanceVolumeMapper* mapper, bool isInView, const std::string& name);

/// What the paint over the picture means; empty where there is none.
std::string MissedText(vtkTransmittanceVolumeMapper* mapper);
}

#endif
