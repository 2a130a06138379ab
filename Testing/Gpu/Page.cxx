// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#include "Page.h"

#include "Markdown.h"

#include <algorithm>
#include <array>
#include <functional>
#include <map>
#include <utility>

namespace limpid::benchmark
{
namespace
{
const char* const noFigure = "not measured";

std::string Cell(const Figure& figure)
{
  return figure.Measured() ? Milliseconds(figure.seconds) : noFigure;
}

std::string Title(const SceneResult& scene)
{
  return scene.name + ", " + std::to_string(scene.nodes) + "³";
}

/// What launches of a label belong to in the tables.
std::string GroupOf(const std::string& label)
{
  static const std::map<std::string, std::string> groups{
    { "forward sweep", "forward sweeps" },
    { "backward sweep", "backward sweeps" },
    { "derivative", "derivative at the voxels" },
    { "Adam", "Adam's step" },
    { "visible importance", "sums" },
    { "importance", "sums" },
    { "regularization", "sums" },
    { "change", "sums" },
    { "set to zero", "clearing and copying" },
    { "clear rays", "clearing and copying" },
    { "copy", "clearing and copying" },
    { "upload", "to and from the host" },
    { "download", "to and from the host" },
  };
  const auto group = groups.find(label);
  return group == groups.end() ? label : group->second;
}

std::vector<Part> Grouped(const std::vector<Part>& parts)
{
  std::vector<Part> groups;
  for (const Part& part : parts)
  {
    const std::string name = GroupOf(part.name);
    auto group = std::find_if(
      groups.begin(), groups.end(), [&](const Part& other) { return other.name == name; });
    if (group == groups.end())
    {
      group = groups.insert(group, Part{ name, 0, 0, 0 });
    }
    group->launches += part.launches;
    group->seconds += part.seconds;
    group->bytes += part.bytes;
  }
  return groups;
}

/// One line of the table of bars: what it is, what it has to be, and its cell in a scene.
struct Bar
{
  const char* what;
  const char* bar;
  std::function<std::string(const SceneResult&)> cell;
};

std::string Gigabytes(const IterationResult& result)
{
  return result.wall.Measured() ? Significant(1e-9 * double(result.deviceMemory), 3) : noFigure;
}

const std::array<Bar, 7> bars{ {
  { "policy iteration [ms]", "256³ ≤ 2, 472³ ≤ 12",
    [](const SceneResult& s) { return Cell(s.policy.wall); } },
  { "Adam iteration [ms]", "256³ ≤ 2, 472³ ≤ 12",
    [](const SceneResult& s) { return Cell(s.adam.wall); } },
  { "whole default run [ms]", "256³ ≤ 12",
    [](const SceneResult& s)
    {
      return Cell(s.run) +
        (s.run.Measured() ? " (" + std::to_string(s.runIterations) + " iterations)" : "");
    } },
  { "picture with shadows [ms]", "1024² pixels ≤ 4",
    [](const SceneResult& s) { return Cell(s.picture); } },
  { "scores of all directions [ms]", "none",
    [](const SceneResult& s)
    {
      return Cell(s.sphere) +
        (s.sphere.Measured() ? " (" + std::to_string(s.directions) + " directions)" : "");
    } },
  { "device memory, policy [GB]", "256³ ≤ 0.7, 472³ ≤ 4.5",
    [](const SceneResult& s) { return Gigabytes(s.policy); } },
  { "device memory, Adam [GB]", "256³ ≤ 0.7, 472³ ≤ 4.5",
    [](const SceneResult& s) { return Gigabytes(s.adam); } },
} };

void WriteBars(std::ostream& stream, const DeviceResult& result)
{
  std::vector<std::string> headings{ "what", "bar (NVIDIA H200)" };
  for (const SceneResult& scene : result.scenes)
  {
    headings.push_back(Title(scene));
  }
  Table table(headings);
  for (const Bar& bar : bars)
  {
    std::vector<std::string> cells{ bar.what, bar.bar };
    for (const SceneResult& scene : result.scenes)
    {
      cells.push_back(bar.cell(scene));
    }
    table.Add(cells);
  }
  stream << "\n## Against the bars\n";
  table.Write(stream);
}

void WriteIteration(
  std::ostream& stream, const std::string& title, const IterationResult& result, double bandwidth)
{
  if (!result.wall.Measured())
  {
    return;
  }
  const auto rate = [&](double bytes, double seconds)
  {
    return bytes > 0 && seconds > 0 && bandwidth > 0
      ? Significant(100 * bytes / seconds / bandwidth, 3) + " %"
      : std::string("-");
  };
  Table table({ title, "launches", "ms", "MB", "of the copy rate" });
  double sum = 0;
  for (const Part& part : Grouped(result.parts))
  {
    sum += part.seconds;
    table.Add({ part.name, Significant(part.launches, 3), Milliseconds(part.seconds),
      Significant(1e-6 * part.bytes, 4), rate(part.bytes, part.seconds) });
  }
  table.Add(
    { "sum", "", Milliseconds(sum), Significant(1e-6 * result.bytes, 4), rate(result.bytes, sum) });
  table.Add({ "wall clock, not taken apart", "", Milliseconds(result.wall.seconds),
    Significant(1e-6 * result.bytes, 4), rate(result.bytes, result.wall.seconds) });
  table.Write(stream);
}

const std::array<std::pair<const char*, Figure SceneResult::*>, 10> figures{ {
  { "scene: checks, importance of nodes, spans (host)", &SceneResult::prepare },
  { "scene: its fields to the GPU", &SceneResult::upload },
  { "view: planning the rays (host)", &SceneResult::plan },
  { "view: planning, tables and first iterate to the GPU", &SceneResult::begin },
  { "view: whole default run, these included", &SceneResult::run },
  { "result to the host", &SceneResult::download },
  { "scores of all directions", &SceneResult::sphere },
  { "picture of another extinction, with its shadows", &SceneResult::picture },
  { "picture of the same extinction", &SceneResult::pictureAtRest },
  { "policy iteration on the processor", &SceneResult::processor },
} };

void WriteFigures(std::ostream& stream, const SceneResult& scene)
{
  Table table({ "whole steps", "ms", "spread", "repetitions" });
  for (const auto& [name, member] : figures)
  {
    const Figure& figure = scene.*member;
    if (figure.Measured())
    {
      table.Add({ name, Milliseconds(figure.seconds), Significant(100 * figure.spread, 2) + " %",
        std::to_string(figure.repetitions) });
    }
  }
  table.Write(stream);
}

void WriteMissing(std::ostream& stream, const DeviceResult& result)
{
  const auto tell = [&](const std::string& what, const Figure& figure)
  {
    if (!figure.Measured())
    {
      stream << "* Not measured: " << what << ". " << figure.missing << "\n";
    }
  };
  tell("copy rate", result.copy);
  for (const SceneResult& scene : result.scenes)
  {
    tell(Title(scene) + ", policy iteration", scene.policy.wall);
    tell(Title(scene) + ", Adam iteration", scene.adam.wall);
    for (const auto& [name, member] : figures)
    {
      tell(Title(scene) + ", " + name, scene.*member);
    }
  }
}
}

void WritePage(std::ostream& stream, const DeviceResult& result)
{
  stream << "\n* device: " << result.name << "\n";
  if (result.copy.Measured())
  {
    stream << "* copy rate, from one place on the device to another: "
           << Significant(1e-9 * result.Bandwidth(), 4) << " GB/s, bytes read and bytes written\n";
  }
  WriteBars(stream, result);
  WriteMissing(stream, result);
  for (const SceneResult& scene : result.scenes)
  {
    stream << "\n## " << Title(scene) << "\n\n"
           << Significant(100 * scene.filled, 3) << " % of the voxels are swept.\n";
    WriteIteration(stream, "policy iteration", scene.policy, result.Bandwidth());
    WriteIteration(stream, "Adam iteration", scene.adam, result.Bandwidth());
    WriteFigures(stream, scene);
  }
}
}
