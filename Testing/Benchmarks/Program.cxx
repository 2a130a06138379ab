// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#include "Program.h"

#include "Machine.h"

#include "backend/Backend.h"
#include "math/Require.h"

#include <exception>
#include <fstream>
#include <iostream>
#include <sstream>
#include <vector>

namespace limpid::benchmark
{
namespace
{
/// Now rather than after minutes of measuring.
void RequireWritable(const std::string& path)
{
  LIMPID_REQUIRE(path.empty() || std::ofstream(path, std::ios::app).good(),
    "The file " << path << " cannot be written (the results would be lost). Choose another.");
}
}

int RunProgram(int argc, char* argv[], const std::string& title, const Measurement& measure)
{
  try
  {
    const double load = LoadAverage();
    const Options options = ParseOptions(std::vector<std::string>(argv + 1, argv + argc));
    RequireWritable(options.output);
    std::ostringstream tables;
    measure(options, tables);
    const ThreadLimit limit(options.threads > 0 ? options.threads : ThreadCount());
    std::ostringstream page;
    page << "# " << title << "\n\nWhat the tables mean is in [README.md](README.md).\n\n";
    WriteMachine(page, std::vector<std::string>(argv, argv + argc), load);
    page << tables.str();
    std::ofstream file;
    if (!options.output.empty())
    {
      file.open(options.output);
    }
    (options.output.empty() ? std::cout : file) << page.str() << std::flush;
    return 0;
  }
  catch (const std::exception& error)
  {
    std::cerr << error.what() << "\n";
    return 1;
  }
}
}
