// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#include "Machine.h"

#include "Markdown.h"

#include "backend/Backend.h"

#include <ctime>
#include <fstream>
#include <thread>

namespace limpid::benchmark
{
namespace
{
std::string ProcessorModel()
{
  std::ifstream file("/proc/cpuinfo");
  for (std::string line; std::getline(file, line);)
  {
    const std::size_t colon = line.find(": ");
    if (line.rfind("model name", 0) == 0 && colon != std::string::npos)
    {
      return line.substr(colon + 2);
    }
  }
  return "unknown";
}

std::string Today()
{
  const std::time_t now = std::time(nullptr);
  char text[16] = "";
  std::strftime(text, sizeof(text), "%Y-%m-%d", std::localtime(&now));
  return text;
}

/// Absolute paths are a matter of one machine: of those only the file name is shown.
std::string Shown(const std::string& argument)
{
  return argument.rfind('/', 0) == 0 ? argument.substr(argument.find_last_of('/') + 1) : argument;
}

std::string Text(const std::vector<std::string>& command)
{
  std::string text;
  for (const std::string& argument : command)
  {
    text += (text.empty() ? "" : " ") + Shown(argument);
  }
  return text;
}
}

double LoadAverage()
{
  std::ifstream file("/proc/loadavg");
  double load = -1;
  return file >> load ? load : -1;
}

MachineFacts FactsOfMachine()
{
  return { ProcessorModel(), static_cast<int>(std::thread::hardware_concurrency()), ThreadCount(),
    LIMPID_COMPILER, LIMPID_BUILD_TYPE, Today() };
}

void WriteMachine(std::ostream& stream, const std::vector<std::string>& command, double loadBefore)
{
  const MachineFacts machine = FactsOfMachine();
  stream << "    " << Text(command) << "\n\n"
         << "* processor: " << machine.processor << ", " << machine.cores << " cores visible, "
         << machine.threads << " threads used\n"
         << "* compiler: " << machine.compiler << ", build type " << machine.buildType << "\n"
         << "* date: " << machine.date << "\n"
         << "* load average before the start: "
         << (loadBefore < 0 ? std::string("unknown") : Fixed(loadBefore, 2)) << "\n";
  if (loadBefore > 0.5)
  {
    stream << "\n**The machine was not idle: times are preliminary.** Scores, energies and memory "
              "do not depend on the load.\n";
  }
}
}
