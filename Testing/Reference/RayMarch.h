// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

// The independent truth: a ray march in double precision that shares no code with cuda/.
//
// Extinction and importance are interpolated trilinearly, each for itself, products are formed
// after interpolation, and there is nothing outside the box of the nodes. A ray is cut at the faces
// of the cells. Within a cell both fields are cubic polynomials along the ray, so the optical depth
// is exact, and Gauss' rule with a few points gives the visible importance almost exactly. What
// remains is the spacing of the rays: the midpoint rule, of second order.

#ifndef limpid_testing_RayMarch_h
#define limpid_testing_RayMarch_h

#include <array>
#include <cstdint>

namespace truth
{
using Vector = std::array<double, 3>;

/// Where the nodes are.
struct Lattice
{
  std::array<int, 3> nodes{ { 2, 2, 2 } };
  Vector origin{ { 0, 0, 0 } };  ///< of node (0,0,0)                 [length]
  Vector spacing{ { 1, 1, 1 } }; ///< above zero                      [length]
  std::array<double, 9> direction{ { 1, 0, 0, 0, 1, 0, 0, 0,
    1 } }; ///< orthonormal, row by row; its columns are the axes' directions

  std::int64_t Count() const { return std::int64_t(nodes[0]) * nodes[1] * nodes[2]; }
  Vector Position(double i, double j, double k) const; ///< of an index [length]
  Vector Index(const Vector& position) const;          ///< of a position
  Vector IndexDirection(const Vector& direction) const;
  double LengthOf(const Vector& indexDirection) const; ///< [length]
  double CellVolume() const { return spacing[0] * spacing[1] * spacing[2]; }
};

/// Fields on a lattice, first axis fastest; the caller owns them.
template <class Value>
struct Volume
{
  Lattice lattice;
  const Value* extinction = nullptr; ///< [1/length]
  const Value* importance = nullptr; ///< [0, 1]

  /// The part of the extinction that counts as important where importance is summed; null: all of
  /// it. It attenuates as a whole [1/length].
  const Value* counted = nullptr;

  const Value* Counted() const { return counted ? counted : extinction; }
};

/// Where the rays come from.
struct Source
{
  bool parallel = false;
  Vector position{ { 0, 0, 0 } };  ///< of a point source    [length]
  Vector direction{ { 0, 0, 1 } }; ///< of parallel rays, any length but zero

  static Source Point(const Vector& position) { return { false, position, { { 0, 0, 1 } } }; }
  static Source Parallel(const Vector& direction) { return { true, { { 0, 0, 0 } }, direction }; }
};

struct Sampling
{
  double raysPerVoxel = 1; ///< per voxel and axis, where the rays are farthest apart
  int samplesPerVoxel = 4; ///< points of Gauss' rule in each piece of a ray, 1 to 8
  int minimumRays = 64;    ///< per axis of a bundle of rays, for small volumes
  unsigned threads = 0;    ///< zero: as many as the machine has; the result is the same
};

/// S of Eq. (32): the integral of importance x counted extinction x transmittance over the whole
/// box [length^2].
template <class Value>
double VisibilityScore(const Volume<Value>& volume, const Source& source, const Sampling& sampling);

/// Returns the score without transmittance: what there is to be seen, exact [length^2].
template <class Value>
double ImportantExtinction(const Volume<Value>& volume);

/// Shares of the important matter of a base extinction in [0, 1]: what is seen through the volume's
/// extinction, and what the volume has removed. The kept extinction at a node is the lesser of
/// both; the volume's own `counted` is not used.
struct Shares
{
  double visible;
  double removed;
};

template <class Value>
Shares SharesOf(
  const Volume<Value>& volume, const Value* base, const Source& source, const Sampling& sampling);

/// Optical depth between the source and a position in the box.
template <class Value>
double OpticalDepth(const Volume<Value>& volume, const Source& source, const Vector& position);

/// exp of minus that, Eqs. (15) and (16) [0, 1].
template <class Value>
double Transmittance(const Volume<Value>& volume, const Source& source, const Vector& position);

/// Whether what is behind a position counts with the widening of the rays, t'^2 / t^2.
enum class Widening
{
  Counted, ///< derivative of the volume integral
  Ignored  ///< Eqs. (19) and (20) as printed
};

/// Visible importance behind a position, the integral of importance x extinction x transmittance
/// along the rest of its ray [0, 1 with Widening::Ignored].
template <class Value>
double VisibleBehind(
  const Volume<Value>& volume, const Source& source, const Vector& position, Widening widening);
}

#endif
