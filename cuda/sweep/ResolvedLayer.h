// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

// Layers in which two constant halves are not enough: where a ray enters or leaves the box, and
// where a layer stops much of the light.

#ifndef limpid_sweep_ResolvedLayer_h
#define limpid_sweep_ResolvedLayer_h

#include "math/Vec.h"
#include "sweep/RayLayer.h"

namespace limpid
{
/// Fields at a point of a ray.
struct PointSample
{
  float extinction; ///< [1/length]
  float importance; ///< [0, 1]
  float kept;       ///< what the extinction keeps of the base extinction [1/length]
};

/// The fields that are sampled along a ray; null: not needed.
template <class Field>
struct RayFields
{
  Field extinction; ///< [1/length]
  Field importance; ///< [0, 1]
  Field base;       ///< base extinction [1/length]
};

/**
 * A short piece of a ray in which extinction mu and importance g are linear
 * (Documentation/Method.md, quadrature); what Eqs. (19) and (20) integrate. With the optical depth
 * x of the piece and the mean transmittance m = (1 - e^-x) / x,
 *
 *   integral of g mu T dt = g0 (1 - m) + g1 (m - e^-x) + (g1 - g0) tilt m,
 *
 * T = 1 at its front. The first two terms are exact where mu is constant; the third one,
 * tilt = (mu1 - mu0) length / 12, makes the sum exact for thin pieces.
 */
struct RayPiece
{
  float place;        ///< its middle, as a share of the layer's thickness
  float size;         ///< its length, likewise
  float opticalDepth; ///< x [1]
  float tilt;         ///< [1]
  float front;        ///< importance at the front times scale^2
  float back;         ///< ... at the back
  float keptShare;    ///< share of the extinction that is kept of the base [0, 1]
  float keptTilt;     ///< tilt of what is kept [1]

  LIMPID_HD LIMPID_INLINE float Passed() const { return Attenuate(this->opticalDepth); }

  LIMPID_HD LIMPID_INLINE float Visible() const { return this->Shown(1.0f, this->tilt); }

  /// Visible, of what is kept of the base extinction.
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
  static constexpr float series = 0.1f; ///< below this x, power series; exact to rounding

  /// What shows of a share of the matter, which is tilted as told.
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

/// Optical depth behind which nothing matters any more: T = 1e-7.
constexpr float darkDepth = 16.0f;

/// Which layers are resolved for their depth, and how: as sweeps do. Two constant halves are off by
/// 0.1 % of the visible importance at `thick`, and by three times as much at twice the depth.
struct UsualCuts
{
  static constexpr float thick = 0.5f;   ///< optical depth from which on a layer is resolved
  static constexpr float finer = 1;      ///< it is cut as if it were so many times as deep
  static constexpr bool atFaces = false; ///< whether it is cut at the faces of cells, too
};

/// As scores do. Within a layer a ray may cross two faces of cells, where fields have kinks. One
/// pair of Gauss points does not see them, and misses the skin of what is opaque: scores of real
/// data are off by 0.2 to 0.4 % then, those of an opaque block on edge by 10 %.
struct FineCuts
{
  static constexpr float thick = 0.25f;
  static constexpr float finer = 4;
  static constexpr bool atFaces = true;
};

/// The larger extinction of the two Gauss points [1/length].
template <Passage passage>
LIMPID_HD LIMPID_INLINE float DensestOf(const RayInLayer<passage>& ray)
{
  return ray.extinction[0] > ray.extinction[1] ? ray.extinction[0] : ray.extinction[1];
}

/// The most that is sampled of a ray in a layer.
struct MostInLayer
{
  float extinction; ///< [1/length]
  float importance; ///< [0, 1]
};

/// At the Gauss points, and with FineCuts at the ends of the layer. `sampler`: what samples fields
/// along the ray, which is in `column`.
template <class Cuts, class Sampler, Passage passage>
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
 * Which layers with anything important a sweep resolves, beside those where a ray enters or leaves
 * the box: here none. Where nothing is important, two halves are exact.
 *
 * `Reaches`: whether a ray is asked at all. `Densest` is the extinction by which a layer is cut
 * into parts, from the most that is sampled [1/length]. `LeastOnWay` is a sampled extinction below
 * which no layer of a row is resolved; `way`: the longest way of its rays through the layer
 * [length].
 */
struct ResolveSides
{
  using Cuts = UsualCuts;

  LIMPID_HD LIMPID_INLINE bool Reaches(Index) const { return false; }
  LIMPID_HD LIMPID_INLINE float Densest(float sampled) const { return sampled; }
  LIMPID_HD LIMPID_INLINE float LeastOnWay(float) const { return 1e30f; }
};

/// Resolves thick layers as far as light comes.
template <class TheCuts = UsualCuts>
struct ResolveLit
{
  using Cuts = TheCuts;

  const double* opticalDepths; ///< of the rays at the front of the layer

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

constexpr int mostPartsOfLayer = 16; ///< of a layer, each with Gauss points of its own
constexpr int piecesOfPart = 4;      ///< of equal length

/// The parts that a layer of optical depth `depth` is cut into.
LIMPID_HD LIMPID_INLINE int PartsOfLayer(float depth)
{
  return depth <= 1.0f ? 1
    : depth <= 4.0f    ? 2
    : depth <= 16.0f   ? 4
    : depth <= 64.0f   ? 8
                       : mostPartsOfLayer;
}

/// What extinction at the ends of a layer does to what a ray sees, see EffectStep; T = 1 in front.
struct LayerEffect
{
  float front;
  float back;
};

/// A ray's way through a layer, resolved into pieces. `Sampler`: what samples fields along it.
template <class Sampler, class Cuts>
struct ResolvedRay
{
  const Sampler& sampler;
  RayFields<typename Sampler::Field> fields;
  RayInLayer<Passage::Clipped> plain; ///< the same in two halves
  int column;                         ///< of the ray
  float sampled;                      ///< the most that is sampled of the extinction [1/length]
  float densest;                      ///< extinction by which the layer is cut [1/length]

  /// Where it is inside the box, as shares of the layer's thickness.
  LIMPID_HD LIMPID_INLINE Range<float> Inside() const
  {
    return ClippedRange(this->plain.layer, { 0.0f, 1.0f }, this->plain.column, this->plain.row);
  }

  /// Calls visit(piece) front to back for what is inside the box, as long as it returns true.
  template <class Visit>
  LIMPID_HD LIMPID_INLINE void ForPieces(const Visit& visit) const
  {
    this->ForPiecesInOrder([](int number, int) { return number; }, visit);
  }

  /// ForPieces, back to front.
  template <class Visit>
  LIMPID_HD LIMPID_INLINE void ForPiecesBackward(const Visit& visit) const
  {
    this->ForPiecesInOrder([](int number, int count) { return count - 1 - number; }, visit);
  }

  /// World length of a piece [length].
  LIMPID_HD LIMPID_INLINE float LengthOf(const RayPiece& piece) const
  {
    return piece.size * (this->plain.layer.thickness * this->plain.length);
  }

  /// The integral of g mu dt of the pieces, from their sum. Unless faces are crossed, two halves
  /// are exact where the whole layer is inside the box.
  LIMPID_HD LIMPID_INLINE float Unattenuated(float ofPieces) const
  {
    return !Cuts::atFaces && this->IsWhole() ? this->plain.Light().unattenuated : ofPieces;
  }

  /// What the layer does to light inside the box.
  LIMPID_HD LIMPID_INLINE LayerLight Light() const
  {
    LayerLight light{};
    this->AddPieces(light, [](const RayPiece&, float) {});
    return light;
  }

  /// Light, and its effect. `behind`: visible importance at the back of what is inside the box.
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
    seen += light.visible; // from a piece on
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
  static constexpr float nothing = 1e-5f; ///< transmittance behind which pieces do not matter

  /// Whether the ray is inside the box all through the layer.
  LIMPID_HD LIMPID_INLINE bool IsWhole() const
  {
    const Range<float> inside = this->Inside();
    return inside.begin <= 0.0f && inside.end >= 1.0f;
  }

  /// The stretches between the faces of cells that the ray crosses inside the box.
  struct Stretches
  {
    float ends[4];
    int count;

    /// Ends a stretch at a share of the layer, if it lies between the last one and `last`.
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

  /// Calls visit(piece) for what is inside the box, as long as it returns true. `order(number,
  /// count)`: which of `count` comes at a number.
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

  /// ForPiecesInOrder in a stretch. Returns whether all of its pieces were visited.
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

  /// Adds what all pieces do to light, and calls visit(piece, transmittance in front of it).
  /// Returns what passes them.
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
    if (!(transmittance > nothing) || this->IsWhole()) // pieces end where light does
    {
      light.unattenuated = halves.unattenuated;
      light.keptUnattenuated = halves.keptUnattenuated;
    }
    return transmittance;
  }

  /// A piece between two shares of a part; `first`, `second`: samples at the part's Gauss points.
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

  /// The mean of scale^2 over a piece.
  LIMPID_HD LIMPID_INLINE float AreaAt(float place, float size) const
  {
    const Layer& layer = this->plain.layer;
    const float widening = layer.backScale - layer.frontScale;
    const float scale = layer.frontScale + place * widening;
    return scale * scale + (1.0f / 12) * (size * widening) * (size * widening);
  }
};

/// Hands a ray to step(ray, i): as a ResolvedRay where its layer is resolved (ResolveSides), else
/// by plain(i). `i`: of its states; `column`: of the ray.
template <class Sampler, class Resolve, class Step, class Plain>
LIMPID_HD LIMPID_INLINE void StepResolved(const RayInLayer<Passage::Clipped>& ray,
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
