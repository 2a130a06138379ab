// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#include "Json.h"

#include <iomanip>
#include <sstream>
#include <string>
#include <vector>

namespace limpid::benchmark
{
namespace
{
std::string Text(const std::string& text)
{
  std::ostringstream quoted;
  quoted << std::hex << std::setfill('0') << '"';
  for (const char c : text)
  {
    const auto code = static_cast<unsigned char>(c);
    if (c == '"' || c == '\\')
    {
      quoted << '\\' << c;
    }
    else if (code < 0x20)
    {
      quoted << "\\u" << std::setw(4) << unsigned(code);
    }
    else
    {
      quoted << c;
    }
  }
  quoted << '"';
  return quoted.str();
}

std::string Number(double value)
{
  std::ostringstream text;
  text << std::setprecision(9) << value;
  return text.str();
}

std::string Member(const char* name, const std::string& value)
{
  return Text(name) + ": " + value;
}

std::string Joined(
  char open, char close, const std::vector<std::string>& items, const std::string& separator)
{
  std::string text(1, open);
  for (const std::string& item : items)
  {
    text += (&item == items.data() ? "" : separator) + item;
  }
  return text + close;
}

std::string Object(const std::vector<std::string>& members)
{
  return Joined('{', '}', members, ", ");
}

std::string List(const std::vector<std::string>& items)
{
  return Joined('[', ']', items, ",\n  ");
}

std::string Of(const Figure& figure)
{
  if (!figure.Measured())
  {
    return Object({ Member("missing", Text(figure.missing)) });
  }
  return Object(
    { Member("seconds", Number(figure.seconds)), Member("spread", Number(figure.spread)),
      Member("repetitions", std::to_string(figure.repetitions)) });
}

std::string Of(const IterationResult& result)
{
  std::vector<std::string> parts;
  for (const Part& part : result.parts)
  {
    parts.push_back(
      Object({ Member("label", Text(part.name)), Member("launches", Number(part.launches)),
        Member("seconds", Number(part.seconds)), Member("bytes", Number(part.bytes)) }));
  }
  return Object({ Member("wall", Of(result.wall)), Member("parts", List(parts)),
    Member("bytes", Number(result.bytes)),
    Member("deviceMemory", std::to_string(result.deviceMemory)) });
}

std::string Of(const SceneResult& scene)
{
  return Object({ Member("scene", Text(scene.name)), Member("nodes", std::to_string(scene.nodes)),
    Member("filled", Number(scene.filled)), Member("prepare", Of(scene.prepare)),
    Member("upload", Of(scene.upload)), Member("plan", Of(scene.plan)),
    Member("begin", Of(scene.begin)), Member("policy", Of(scene.policy)),
    Member("adam", Of(scene.adam)), Member("run", Of(scene.run)),
    Member("runIterations", std::to_string(scene.runIterations)),
    Member("download", Of(scene.download)), Member("sphere", Of(scene.sphere)),
    Member("directions", std::to_string(scene.directions)), Member("picture", Of(scene.picture)),
    Member("pictureAtRest", Of(scene.pictureAtRest)), Member("processor", Of(scene.processor)) });
}
}

void WriteJson(std::ostream& stream, const DeviceResult& result)
{
  std::vector<std::string> scenes;
  for (const SceneResult& scene : result.scenes)
  {
    scenes.push_back(Of(scene));
  }
  stream << Object({ Member("device", Text(result.name)), Member("copy", Of(result.copy)),
              Member("copyBytes", Number(result.copyBytes)), Member("scenes", List(scenes)) })
         << "\n";
}
}
