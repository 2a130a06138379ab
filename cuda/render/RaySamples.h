// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef limpid_render_RaySamples_h
#define limpid_render_RaySamples_h

#include "render/RayPlaces.h"
#include "render/Segment.h"
#include "render/SingleSampler.h"
#include "render/StructureTint.h"

namespace limpid
{
/// A quantity at both ends of successive segments.
template <class AnySampler>
struct Ends
{
  using Lanes = typename AnySampler::Lanes;

  Lanes front = 0;
  Lanes rear = 0;

  /// Advances to the next samples.
  LIMPID_HD LIMPID_INLINE void MoveOn(const Lanes& samples)
  {
    this->front = AnySampler::Shifted(this->rear, samples);
    this->rear = samples;
  }

  LIMPID_HD LIMPID_INLINE Lanes Sum() const { return this->front + this->rear; }
  LIMPID_HD LIMPID_INLINE Lanes Difference() const { return this->rear - this->front; }
};

/// What the colours of a ray depend on beside the transfer functions. Constants, where a ray is
/// compiled for each case.
struct RayLook
{
  bool lit;    ///< whether there is scene.gradient
  bool tinted; ///< whether there are scene.structures
};

/**
 * Consecutive samples of a ray and the segments in front of them: values of the fields, lighting,
 * and contributions to a pixel. Segment i ends at sample i. A run of samples begins with a segment
 * of length zero, whose other values are undefined.
 *
 * The number of samples is that of AnySampler. `Overlaid`: whether there is scene.overlay.
 */
template <class AnySampler, bool Overlaid>
struct RaySamples
{
  using Lanes = typename AnySampler::Lanes;
  using Optical = typename AnySampler::Optical;
  static constexpr int count = AnySampler::count;

  RayPlaces<AnySampler> place;
  Ends<AnySampler> distance;             ///< from the entry [samples]
  Ends<AnySampler> position;             ///< in the table
  Ends<AnySampler> value;                ///< extinction of the transfer function [majorant]
  Ends<AnySampler> integral;             ///< see OpticalTable
  Ends<AnySampler> filled{ 1.0f, 1.0f }; ///< 1; less beside empty nodes
  Ends<AnySampler> kept;                 ///< share of that extinction [packedOne], if Overlaid
  Ends<AnySampler> added;                ///< extinction [packedOne of scene.addedUnit]
  Ends<AnySampler> scattered;            ///< see LightOnRay
  Ends<AnySampler> arriving;             ///< light, see ArrivingNode [packedOne]
  typename AnySampler::Optics optics;

  SegmentMean<Lanes> mean;
  Lanes extinction = 0; ///< of the segments [majorant]

  int last = -1;           ///< number of the last sample
  bool begins = false;     ///< whether a run begins here
  bool lastFilled = false; ///< whether the brick of the last sample may be non-empty

  /// Advances to the samples behind number `k` if that is the last one; otherwise, a run begins
  /// with `k`.
  LIMPID_HD LIMPID_INLINE void MoveOn(const RayScene& scene, const Ray& ray, int k)
  {
    this->begins = this->last != k;
    const int first = this->begins ? k : k + 1;
    this->last = first + count - 1;
    this->place.Set(scene, ray, first);
    this->lastFilled = scene.bricks.distance && this->LastIsFilled(scene.bricks);
    if (this->begins)
    {
      this->distance.rear = AnySampler::First(this->place.distance);
    }
    this->distance.MoveOn(this->place.distance);
    const Lanes scalars =
      AnySampler::InterpolateAll(scene.grid, scene.scalars, this->place.scalars);
    const Lanes positions = scene.table.axis.Position(scalars);
    this->position.MoveOn(positions);
    this->optics.Read(scene.table, positions);
    Lanes values;
    Lanes integrals;
    this->optics.Extinction(values, integrals);
    this->value.MoveOn(values);
    this->integral.MoveOn(integrals);
    if (scene.filled)
    {
      this->filled.MoveOn(
        AnySampler::InterpolateAll(scene.grid, scene.filled, this->place.scalars));
    }
    if (Overlaid)
    {
      CellPlaces<AnySampler> apart;
      Lanes overlay[2];
      AnySampler::InterpolateAll(
        scene.overlayGrid, scene.overlay, this->place.InOverlay(scene, ray, apart), overlay);
      this->kept.MoveOn(overlay[0]);
      this->added.MoveOn(overlay[1]);
    }
  }

  /// Computes extinction and colour of the segments, including changes by the optimisation and
  /// empty nodes. Returns whether any of them absorbs light.
  LIMPID_HD LIMPID_INLINE bool Classify(const RayScene& scene)
  {
    this->mean = SegmentMean<Lanes>(
      this->position.Difference(), this->integral.Difference(), this->value.Sum());
    const SegmentEnds<Lanes> ends{ this->filled.Sum(),
      Overlaid ? this->kept.Sum() : Lanes(2 * packedOne),
      Overlaid ? this->added.Sum() : Lanes(0.0f) };
    this->extinction = ends.Extinction(this->mean.extinction, scene.addedUnit);
    return AnyOf(this->Depth(scene) > 0.0f);
  }

  /// Computes the light that the samples send, see LightOnRay.
  LIMPID_HD LIMPID_INLINE void Light(const RayScene& scene, const Ray& ray)
  {
    const LightOnRay onRay(scene.light, ray);
    const int before = this->last - count;
    if (!this->begins && this->LitTo != before)
    {
      RayPlaces<SingleSampler> there;
      there.Set(scene, ray, before);
      float ofGradient[4];
      GradientAt(scene, ray, there, ofGradient);
      this->scattered.rear = Scattered(scene.light, onRay.DirectionAt(scene.light, there.distance),
        ofGradient[0], ofGradient[1], ofGradient[2]);
      this->arriving.rear = ofGradient[3];
    }
    Lanes ofGradient[4];
    GradientAt(scene, ray, this->place, ofGradient);
    this->scattered.MoveOn(this->ScatteredAt(scene.light, onRay, ofGradient));
    this->arriving.MoveOn(ofGradient[3]);
    this->LitTo = this->last;
  }

  /// Returns the share of their colour that the segments send to the viewer as a whole, from their
  /// midpoints.
  LIMPID_HD LIMPID_INLINE Lanes SentOnAverage(const RayScene& scene) const
  {
    return scene.light.Sent(0.5f * this->scattered.Sum(), 0.5f * this->arriving.Sum());
  }

  /// Returns the optical depths of the segments.
  LIMPID_HD LIMPID_INLINE Lanes Depth(const RayScene& scene) const
  {
    const float lengthUnit = scene.stepLength * scene.majorant;
    return this->extinction * lengthUnit * this->distance.Difference();
  }

  /// Returns the optical depths with the transfer function's extinction.
  LIMPID_HD LIMPID_INLINE Lanes BaseDepth(const RayScene& scene) const
  {
    const float lengthUnit = scene.stepLength * scene.majorant;
    const Lanes base = this->mean.extinction * (0.5f * this->filled.Sum());
    return base * lengthUnit * this->distance.Difference();
  }

  /// Calls add(i, color) for all segments, with colorOf(i), tinted by the structure in which the
  /// segment lies. factorOf(i): the multiple of the transfer function's colour that colorOf
  /// returns.
  template <class ColorOf, class FactorOf, class Add>
  LIMPID_HD LIMPID_INLINE void ForColors(const RayScene& scene, const Ray& ray, bool tinted,
    const ColorOf& colorOf, const FactorOf& factorOf, const Add& add) const
  {
    if (!tinted)
    {
      LIMPID_UNROLL(16)
      for (int i = 0; i < count; ++i)
      {
        add(i, colorOf(i));
      }
      return;
    }
    const SegmentTints<AnySampler> tints(scene, ray, 0.5f * this->distance.Sum());
    LIMPID_UNROLL(16)
    for (int i = 0; i < count; ++i)
    {
      add(i, tints.Over(i, factorOf(i), colorOf(i)));
    }
  }

  /// Adds the segments to a pixel, front to back: the sum of Eq. (6). A segment scatters extinction
  /// times colour, Eq. (3).
  LIMPID_HD LIMPID_INLINE void AddTo(
    const RayScene& scene, const Ray& ray, const RayLook& look, Pixel<Optical>& pixel) const
  {
    const Segment<Lanes> segment(this->Depth(scene));
    const Lanes sent = look.lit ? segment.absorbed *
        scene.light.Sent(segment.Mean(this->scattered.front, this->scattered.rear),
          segment.Mean(this->arriving.front, this->arriving.rear))
                                : segment.absorbed;
    const Lanes inFront =
      AnySampler::InFront(segment.passed, scene.opaqueBelow, pixel.transmittance);
    const Lanes given = sent * Select(inFront > scene.opaqueBelow, inFront, 0.0f);
    const Lanes ofValues = given * this->mean.ofValues;
    const Lanes ofIntegrals = given * this->mean.ofIntegrals;
    Optical sum = pixel.light;
    this->ForColors(
      scene, ray, look.tinted,
      [&](int i) LIMPID_INLINE_LAMBDA
      { return this->optics.Color(i, LaneOf(ofValues, i), LaneOf(ofIntegrals, i)); },
      [&](int i) LIMPID_INLINE_LAMBDA { return LaneOf(given, i); },
      [&](int, const Optical& color) LIMPID_INLINE_LAMBDA { sum = sum + color; });
    pixel.light = sum;
  }

  /// Returns the colour of a segment, without its extinction.
  LIMPID_HD LIMPID_INLINE Optical Color(int i) const
  {
    return this->optics.Color(i, LaneOf(this->mean.ofValues, i), LaneOf(this->mean.ofIntegrals, i));
  }

private:
  LIMPID_HD LIMPID_INLINE bool LastIsFilled(const BrickDistances& bricks) const
  {
    int brick[3];
    for (int axis = 0; axis < 3; ++axis)
    {
      brick[axis] = BrickDistances::BrickOf(AnySampler::Last(this->place.scalars.before[axis]));
    }
    return bricks.EmptyAround(brick) == 0;
  }

  /// Reads the gradient at samples, with the light that arrives.
  template <class Sampler>
  LIMPID_HD static LIMPID_INLINE void GradientAt(const RayScene& scene, const Ray& ray,
    const RayPlaces<Sampler>& place, typename Sampler::Lanes (&gradient)[4])
  {
    Sampler::InterpolateAll(scene.grid, scene.gradient, place.scalars, gradient);
    if (scene.shadow)
    {
      CellPlaces<Sampler> apart;
      gradient[3] = Sampler::InterpolateAll(
        scene.overlayGrid, scene.shadow, place.InOverlay(scene, ray, apart));
    }
  }

  /// Returns the light that the samples scatter to the viewer. The direction of a light without a
  /// position is computed once per ray; a device computes it again rather than keep it in
  /// registers.
  LIMPID_HD LIMPID_INLINE Lanes ScatteredAt(
    const RayLight& light, const LightOnRay& onRay, const Lanes (&gradient)[4])
  {
    if (count == 1 || light.isPoint != 0)
    {
      return Scattered(light, onRay.DirectionAt(light, this->place.distance), gradient[0],
        gradient[1], gradient[2]);
    }
    if (this->LitTo < 0)
    {
      this->Direction = onRay.DirectionAt(light, this->place.distance);
    }
    return Scattered(light, this->Direction, gradient[0], gradient[1], gradient[2]);
  }

  int LitTo = -1;                  ///< number of the last sample that was lit
  LightDirection<Lanes> Direction; ///< of a light without a position
};
}

#endif
