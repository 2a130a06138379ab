// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

// How long a search for viewpoints takes, on scene files, as one Markdown page.

#include "Program.h"
#include "Scene.h"
#include "Viewpoints.h"

#include "backend/Backend.h"

#include <iostream>
#include <string>
#include <vector>

int main(int argc, char* argv[])
{
  using namespace limpid;
  using namespace limpid::benchmark;
  return RunProgram(argc, argv, "Viewpoints",
    [](const Options& options, std::ostream& tables)
    {
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
      WriteViewpoints(tables, results, options);
    });
}
