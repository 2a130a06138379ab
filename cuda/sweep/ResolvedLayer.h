// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

// Layers that two constant halves do not represent accurately: where a ray enters or leaves the
// box, and where a layer stops much of the light.

#ifndef limpid_sweep_ResolvedLayer_h
#define limpid_sweep_ResolvedLayer_h

#include "sweep/RayPiece.h"

namespace limpid
{
/// The fields sampled along a ray; null if not needed.
template <class Field>
struct RayFields
{
  Field extinction; ///< [1/length]
  Field importance; ///< [0, 1]
  Field base;       ///< base extinction [1/length]
};

/// Optical depth beyond which nothing is visible: T = 1e-7.
constexpr float darkDepth = 16.0f;

/// The criterion by which sweeps resolve thick layers. Two constant halves have an error of 0.1 %
/// of the visible importance at the optical depth `thick`, and of three times as much at twice
/// that depth.
struct UsualCuts
{
  static constexpr float thick = 0.5f;   ///< layers are resolved from this optical depth on
  static constexpr float finer = 1;      ///< layers are divided as if they were this much deeper
  static constexpr bool atFaces = false; ///< whether layers are also divided at faces of cells
};

/// The criterion of scores. A ray may cross two faces of cells within a layer, where fields have
/// kinks. One pair of Gauss points cannot resolve these and misses the surface of opaque
/// structures. Scores of real data would be off by 0.2 to 0.4 %, those of an opaque block on edge
/// by 10 %.
struct FineCuts
{
  static constexpr float thick = 0.25f;
  static constexpr float finer = 4;
  static constexpr bool atFaces = true;
};

/// The larger extinction at the two Gauss points [1/length].
template <LayerCrossing passage>
LIMPID_HD LIMPID_INLINE float DensestOf(const RayInLayer<passage>& ray)
{
  return ray.extinction[0] > ray.extinction[1] ? ray.extinction[0] : ray.extinction[1];
}

/// The largest samples of a ray in a layer.
struct MostInLayer
{
  float extinction; ///< [1/length]
  float importance; ///< [0, 1]
};

/// Maximum over the Gauss points and, with FineCuts, over the ends of the layer. `sampler`:
/// samples fields along the ray in `column`.
template <class Cuts, class Sampler, LayerCrossing passage>
LIMPID_HD LIMPID_INLINE MostInLayer MostOf(const RayInLayer<passage>& ray, const Sampler& sampler,
  const RayFields<typename Sampler::Field>& fields, int column)
{
  const float front = ray.importance[0];
  const float rear = ray.importance[1];
  MostInLayer most{ DensestOf(ray), front > rear ? front : rear };
  if (Cuts::atFaces)
  {
    for (int end = 0; end < 2; ++end)
    {
      const PointSample sample = sampler.SampleAt(fields, static_cast<float>(end), column);
      most.extinction = AtLeast(sample.extinction, most.extinction);
      most.importance = AtLeast(sample.importance, most.importance);
    }
  }
  return most;
}

/**
 * Selects which layers with important samples are resolved, besides those where a ray enters or
 * leaves the box: here none. Where no sample is important, two halves are exact.
 *
 * `Reaches`: whether the layer of ray i is considered at all. `Densest`: the extinction that
 * decides how a layer is divided, from the largest sample [1/length]. `LeastOnWay`: if all
 * extinction samples of a row are below it, no layer of that row is resolved. `way`: the longest
 * path of its rays through the layer [length].
 */
struct ResolveSides
{
  using Cuts = UsualCuts;

  LIMPID_HD LIMPID_INLINE bool Reaches(Index) const { return false; }
  LIMPID_HD LIMPID_INLINE float Densest(float sampled) const { return sampled; }
  LIMPID_HD LIMPID_INLINE float LeastOnWay(float) const { return 1e30f; }
};

/// Resolves thick layers that light reaches.
template <class TheCuts = UsualCuts>
struct ResolveLit
{
  using Cuts = TheCuts;

  const double* opticalDepths; ///< optical depths of the rays at the front of the layer

  LIMPID_HD LIMPID_INLINE bool Reaches(Index i) const
  {
    return this->opticalDepths[i] < double(darkDepth);
  }

  LIMPID_HD LIMPID_INLINE float Densest(float sampled) const { return sampled; }

  LIMPID_HD LIMPID_INLINE float LeastOnWay(float way) const
  {
    return Cuts::atFaces ? -1.0f : Cuts::thick / way;
  }
};

constexpr int mostPartsOfLayer = 16; ///< each with its own Gauss points

/// Returns the number of parts into which a layer of optical depth `depth` is divided.
LIMPID_HD LIMPID_INLINE int PartsOfLayer(float depth)
{
  return depth <= 1.0f ? 1
    : depth <= 4.0f    ? 2
    : depth <= 16.0f   ? 4
    : depth <= 64.0f   ? 8
                       : mostPartsOfLayer;
}

/// The intervals of a layer between the cell faces that a ray crosses inside the box.
struct Stretches
{
  float ends[4];
  int count;

  /// `inside`: range inside the box; `faces`: see FaceFrustum::FacesCrossed; all are fractions of
  /// the layer's thickness.
  LIMPID_HD LIMPID_INLINE Stretches(const Range<float>& inside, const Range<float>& faces)
    : ends{ inside.begin, 0, 0, 0 }
    , count(0)
  {
    this->EndAt(faces.begin, inside.end);
    this->EndAt(faces.end, inside.end);
    ++this->count;
    this->ends[this->count] = inside.end;
  }

  LIMPID_HD LIMPID_INLINE Range<float> At(int number) const
  {
    return { this->ends[number], this->ends[number + 1] };
  }

private:
  /// Ends an interval at `share` if that lies between its begin and `last`.
  LIMPID_HD LIMPID_INLINE void EndAt(float share, float last)
  {
    if (share > this->ends[this->count] && share < last)
    {
      ++this->count;
      this->ends[this->count] = share;
    }
  }
};

/// The parts into which an interval of a layer is divided.
struct Parts
{
  float begin; ///< of the first, as a fraction of the layer's thickness
  float size;  ///< as a fraction of the layer's thickness
  int count;   ///< 0 if the interval is empty

  /// `densest`: the extinction that decides [1/length]; `way`: length of the ray in the layer
  /// [length].
  template <class Cuts>
  LIMPID_HD LIMPID_INLINE static Parts Of(const Range<float>& stretch, float densest, float way)
  {
    const int count = PartsOfLayer(Cuts::finer * densest * way * stretch.Length());
    const float size = stretch.Length() / static_cast<float>(count);
    return { stretch.begin, size, size > 0.0f ? count : 0 };
  }

  LIMPID_HD LIMPID_INLINE float BeginOf(int part) const
  {
    return this->begin + this->size * static_cast<float>(part);
  }
};

/// Returns the light of a layer from that of its segments. Two halves give how much passes, and
/// what is there without attenuation, unless only segments do (`Cuts`). `isWhole`: whether the ray
/// is inside the box throughout the layer.
template <class Cuts>
LIMPID_HD LIMPID_INLINE LayerLight LightOf(
  const LightOfPieces<float>& pieces, const LayerLight& halves, bool isWhole)
{
  LayerLight light{ pieces.transmittance, pieces.visible, pieces.unattenuated, pieces.keptVisible,
    pieces.keptUnattenuated, AtMost(pieces.opticalDepth, 1e4f) };
  if (Cuts::atFaces)
  {
    return light;
  }
  light.passed = halves.passed;
  light.opticalDepth = halves.opticalDepth;
  if (!pieces.IsLit() || isWhole) // no segments in the dark
  {
    light.unattenuated = halves.unattenuated;
    light.keptUnattenuated = halves.keptUnattenuated;
  }
  return light;
}

/// The path of a ray through a layer, resolved into segments. `Sampler`: samples fields along it.
template <class Sampler, class Cuts>
struct ResolvedRay
{
  const Sampler& sampler;
  RayFields<typename Sampler::Field> fields;
  RayInLayer<LayerCrossing::Clipped> plain; ///< the layer as two halves
  int column;                               ///< column of the ray
  float sampled;                            ///< largest sampled extinction [1/length]
  float densest; ///< extinction that decides how the layer is divided [1/length]

  /// Calls visit(segment) front to back inside the box, until it returns false.
  template <class Visit>
  LIMPID_HD LIMPID_INLINE void ForPieces(const Visit& visit) const
  {
    this->ForPiecesInOrder([](int number, int) { return number; }, visit);
  }

  /// Like ForPieces, but back to front.
  template <class Visit>
  LIMPID_HD LIMPID_INLINE void ForPiecesBackward(const Visit& visit) const
  {
    this->ForPiecesInOrder([](int number, int count) { return count - 1 - number; }, visit);
  }

  /// World length of a segment [length].
  LIMPID_HD LIMPID_INLINE float LengthOf(const RayPiece& piece) const
  {
    return piece.size * (this->plain.layer.thickness * this->plain.length);
  }

  /// The integral of g mu dt, given its sum over all segments. Two halves are exact, and used, if
  /// the whole layer is inside the box and is not divided at faces.
  LIMPID_HD LIMPID_INLINE float Unattenuated(float ofPieces) const
  {
    return !Cuts::atFaces && IsWhole(this->plain.Inside()) ? this->plain.Light().unattenuated
                                                           : ofPieces;
  }

  /// The effect of the layer on light, inside the box.
  LIMPID_HD LIMPID_INLINE LayerLight Light() const
  {
    return this->LightOfAll(this->PassPieces([](const RayPiece&, float) {}));
  }

  /// Light and effects. `behind`: visible importance at the back of the part inside the box.
  LIMPID_HD LIMPID_INLINE LayerLight Light(float behind, LayerEffect& effect) const
  {
    EffectOfPieces<float> effects;
    const float thickness = this->plain.layer.thickness;
    const LightOfPieces<float> pieces =
      this->PassPieces([&](const RayPiece& piece, float transmittance)
        { effects.Add(piece, transmittance, true, thickness); });
    effect = effects.With(behind * pieces.transmittance);
    return this->LightOfAll(pieces);
  }

  LIMPID_HD LIMPID_INLINE float DepthFromEntry() const { return this->plain.DepthFromEntry(); }

private:
  /// Calls visit(segment) inside the box until it returns false. `order(number, count)`: index of
  /// the element that is visited as number `number` of `count`.
  template <class Order, class Visit>
  LIMPID_HD LIMPID_INLINE void ForPiecesInOrder(const Order& order, const Visit& visit) const
  {
    const Range<float> inside = this->plain.Inside();
    if constexpr (!Cuts::atFaces)
    {
      this->VisitPieces(inside, order, visit);
      return;
    }
    const Stretches stretches(inside, this->sampler.FacesCrossed(this->column));
    for (int number = 0; number < stretches.count; ++number)
    {
      if (!this->VisitPieces(stretches.At(order(number, stretches.count)), order, visit))
      {
        return;
      }
    }
  }

  /// ForPiecesInOrder for one interval. Returns whether all of its segments were visited.
  template <class Order, class Visit>
  LIMPID_HD LIMPID_INLINE bool VisitPieces(
    const Range<float>& stretch, const Order& order, const Visit& visit) const
  {
    const float way = this->plain.layer.thickness * this->plain.length;
    const Parts parts = Parts::Of<Cuts>(stretch, this->densest, way);
    const float length = way * parts.size * (1.0f / piecesOfPart);
    for (int number = 0; number < parts.count; ++number)
    {
      const float begin = parts.BeginOf(order(number, parts.count));
      const PartOfLayer<float> part{ begin, parts.size, length,
        this->SampleAt(begin + parts.size * float(gaussPoints[0])),
        this->SampleAt(begin + parts.size * float(gaussPoints[1])) };
      for (int piece = 0; piece < piecesOfPart; ++piece)
      {
        if (!visit(part.Piece(this->plain.layer, order(piece, piecesOfPart))))
        {
          return false;
        }
      }
    }
    return true;
  }

  LIMPID_HD LIMPID_INLINE PointSample SampleAt(float share) const
  {
    return this->sampler.SampleAt(this->fields, share, this->column);
  }

  /// Lets light pass through all segments, and calls visit(segment, transmittance in front of it)
  /// for those that are lit.
  template <class Visit>
  LIMPID_HD LIMPID_INLINE LightOfPieces<float> PassPieces(const Visit& visit) const
  {
    LightOfPieces<float> light;
    this->ForPieces(
      [&](const RayPiece& piece)
      {
        if (light.IsLit())
        {
          visit(piece, light.transmittance);
        }
        light.Add(piece, true);
        return Cuts::atFaces || light.IsLit();
      });
    return light;
  }

  LIMPID_HD LIMPID_INLINE LayerLight LightOfAll(const LightOfPieces<float>& pieces) const
  {
    return LightOf<Cuts>(pieces, this->plain.Light(), IsWhole(this->plain.Inside()));
  }
};

/// The path of a ray through a resolved layer whose effects have been computed together with those
/// of other rays, see ResolvedRay.
struct LitRay
{
  const RayInLayer<LayerCrossing::Clipped>& plain; ///< the layer as two halves
  LayerLight light;
  LayerEffect effect;

  LIMPID_INLINE LayerLight Light() const { return this->light; }

  LIMPID_INLINE LayerLight Light(float, LayerEffect& found) const
  {
    found = this->effect;
    return this->light;
  }

  LIMPID_INLINE float DepthFromEntry() const { return this->plain.DepthFromEntry(); }
};

/// Calls step(ray, i) with a ResolvedRay if the layer is resolved (ResolveSides), else plain(i).
/// `i`: index of the ray's states; `column`: its column.
template <class Sampler, class Resolve, class Step, class Plain>
LIMPID_HD LIMPID_INLINE void StepResolved(const RayInLayer<LayerCrossing::Clipped>& ray,
  const Sampler& sampler, const RayFields<typename Sampler::Field>& fields, const Resolve& resolve,
  int column, Index i, const Step& step, const Plain& plain)
{
  using Cuts = typename Resolve::Cuts;
  const bool inside = ray.StaysInside();
  MostInLayer most{ 0.0f, 0.0f };
  if ((!inside || resolve.Reaches(i)) && !ray.StaysOutside())
  {
    most = MostOf<Cuts>(ray, sampler, fields, column);
  }
  const float densest = resolve.Densest(most.extinction);
  const bool thick = densest * ray.layer.thickness * ray.length > Cuts::thick;
  if (most.importance > 0.0f && (!inside || thick))
  {
    step(ResolvedRay<Sampler, Cuts>{ sampler, fields, ray, column, most.extinction, densest }, i);
  }
  else
  {
    plain(i);
  }
}
}

#endif
