// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

// What the processor does to sixteen samples at a time gives each the bits that it has alone.

#include "math/Exp.h"
#include "render/BlockSampler.h"

#include <gtest/gtest.h>

#include <cstdint>
#include <limits>
#include <random>
#include <vector>

using namespace limpid;

namespace
{
constexpr int count = FloatLanes::count;

/// Numbers of all signs and magnitudes from 1e-3 to 1e3, and zero.
struct Numbers
{
  float values[count];

  explicit Numbers(unsigned int seed)
  {
    std::mt19937 random(seed);
    std::uniform_real_distribution<float> exponent(-3, 3);
    for (int i = 0; i < count; ++i)
    {
      const float size = std::pow(10.0f, exponent(random));
      this->values[i] = i == 5 ? 0.0f : (random() % 2 ? size : -size);
    }
  }
};

/// The number in a lane is what `alone` makes of the number there.
template <class Alone>
void ExpectEach(const FloatLanes& lanes, const Alone& alone)
{
  for (int i = 0; i < count; ++i)
  {
    EXPECT_EQ(LaneOf(lanes, i), alone(i)) << "lane " << i;
  }
}

/// A field of 6 x 5 x 7 nodes, and places in it and around it.
struct Field
{
  CellGrid grid{ Int3(6, 5, 7) };
  std::vector<float> numbers;
  std::vector<FourPacked> fours;
  std::vector<TwoPacked> twos;
  float positions[3][count];

  Field()
  {
    std::mt19937 random(3);
    std::uniform_real_distribution<float> share(-1, 1);
    for (int node = 0; node < 6 * 5 * 7; ++node)
    {
      this->numbers.push_back(share(random));
      FourPacked four;
      for (std::int16_t& value : four.values)
      {
        value = std::int16_t(packedOne * share(random));
      }
      this->fours.push_back(four);
      this->twos.push_back({ { four.values[1], four.values[2] } });
    }
    for (auto& axis : this->positions)
    {
      for (float& position : axis)
      {
        position = 3.0f + 4.0f * share(random);
      }
    }
  }

  void PlaceAll(CellPlaces<BlockSampler>& place) const
  {
    const FloatLanes at[3] = { FloatLanes::Load(this->positions[0]),
      FloatLanes::Load(this->positions[1]), FloatLanes::Load(this->positions[2]) };
    place.Set(this->grid, at);
  }

  CellPlace Place(int i) const
  {
    const float at[3] = { this->positions[0][i], this->positions[1][i], this->positions[2][i] };
    return { this->grid, at };
  }
};

template <int Count>
void ExpectInterpolatedAsAlone(const Field& field, const std::vector<Packed<Count>>& packed,
  const CellPlaces<BlockSampler>& places)
{
  FloatLanes all[Count];
  BlockSampler::InterpolateAll(field.grid, packed.data(), places, all);
  for (int number = 0; number < Count; ++number)
  {
    ExpectEach(all[number],
      [&](int i)
      {
        float alone[Count];
        SingleSampler::InterpolateAll(field.grid, packed.data(), field.Place(i), alone);
        return alone[number];
      });
  }
}

/// Transfer functions with a step and a colour that changes everywhere.
Classification MakeClassification()
{
  TransferFunctions functions;
  functions.low = -1;
  functions.high = 1;
  for (int i = 0; i <= 64; ++i)
  {
    const float share = float(i) / 64;
    functions.extinction.push_back(i < 20 ? 0.0f : 3.0f * share);
    functions.color.push_back({ { share, 1 - share, share * share } });
  }
  return Classification(functions);
}
}

TEST(BlockSampler, CalculatesAsWithOneNumber)
{
  const Numbers a(1);
  const Numbers b(2);
  const FloatLanes x = FloatLanes::Load(a.values);
  const FloatLanes y = FloatLanes::Load(b.values);
  ExpectEach(x + y, [&](int i) { return a.values[i] + b.values[i]; });
  ExpectEach(x - y, [&](int i) { return a.values[i] - b.values[i]; });
  ExpectEach(x * y, [&](int i) { return a.values[i] * b.values[i]; });
  ExpectEach(2.0f / (y + 1e4f), [&](int i) { return 2.0f / (b.values[i] + 1e4f); });
  ExpectEach(-x, [&](int i) { return -a.values[i]; });
  ExpectEach(Select(x < y, x, y),
    [&](int i) { return a.values[i] < b.values[i] ? a.values[i] : b.values[i]; });
  ExpectEach(Magnitude(x), [&](int i) { return std::abs(a.values[i]); });
  ExpectEach(SquareRoot(Magnitude(x)), [&](int i) { return std::sqrt(std::abs(a.values[i])); });
  ExpectEach(ToFloat(Truncate(x)), [&](int i) { return float(int(a.values[i])); });
  ExpectEach(Attenuate(Magnitude(x)), [&](int i) { return Attenuate(std::abs(a.values[i])); });
  ExpectEach(Logarithm(Magnitude(x) + 1e-6f),
    [&](int i) { return Logarithm(std::abs(a.values[i]) + 1e-6f); });
}

TEST(BlockSampler, KnowsWhetherAnythingHoldsAnywhere)
{
  for (int lane = 0; lane < count; ++lane)
  {
    float numbers[count] = {};
    EXPECT_FALSE(AnyOf(FloatLanes::Load(numbers) > 0.0f));
    numbers[lane] = 1e-30f;
    EXPECT_TRUE(AnyOf(FloatLanes::Load(numbers) > 0.0f)) << "lane " << lane;
  }
}

TEST(BlockSampler, InterpolatesAsSingleSampler)
{
  const Field field;
  CellPlaces<BlockSampler> places;
  field.PlaceAll(places);
  ExpectEach(BlockSampler::InterpolateAll(field.grid, field.numbers.data(), places),
    [&](int i)
    { return SingleSampler::InterpolateAll(field.grid, field.numbers.data(), field.Place(i)); });
  ExpectInterpolatedAsAlone(field, field.fours, places);
  ExpectInterpolatedAsAlone(field, field.twos, places);
}

namespace
{
/// Scalars of all sizes among 6 x 5 x 7 nodes are interpolated as the same floats. The array ends
/// with the last node, so that sanitizers see what is read beyond it.
template <class Integer>
void ExpectInterpolatedAsFloats()
{
  const Field field;
  std::mt19937 random(7);
  std::vector<Integer> integers{ std::numeric_limits<Integer>::max(),
    std::numeric_limits<Integer>::min() };
  while (integers.size() < field.numbers.size())
  {
    integers.push_back(Integer(random()));
  }
  const std::vector<float> floats(integers.begin(), integers.end());
  CellPlaces<BlockSampler> places;
  field.PlaceAll(places);
  const ScalarNodes nodes(integers.data());
  const FloatLanes all = BlockSampler::InterpolateAll(field.grid, nodes, places);
  ExpectEach(all,
    [&](int i)
    { return SingleSampler::InterpolateAll(field.grid, floats.data(), field.Place(i)); });
  for (std::size_t node = 0; node < floats.size(); ++node)
  {
    EXPECT_EQ(nodes.At(Index(node)), floats[node]);
  }
  EXPECT_EQ(nodes.From(3).At(1), floats[4]);
  EXPECT_EQ(FloatsOf(nodes, Index(floats.size())), floats);
}
}

TEST(BlockSampler, InterpolatesIntegersAsTheSameFloats)
{
  ExpectInterpolatedAsFloats<std::int8_t>();
  ExpectInterpolatedAsFloats<std::uint8_t>();
  ExpectInterpolatedAsFloats<std::int16_t>();
  ExpectInterpolatedAsFloats<std::uint16_t>();
}

TEST(BlockSampler, LooksUpAsSingleSamplerInsideTheTableAndOutside)
{
  const Classification functions = MakeClassification();
  const OpticalTable table = functions.Table();
  const Field field;
  SingleOptics alone;
  BlockOptics block;
  for (const auto& axis : field.positions) // from below the table to above
  {
    const FloatLanes positions = FloatLanes::Load(axis) * 300.0f - 200.0f;
    block.Read(table, positions);
    FloatLanes values;
    FloatLanes integrals;
    block.Extinction(values, integrals);
    for (int i = 0; i < count; ++i)
    {
      alone.Read(table, LaneOf(positions, i));
      float value;
      float integral;
      alone.Extinction(value, integral);
      EXPECT_EQ(LaneOf(values, i), value);
      EXPECT_EQ(LaneOf(integrals, i), integral);
      const BlockOptics::Optical color = block.Color(i, 0.7f, 0.3f);
      const FourFloats expected = alone.Color(0, 0.7f, 0.3f);
      for (int channel = 0; channel < 4; ++channel)
      {
        EXPECT_EQ(color[channel], expected[channel]);
      }
    }
  }
}

TEST(BlockSampler, PassesLightSegmentBySegmentUntilItIsOpaque)
{
  float passed[count];
  for (int i = 0; i < count; ++i)
  {
    passed[i] = 0.9f - 0.01f * float(i);
  }
  for (const float opaqueBelow : { 0.0f, 0.3f, 0.8f, 0.95f })
  {
    float block = 0.99f;
    const FloatLanes inFront = BlockSampler::InFront(FloatLanes::Load(passed), opaqueBelow, block);
    float alone = 0.99f;
    for (int i = 0; i < count; ++i)
    {
      if (alone > opaqueBelow)
      {
        EXPECT_EQ(LaneOf(inFront, i), SingleSampler::InFront(passed[i], opaqueBelow, alone));
      }
    }
    EXPECT_EQ(block, alone) << "opaque below " << opaqueBelow;
  }
}

TEST(BlockSampler, ShiftsByOneSample)
{
  const Numbers before(4);
  const Numbers here(5);
  ExpectEach(BlockSampler::Shifted(FloatLanes::Load(before.values), FloatLanes::Load(here.values)),
    [&](int i) { return i > 0 ? here.values[i - 1] : before.values[count - 1]; });
}
