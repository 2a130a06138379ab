// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef limpid_energy_Derivative_h
#define limpid_energy_Derivative_h

namespace limpid
{
/// What the derivative of a visibility term takes for the importance behind a sample.
enum class Derivative
{
  Volume, ///< exact derivative of the volume integral
  Ray     ///< Eqs. (19)-(20) as printed: without the weight of the widening rays
};
}

#endif
