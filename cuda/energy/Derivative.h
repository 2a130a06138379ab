// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef limpid_energy_Derivative_h
#define limpid_energy_Derivative_h

namespace limpid
{
/// The importance behind a sample that the derivative of a visibility term uses.
enum class Derivative
{
  Volume, ///< exact derivative of the volume integral
  Ray     ///< Eqs. (19)-(20) as printed, without the weight of widening rays
};
}

#endif
