// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

// How long a search for viewpoints takes, on scene files, as one Markdown page.

#include "Machine.h"
#include "Options.h"
#include "Scene.h"
#include "Viewpoints.h"

#include "backend/Backend.h"

#include <exception>
#include <fstream>
#include <iostream>
#include <sstream>
#include <string>
#include <vector>

int main(int argc, char* argv[])
{
  using namespace limpid;
  using namespace limpid::benchmark;
  try
  {
    const double load = LoadAverage();
    const Options options = ParseOptions(std::vector<std::string>(argv + 1, argv + argc));
    const ThreadLimit limit(options.threads > 0 ? options.threads : ThreadCount());
    std::vector<ViewpointResult> results;
    for (const std::string& path : options.scenes)
    {
      const Scene scene(path);
      std::cerr << scene.file.name << std::endl;
      for (const ViewpointResult& result : MeasureViewpoints(scene, options))
      {
        results.push_back(result);
      }
    }
    std::ostringstream page;
    page << "# Viewpoints\n\nWhat the tables mean is in [README.md](README.md).\n\n";
    WriteMachine(page, std::vector<std::string>(argv, argv + argc), load);
    WriteViewpoints(page, results, options);
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
