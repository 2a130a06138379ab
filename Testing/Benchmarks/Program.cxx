// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#include "Program.h"

#include "Today.h"

#include "backend/Backend.h"
#include "math/Require.h"

#include <algorithm>
#include <cctype>
#include <exception>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <sstream>
#include <system_error>
#include <thread>

namespace limpid::benchmark
{
namespace
{
bool IsNumber(const std::string& text)
{
  return !text.empty() && std::isdigit(static_cast<unsigned char>(text.front()));
}

/// Whether a value is of the kind of its default.
void RequireFit(const std::string& name, const std::string& standard, const std::string& value)
{
  const std::vector<std::string> choice = Split(standard);
  for (const std::string& item : Split(value))
  {
    const bool known = IsNumber(standard)
      ? std::atof(item.c_str()) > 0
      : choice.size() < 2 || std::find(choice.begin(), choice.end(), item) != choice.end();
    LIMPID_REQUIRE(known,
      "The option --" << name << " is \"" << value << "\" (its default is \"" << standard
                      << "\"). Give a number above zero, or some of these items.");
  }
}

/// What follows ": " in the first line of a file that begins so.
std::string Line(const char* path, const std::string& begin)
{
  std::ifstream file(path);
  for (std::string line; std::getline(file, line);)
  {
    const std::size_t colon = line.find(": ");
    if (line.rfind(begin, 0) == 0 && colon != std::string::npos)
    {
      return line.substr(colon + 2);
    }
  }
  return "unknown";
}

void RequireWritten(bool good, const std::string& path)
{
  LIMPID_REQUIRE(
    good, "The file " << path << " cannot be written (the results would be lost). Choose another.");
}

/// What is written, before it replaces the file.
std::string Unfinished(const std::string& path)
{
  return path + ".part";
}

/// Throws if no file can be written there; leaves none that is empty.
void RequireWritable(const std::string& path)
{
  const std::string unfinished = Unfinished(path);
  RequireWritten(
    !std::filesystem::is_directory(path) && std::ofstream(unfinished, std::ios::app).good(), path);
  std::filesystem::remove(unfinished);
}

/// Replaces the file as a whole, so that it is complete whenever this program ends.
void Save(const std::string& path, const Json& json)
{
  const std::string text = json.dump(1);
  if (path.empty())
  {
    std::cout << text << std::endl;
    return;
  }
  const std::string unfinished = Unfinished(path);
  RequireWritten((std::ofstream(unfinished) << text << std::endl).good(), path);
  std::error_code failed;
  std::filesystem::rename(unfinished, path, failed);
  RequireWritten(!failed, path);
}
}

double LoadAverage()
{
  double load = 0;
  std::ifstream("/proc/loadavg") >> load;
  return load;
}

Json Machine(const std::vector<std::string>& command, double loadBefore)
{
  std::string shown;
  for (const std::string& word : command)
  {
    const bool absolute = word.rfind('/', 0) == 0;
    shown += (shown.empty() ? "" : " ") + (absolute ? word.substr(word.rfind('/') + 1) : word);
  }
  return { { "command", shown }, { "processor", Line("/proc/cpuinfo", "model name") },
    { "cores", std::thread::hardware_concurrency() }, { "threads", ThreadCount() },
    { "compiler", LIMPID_COMPILER }, { "build_type", LIMPID_BUILD_TYPE }, { "date", Today() },
    { "load_before", loadBefore }, { "load_after", LoadAverage() } };
}

std::vector<std::string> Split(const std::string& list)
{
  std::vector<std::string> items;
  std::istringstream stream(list);
  for (std::string item; std::getline(stream, item, ',');)
  {
    items.push_back(item);
  }
  return items;
}

std::string Options::UsageOf(const Table& known)
{
  std::string usage;
  for (const auto& [name, value] : known)
  {
    usage += " --" + name + (value == "no" ? "" : value.empty() ? " VALUE" : " " + value);
  }
  return usage;
}

bool Options::TellUsage(const std::vector<std::string>& arguments, const Table& known)
{
  const bool asked = std::find(arguments.begin(), arguments.end(), "--help") != arguments.end();
  if (asked)
  {
    std::cout << "There are these options, with their defaults:" << UsageOf(known) << '\n';
  }
  return asked;
}

Options::Options(const std::vector<std::string>& arguments, const Table& known)
  : Values(known)
{
  for (std::size_t at = 0; at < arguments.size(); ++at)
  {
    if (arguments[at].rfind("--", 0) != 0)
    {
      this->words.push_back(arguments[at]);
      continue;
    }
    const auto option = this->Values.find(arguments[at].substr(2));
    const bool flag = option != this->Values.end() && option->second == "no";
    LIMPID_REQUIRE(option != this->Values.end() && (flag || at + 1 < arguments.size()),
      "The option " << arguments[at] << " is unknown or has no value (nothing would come of it). "
                    << "There are, with their defaults:" << UsageOf(known));
    const std::string value = flag ? "yes" : arguments[++at];
    RequireFit(option->first, option->second, value);
    option->second = value;
  }
}

bool Options::Has(const std::string& name, const std::string& item) const
{
  const std::vector<std::string> items = this->List(name);
  return std::find(items.begin(), items.end(), item) != items.end();
}

Json Options::ToJson() const
{
  Json json;
  for (const auto& [name, value] : this->Values)
  {
    const bool isList = value.find(',') != std::string::npos;
    json[name] = IsNumber(value) && !isList ? Json(std::stod(value)) : Json(value);
  }
  json.erase("output"); // a place of one machine
  return json;
}

int RunProgram(int argc, char* argv[], const Options::Table& known, const Measurement& measure)
{
  try
  {
    const double load = LoadAverage();
    Options::Table all{ { "output", "" }, { "threads", "0" }, { "quick", "no" } };
    all.insert(known.begin(), known.end());
    const std::vector<std::string> arguments(argv + 1, argv + argc);
    if (Options::TellUsage(arguments, all))
    {
      return 0;
    }
    const Options options(arguments, all);
    const int threads = options.Count("threads");
    const ThreadLimit limit(threads > 0 ? threads : ThreadCount());
    Json results = Json::object();
    const auto save = [&]
    {
      Json whole{ { "machine", Machine(std::vector<std::string>(argv, argv + argc), load) },
        { "options", options.ToJson() } };
      whole.update(results);
      Save(options.Text("output"), whole);
    };
    const bool toFile = !options.Text("output").empty();
    const auto saveInFile = [&] { toFile ? save() : void(); };
    if (toFile)
    {
      RequireWritable(options.Text("output"));
    }
    measure(options, results, saveInFile);
    save();
    return 0;
  }
  catch (const std::exception& error)
  {
    std::cerr << error.what() << "\n";
    return 1;
  }
}
}
