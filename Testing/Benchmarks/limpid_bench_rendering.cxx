// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

// How long pictures take: the renderer on scene files, as one Markdown page.

#include "Machine.h"
#include "Options.h"
#include "Rendering.h"
#include "Scene.h"

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
    std::vector<RenderingResult> results;
    for (const std::string& path : options.scenes)
    {
      const Scene scene(path);
      std::cerr << scene.file.name << std::endl;
      results.push_back(MeasureRendering(scene, options));
    }
    std::ostringstream page;
    page << "# Rendering\n\nWhat the tables mean is in [README.md](README.md).\n\n";
    WriteMachine(page, std::vector<std::string>(argv, argv + argc), load);
    WriteRendering(page, results);
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
