// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

// How long pictures take: the renderer on scene files, as one Markdown page.

#include "Program.h"
#include "Rendering.h"
#include "Scene.h"

#include "backend/Backend.h"

#include <iostream>
#include <string>
#include <vector>

int main(int argc, char* argv[])
{
  using namespace limpid;
  using namespace limpid::benchmark;
  return RunProgram(argc, argv, "Rendering",
    [](const Options& options, std::ostream& tables)
    {
      const ThreadLimit limit(options.threads > 0 ? options.threads : ThreadCount());
      std::vector<RenderingResult> results;
      for (const std::string& path : options.scenes)
      {
        const Scene scene(path);
        std::cerr << scene.file.name << std::endl;
        results.push_back(MeasureRendering(scene, options));
      }
      WriteRendering(tables, results);
    });
}
