// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

// The methods for revealing important structures that a user can choose from.

#ifndef limpid_methods_Method_h
#define limpid_methods_Method_h

namespace limpid
{
enum class Method
{
  Optimized,     ///< minimises Eq. (21)
  Ordinary,      ///< the extinction of the transfer function, unchanged
  Viola2004,     ///< see RayObject
  Marchesin2010, ///< see WeighedMean
  Ament2017      ///< see AmentWeights
};

constexpr int methodCount = 5;

/// How the samples of a ray are combined.
enum class Compositing
{
  FrontToBack,   ///< Eq. (6)
  FromObject,    ///< Eq. (6), starting at the most important object, see RayObject
  ImportanceMean ///< independent of order, see WeighedMean
};

/// General properties of a method.
struct MethodInfo
{
  const char* name;
  Compositing compositing;
  bool iterates;           ///< minimises Eq. (21); other methods have one pass
  bool hasLightExtinction; ///< has separate extinctions for camera and light
  bool castsShadows;       ///< if not, T_L = 1, as in Section 4.3
};

const MethodInfo& InfoOf(Method method);

/// Parameters of Ament et al. [AZD17], see AmentKeptShare.
struct AmentWeights
{
  double exponent = 1;         ///< lambda, >= 0
  double regularization = 1;   ///< p, > 0
  double occluders = 100;      ///< q for the camera, against occluders, >= 0
  double background = 0;       ///< r for the camera, against the background, >= 0
  double lightOccluders = 100; ///< q for the light
  double lightBackground = 0;
  int smoothingPasses = 1; ///< >= 0
};
}

#endif
