// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

// The ways to show what matters that a user can choose from.

#ifndef limpid_methods_Method_h
#define limpid_methods_Method_h

namespace limpid
{
enum class Method
{
  Optimized,     ///< minimises Eq. (21)
  Ordinary,      ///< the extinction of the transfer function, untouched
  Viola2004,     ///< see RayObject
  Marchesin2010, ///< see WeighedMean
  Ament2017      ///< see AmentWeights
};

constexpr int methodCount = 5;

/// How a picture is made of the samples of a ray.
enum class Compositing
{
  FrontToBack,   ///< Eq. (6)
  FromObject,    ///< the same from the most important object on, see RayObject
  ImportanceMean ///< in no order, see WeighedMean
};

/// What a method is to those who know nothing else of it.
struct MethodInfo
{
  const char* name;
  Compositing compositing;
  bool iterates;           ///< minimises Eq. (21); else there is one pass
  bool hasLightExtinction; ///< finds another extinction for the light than for the camera
  bool castsShadows;       ///< else T_L = 1, as in Section 4.3
};

const MethodInfo& InfoOf(Method method);

/// Parameters of Ament et al. [AZD17], see AmentKeptShare.
struct AmentWeights
{
  double exponent = 1;         ///< lambda, >= 0
  double regularization = 1;   ///< p, > 0
  double occluders = 100;      ///< q for the camera: against what hides, >= 0
  double background = 0;       ///< r for the camera: against what lies behind, >= 0
  double lightOccluders = 100; ///< the same for the light
  double lightBackground = 0;
  int smoothingPasses = 1; ///< >= 0

  /// Throws limpid::Error on a value that cannot be worked with.
  void Require() const;
};

bool operator==(const AmentWeights& one, const AmentWeights& other);
}

#endif
