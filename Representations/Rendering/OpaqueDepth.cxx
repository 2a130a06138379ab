// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#include "OpaqueDepth.h"

#include "vtkNew.h"
#include "vtkRenderWindow.h"
#include "vtkRenderer.h"
#include "vtkUnsignedCharArray.h"

#include "distributed/Communicator.h"
#include "math/Require.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <limits>

namespace limpid
{
OpaqueDepth::OpaqueDepth(vtkRenderer* renderer, const ViewGeometry& geometry)
  : Target(renderer)
  , Geometry(geometry)
  , Covered{ { geometry.covered[1] - geometry.covered[0],
      geometry.covered[3] - geometry.covered[2] } }
{
  if (renderer->GetNumberOfPropsRendered() == 0)
  {
    return;
  }
  const int columns = this->Covered[0];
  const int rows = this->Covered[1];
  this->Values.assign(std::size_t(columns) * std::size_t(rows), 1.0F);
  const int left = geometry.origin[0] + geometry.covered[0];
  const int bottom = geometry.origin[1] + geometry.covered[2];
  LIMPID_REQUIRE(renderer->GetRenderWindow()->GetZbufferData(
                   left, bottom, left + columns - 1, bottom + rows - 1, this->Values.data()) != 0,
    "The depth buffer of " << columns << " x " << rows
                           << " pixels cannot be read (the volume would be drawn over opaque "
                              "geometry). Use a render window with a depth buffer.");
}

void OpaqueDepth::TakeNearestOf(const Communicator& ranks)
{
  const auto isDrawn = [](float depth) { return depth < 1; };
  if (!ranks.AnyOf(std::any_of(this->Values.begin(), this->Values.end(), isDrawn)))
  {
    this->Values.clear(); // no ray ends at geometry
    return;
  }
  const std::size_t count = std::size_t(this->Covered[0]) * std::size_t(this->Covered[1]);
  this->Values.resize(count, 1.0F);
  this->Colors.resize(count);
  const int left = this->Geometry.origin[0] + this->Geometry.covered[0];
  const int bottom = this->Geometry.origin[1] + this->Geometry.covered[2];
  vtkNew<vtkUnsignedCharArray> drawn;
  const int read = this->Target->GetRenderWindow()->GetRGBACharPixelData(
    left, bottom, left + this->Covered[0] - 1, bottom + this->Covered[1] - 1, 0, drawn);
  LIMPID_REQUIRE(read != 0 && drawn->GetNumberOfValues() == vtkIdType(4 * count),
    "The colors of " << this->Covered[0] << " x " << this->Covered[1]
                     << " pixels cannot be read (opaque geometry would shine through the volume). "
                        "Use a render window with a color buffer.");
  std::memcpy(this->Colors.data(), drawn->GetPointer(0), 4 * count);
  // Depths are at least zero, so they are ordered like their bits.
  std::vector<std::int32_t> here(count);
  std::memcpy(here.data(), this->Values.data(), count * sizeof(float));
  std::vector<std::int32_t> nearest = here;
  ranks.TakeLeast(nearest.data(), count);
  std::memcpy(this->Values.data(), nearest.data(), count * sizeof(float));
  // Where several ranks are equally near, all take one colour, the least.
  std::vector<std::int32_t> colors(count, std::numeric_limits<std::int32_t>::max());
  for (std::size_t pixel = 0; pixel < count; ++pixel)
  {
    const std::array<std::uint8_t, 4>& color = this->Colors[pixel];
    if (here[pixel] == nearest[pixel])
    {
      colors[pixel] = color[0] << 16 | color[1] << 8 | color[2];
    }
  }
  ranks.TakeLeast(colors.data(), count);
  for (std::size_t pixel = 0; pixel < count; ++pixel)
  {
    const auto channel = [&](int shift)
    { return static_cast<std::uint8_t>(colors[pixel] >> shift & 255); };
    this->Colors[pixel] = { { channel(16), channel(8), channel(0), 255 } };
  }
}

const std::uint8_t* OpaqueDepth::ColorAt(const PictureFrame& frame, int column, int row) const
{
  const int x = frame.origin[0] + column - this->Geometry.covered[0];
  const int y = frame.origin[1] + row - this->Geometry.covered[2];
  const bool isThere = !this->Values.empty() && frame.whole == this->Geometry.size && x >= 0 &&
    y >= 0 && x < this->Covered[0] && y < this->Covered[1];
  const auto pixel = std::size_t(y) * std::size_t(this->Covered[0]) + std::size_t(x);
  return isThere && this->Values[pixel] < 1 ? this->Colors[pixel].data() : nullptr;
}

std::vector<float> OpaqueDepth::InMiddles(const PictureFrame& frame) const
{
  return ValuesOf(this->Geometry, frame,
    [this](int column, int row)
    {
      const int at =
        (row - this->Geometry.covered[2]) * this->Covered[0] + column - this->Geometry.covered[0];
      return ToClip(this->Values[std::size_t(at)]);
    });
}

std::optional<OpaqueGeometry> OpaqueDepth::InBox() const
{
  const auto farthest = static_cast<float>(this->Geometry.farthest);
  const bool hides = std::any_of(
    this->Values.begin(), this->Values.end(), [farthest](float depth) { return depth < farthest; });
  if (!hides)
  {
    return std::nullopt;
  }
  const PictureFrame frame = FrameOf(this->Geometry, 1);
  OpaqueGeometry opaque{ frame.size[0], frame.size[1], ClipToData(this->Geometry, frame),
    this->InMiddles(frame) };
  for (float& depth : opaque.depth)
  {
    depth = depth < ToClip(farthest) ? depth : 1.0F; // geometry behind the box hides nothing
  }
  return opaque;
}

// Returns the pixels of the view along an axis, counted within what the box covers, that are less
// than a pixel of the frame away from the centre of one.
OpaqueDepth::Pixels OpaqueDepth::FedBy(const PictureFrame& frame, std::size_t axis, int pixel) const
{
  const double size = double(this->Geometry.size[axis]) / frame.whole[axis];
  const double middle = (frame.origin[axis] + pixel + 0.5) * size - 0.5;
  const int begin = this->Geometry.covered[2 * axis];
  const int first = static_cast<int>(std::floor(middle - size)) + 1 - begin;
  const int end = static_cast<int>(std::ceil(middle + size)) - begin;
  const int last = this->Covered[axis] - 1;
  return { std::clamp(first, 0, last), std::clamp(end - 1, 0, last) + 1 };
}

std::vector<OpaqueDepth::Pixels> OpaqueDepth::ColumnsFedBy(const PictureFrame& frame) const
{
  std::vector<Pixels> columns;
  columns.reserve(std::size_t(frame.size[0]));
  for (int column = 0; column < frame.size[0]; ++column)
  {
    columns.push_back(this->FedBy(frame, 0, column));
  }
  return columns;
}

// Returns the range of depths for each row of the view and each pixel of a frame's row.
std::vector<DepthRange> OpaqueDepth::AlongRows(const std::vector<Pixels>& columns) const
{
  // In front of the box and behind it, depths do not matter.
  const auto nearest = static_cast<float>(this->Geometry.nearest);
  const auto farthest = static_cast<float>(this->Geometry.farthest);
  std::vector<DepthRange> ranges;
  ranges.reserve(columns.size() * std::size_t(this->Covered[1]));
  for (int row = 0; row < this->Covered[1]; ++row)
  {
    const float* values = this->Values.data() + std::size_t(row) * std::size_t(this->Covered[0]);
    for (const Pixels& fed : columns)
    {
      DepthRange range{ farthest, nearest, 0 };
      for (int column = fed.first; column < fed.end; ++column)
      {
        const float depth = std::clamp(values[column], nearest, farthest);
        range = { std::min(range.nearest, depth), std::max(range.farthest, depth), 0 };
      }
      ranges.push_back(range);
    }
  }
  return ranges;
}

// Returns the depth in front of the gap if depths have a gap wider than half of the range, in which
// there is nothing; else the nearest depth.
float OpaqueDepth::TurnOf(const DepthRange& range, const Pixels& columns, const Pixels& rows) const
{
  const float middle = 0.5F * (range.nearest + range.farthest);
  float before = range.nearest;
  float behind = range.farthest;
  for (int row = rows.first; row < rows.end; ++row)
  {
    const float* values = this->Values.data() + std::size_t(row) * std::size_t(this->Covered[0]);
    for (int column = columns.first; column < columns.end; ++column)
    {
      const float depth = std::clamp(values[column], range.nearest, range.farthest);
      before = depth <= middle ? std::max(before, depth) : before;
      behind = depth > middle ? std::min(behind, depth) : behind;
    }
  }
  const bool apart = behind - before > 0.5F * (range.farthest - range.nearest);
  return apart ? before : range.nearest;
}

std::vector<DepthRange> OpaqueDepth::RangesOf(const PictureFrame& frame) const
{
  const std::vector<Pixels> columns = this->ColumnsFedBy(frame);
  const std::vector<DepthRange> along = this->AlongRows(columns);
  const auto width = std::size_t(frame.size[0]);
  std::vector<DepthRange> ranges;
  ranges.reserve(width * std::size_t(frame.size[1]));
  for (int row = 0; row < frame.size[1]; ++row)
  {
    const Pixels fed = this->FedBy(frame, 1, row);
    for (std::size_t column = 0; column < width; ++column)
    {
      DepthRange range = along[std::size_t(fed.first) * width + column];
      for (int from = fed.first + 1; from < fed.end; ++from)
      {
        const DepthRange& other = along[std::size_t(from) * width + column];
        range = { std::min(range.nearest, other.nearest), std::max(range.farthest, other.farthest),
          0 };
      }
      range.turns =
        range.nearest < range.farthest ? this->TurnOf(range, columns[column], fed) : range.nearest;
      ranges.push_back(range);
    }
  }
  const bool differ = std::any_of(ranges.begin(), ranges.end(),
    [](const DepthRange& range) { return range.nearest < range.farthest; });
  return differ ? ranges : std::vector<DepthRange>();
}
}
