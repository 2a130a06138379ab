// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

// Layers that two constant halves do not represent accurately: where a ray enters or leaves the
// box, and where a layer stops much of the light.

#ifndef limpid_sweep_ResolvedLayer_h
#define limpid_sweep_ResolvedLayer_h

#include "math/Vec.h"
#include "sweep/RayLayer.h"

namespace limpid
{
/// The fields at a point of a ray.
struct PointSample
{
  float extinction; ///< [1/length]
  float importance; ///< [0, 1]
  float kept;       ///< kept base extinction: min of extinction and base extinction [1/length]
};

/// The fields sampled along a ray; null if not needed.
template <class Field>
struct RayFields
{
  Field extinction; ///< [1/length]
  Field importance; ///< [0, 1]
  Field base;       ///< base extinction [1/length]
};

/**
 * A short segment of a ray in which extinction mu and importance g are linear
 * (Documentation/Method.md, quadrature). It evaluates the integrals of Eqs. (19) and (20). With
 * the segment's optical depth x and mean transmittance m = (1 - e^-x) / x,
 *
 *    integral of g mu T dt = g0 (1 - m) + g1 (m - e^-x) + (g1 - g0) tilt m,
 *
 * where T = 1 at the front. The first two terms are exact for constant mu. The third term, with
 * tilt = (mu1 - mu0) length / 12, makes the sum exact for thin segments.
 */
struct RayPiece
{
  float place;        ///< position of its centre, as a fraction of the layer's thickness
  float size;         ///< its extent, as a fraction of the layer's thickness
  float opticalDepth; ///< x [1]
  float tilt;         ///< [1]
  float front;        ///< importance at the front, times scale^2
  float back;         ///< importance at the back, times scale^2
  float keptShare;    ///< share of the extinction that is kept base extinction [0, 1]
  float keptTilt;     ///< tilt of the kept base extinction [1]

  LIMPID_HD LIMPID_INLINE float Passed() const { return Attenuate(this->opticalDepth); }

  LIMPID_HD LIMPID_INLINE float Visible() const { return this->Shown(1.0f, this->tilt); }

  /// Visible importance of the kept base extinction.
  LIMPID_HD LIMPID_INLINE float KeptVisible() const
  {
    return this->Shown(this->keptShare, this->keptTilt);
  }

  /// The integral of g mu dt.
  LIMPID_HD LIMPID_INLINE float Unattenuated() const { return this->Present(1.0f, this->tilt); }

  LIMPID_HD LIMPID_INLINE float KeptUnattenuated() const
  {
    return this->Present(this->keptShare, this->keptTilt);
  }

  /// The derivative of Visible by the optical depth.
  LIMPID_HD LIMPID_INLINE float VisibleSlope() const
  {
    const float x = this->opticalDepth;
    const float passed = this->Passed();
    const float meanSlope = x < series
      ? -1.0f / 2 + x * (1.0f / 3 - x * (1.0f / 8 - x * (1.0f / 30)))
      : Quotient(passed - this->MeanTransmittance(), x);
    return this->back * passed + (this->back - this->front) * meanSlope * (1.0f + this->tilt);
  }

  /// The derivative of Visible by the tilt.
  LIMPID_HD LIMPID_INLINE float TiltSlope() const
  {
    return (this->back - this->front) * this->MeanTransmittance();
  }

private:
  static constexpr float series = 0.1f; ///< for smaller x, power series are used; exact to rounding

  /// Visible importance of a `share` of the extinction with the given tilt.
  LIMPID_HD LIMPID_INLINE float Shown(float share, float tiltOfShare) const
  {
    const float x = this->opticalDepth;
    const float mean = this->MeanTransmittance();
    const bool thin = x < series;
    const float ofFront =
      thin ? x * (1.0f / 2 - x * (1.0f / 6 - x * (1.0f / 24 - x * (1.0f / 120)))) : 1.0f - mean;
    const float ofBack = thin ? x * (1.0f / 2 - x * (1.0f / 3 - x * (1.0f / 8 - x * (1.0f / 30))))
                              : mean - this->Passed();
    return share * (this->front * ofFront + this->back * ofBack) +
      (this->back - this->front) * tiltOfShare * mean;
  }

  LIMPID_HD LIMPID_INLINE float Present(float share, float tiltOfShare) const
  {
    return share * (0.5f * (this->front + this->back) * this->opticalDepth) +
      (this->back - this->front) * tiltOfShare;
  }

  LIMPID_HD LIMPID_INLINE float MeanTransmittance() const
  {
    const float x = this->opticalDepth;
    return x < series ? 1.0f - x * (1.0f / 2 - x * (1.0f / 6 - x * (1.0f / 24 - x * (1.0f / 120))))
                      : Quotient(Stop(x), x);
  }
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
constexpr int piecesOfPart = 4;      ///< number of equal segments of a part

/// Returns the number of parts into which a layer of optical depth `depth` is divided.
LIMPID_HD LIMPID_INLINE int PartsOfLayer(float depth)
{
  return depth <= 1.0f ? 1
    : depth <= 4.0f    ? 2
    : depth <= 16.0f   ? 4
    : depth <= 64.0f   ? 8
                       : mostPartsOfLayer;
}

/// The effects of extinction at the two ends of a layer, see EffectStep; T = 1 at the front.
struct LayerEffect
{
  float front;
  float back;
};

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

  /// Range inside the box, as fractions of the layer's thickness.
  LIMPID_HD LIMPID_INLINE Range<float> Inside() const
  {
    return ClippedRange(this->plain.layer, { 0.0f, 1.0f }, this->plain.column, this->plain.row);
  }

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
    return !Cuts::atFaces && this->IsWhole() ? this->plain.Light().unattenuated : ofPieces;
  }

  /// The effect of the layer on light, inside the box.
  LIMPID_HD LIMPID_INLINE LayerLight Light() const
  {
    LayerLight light{};
    this->AddPieces(light, [](const RayPiece&, float) {});
    return light;
  }

  /// Light and effects. `behind`: visible importance at the back of the part inside the box.
  LIMPID_HD LIMPID_INLINE LayerLight Light(float behind, LayerEffect& effect) const
  {
    struct Met
    {
      float visible, depthSlope, tiltSlope, place, size;
    };
    Met met[mostPartsOfLayer * piecesOfPart];
    int count = 0;
    LayerLight light{};
    float seen = behind *
      this->AddPieces(light,
        [&](const RayPiece& piece, float transmittance)
        {
          met[count] = { transmittance * piece.Visible(), transmittance * piece.VisibleSlope(),
            transmittance * piece.TiltSlope(), piece.place, piece.size };
          ++count;
        });
    seen += light.visible; // from the current segment on
    effect = { 0, 0 };
    for (int number = 0; number < count; ++number)
    {
      const Met& piece = met[number];
      seen -= piece.visible;
      const float unit = this->plain.layer.thickness * piece.size;
      const float ofDepth = unit * (seen - piece.depthSlope);
      const float ofTilt = piece.size * (-1.0f / 12) * unit * piece.tiltSlope;
      effect.front += (1.0f - piece.place) * ofDepth - ofTilt;
      effect.back += piece.place * ofDepth + ofTilt;
    }
    return light;
  }

  LIMPID_HD LIMPID_INLINE float DepthFromEntry() const { return this->plain.DepthFromEntry(); }
  LIMPID_HD LIMPID_INLINE float WholeDepth() const { return this->plain.WholeDepth(); }

private:
  static constexpr float nothing = 1e-5f; ///< transmittance below which segments are ignored

  /// Whether the ray is inside the box throughout the layer.
  LIMPID_HD LIMPID_INLINE bool IsWhole() const
  {
    const Range<float> inside = this->Inside();
    return inside.begin <= 0.0f && inside.end >= 1.0f;
  }

  /// The intervals between the cell faces that the ray crosses inside the box.
  struct Stretches
  {
    float ends[4];
    int count;

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

  LIMPID_HD LIMPID_INLINE Stretches StretchesOf(const Range<float>& inside) const
  {
    Stretches stretches{ { inside.begin }, 0 };
    if (Cuts::atFaces)
    {
      const Range<float> faces = this->sampler.FacesCrossed(this->column);
      stretches.EndAt(faces.begin, inside.end);
      stretches.EndAt(faces.end, inside.end);
    }
    ++stretches.count;
    stretches.ends[stretches.count] = inside.end;
    return stretches;
  }

  /// Calls visit(segment) inside the box until it returns false. `order(number, count)`: index of
  /// the element that is visited as number `number` of `count`.
  template <class Order, class Visit>
  LIMPID_HD LIMPID_INLINE void ForPiecesInOrder(const Order& order, const Visit& visit) const
  {
    const Stretches stretches = this->StretchesOf(this->Inside());
    for (int number = 0; number < stretches.count; ++number)
    {
      const int stretch = order(number, stretches.count);
      if (!this->VisitPieces(
            { stretches.ends[stretch], stretches.ends[stretch + 1] }, order, visit))
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
    const int parts = PartsOfLayer(Cuts::finer * this->densest * way * stretch.Length());
    const float size = stretch.Length() / static_cast<float>(parts);
    const float length = way * size * (1.0f / piecesOfPart);
    if (!(size > 0.0f))
    {
      return true;
    }
    for (int part = 0; part < parts; ++part)
    {
      const float begin = stretch.begin + size * static_cast<float>(order(part, parts));
      const PointSample first = this->SampleAt(begin + size * float(gaussPoints[0]));
      const PointSample second = this->SampleAt(begin + size * float(gaussPoints[1]));
      for (int number = 0; number < piecesOfPart; ++number)
      {
        const auto piece = static_cast<float>(order(number, piecesOfPart));
        const float shares[2] = { piece * (1.0f / piecesOfPart),
          (piece + 1.0f) * (1.0f / piecesOfPart) };
        if (!visit(this->PieceOf(first, second, shares, begin, size, length)))
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

  /// Adds the effect of all segments to `light` and calls visit(segment, transmittance in front of
  /// it). Returns the transmittance of all segments.
  template <class Visit>
  LIMPID_HD LIMPID_INLINE float AddPieces(LayerLight& light, const Visit& visit) const
  {
    float transmittance = 1;
    float opticalDepth = 0;
    this->ForPieces(
      [&](const RayPiece& piece)
      {
        const bool isLit = transmittance > nothing;
        light.unattenuated += piece.Unattenuated();
        light.keptUnattenuated += piece.KeptUnattenuated();
        opticalDepth += piece.opticalDepth;
        if (isLit)
        {
          visit(piece, transmittance);
          light.visible += transmittance * piece.Visible();
          light.keptVisible += transmittance * piece.KeptVisible();
          transmittance *= piece.Passed();
        }
        return Cuts::atFaces || transmittance > nothing;
      });
    if (Cuts::atFaces)
    {
      light.passed = transmittance;
      light.opticalDepth = AtMost(opticalDepth, 1e4f);
      return transmittance;
    }
    const LayerLight halves = this->plain.Light();
    light.passed = halves.passed;
    light.opticalDepth = halves.opticalDepth;
    if (!(transmittance > nothing) || this->IsWhole()) // no segments in the dark
    {
      light.unattenuated = halves.unattenuated;
      light.keptUnattenuated = halves.keptUnattenuated;
    }
    return transmittance;
  }

  /// Returns the segment between two fractions of a part; `first`, `second`: samples at the part's
  /// Gauss points.
  LIMPID_HD LIMPID_INLINE RayPiece PieceOf(const PointSample& first, const PointSample& second,
    const float shares[2], float begin, float size, float length) const
  {
    constexpr float origin = float(gaussPoints[0]);
    constexpr float inverse = float(1.0 / (gaussPoints[1] - gaussPoints[0]));
    const auto line = [&](float one, float other, float share)
    { return one + (other - one) * ((share - origin) * inverse); };
    const auto extinction = [&](float share)
    { return AtLeast(line(first.extinction, second.extinction, share), 0.0f); };
    const auto importance = [&](float share)
    { return Clamp(line(first.importance, second.importance, share), 0.0f, 1.0f); };
    const auto kept = [&](float share)
    { return AtLeast(line(first.kept, second.kept, share), 0.0f); };
    const float middle = 0.5f * (shares[0] + shares[1]);
    const float ends[2] = { extinction(shares[0]), extinction(shares[1]) };
    const float mean = 0.5f * (ends[0] + ends[1]);
    const float keptEnds[2] = { kept(shares[0]), kept(shares[1]) };
    const float keptMean = 0.5f * (keptEnds[0] + keptEnds[1]);
    RayPiece piece;
    piece.place = begin + size * middle;
    piece.size = size * (shares[1] - shares[0]);
    piece.opticalDepth = mean * length;
    piece.tilt = (ends[1] - ends[0]) * length * (1.0f / 12);
    const float area = this->AreaAt(piece.place, piece.size);
    piece.front = area * importance(shares[0]);
    piece.back = area * importance(shares[1]);
    piece.keptShare = keptMean < mean ? Quotient(keptMean, mean) : 1.0f;
    piece.keptTilt = (keptEnds[1] - keptEnds[0]) * length * (1.0f / 12);
    return piece;
  }

  /// The mean of scale^2 over a segment.
  LIMPID_HD LIMPID_INLINE float AreaAt(float place, float size) const
  {
    const Layer& layer = this->plain.layer;
    const float widening = layer.backScale - layer.frontScale;
    const float scale = layer.frontScale + place * widening;
    return scale * scale + (1.0f / 12) * (size * widening) * (size * widening);
  }
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
  if (inside && !resolve.Reaches(i))
  {
    plain(i);
    return;
  }
  const MostInLayer most = MostOf<Cuts>(ray, sampler, fields, column);
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
