// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

// What the view says about the last picture of a mapper.

#ifndef limpid_ScoreText_h
#define limpid_ScoreText_h

#include <string>

class vtkTransmittanceVolumeMapper;

namespace limpid
{
/// How much of what is important can be seen, how much of it could be at most, how much was before
/// the optimisation, and how far the optimisation is; empty when the last picture knew no
/// importance. `name`: of the volume; empty: the text has none.
std::string ScoreText(vtkTransmittanceVolumeMapper* mapper, const std::string& name);

/// What the paint over the picture means; empty where there is none.
std::string MissedText(vtkTransmittanceVolumeMapper* mapper);
}

#endif
