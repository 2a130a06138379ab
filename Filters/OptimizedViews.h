// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

// Scores views with an extinction that is optimised for each of them.

#ifndef limpid_OptimizedViews_h
#define limpid_OptimizedViews_h

#include "optimize/PreparedScene.h"
#include "viewpoint/Search.h"

#include <functional>
#include <memory>
#include <vector>

namespace limpid
{
class OptimizedViews
{
public:
  /// For each view, the light is placed above and behind the camera.
  OptimizedViews(
    std::shared_ptr<PreparedScene> scene, const Orbit& orbit, const Settings& settings);

  /// Scores directions, with one solver run each. If `progress` asks to stop, the remaining ones
  /// stay invalid.
  std::vector<ScoredView> ScoreAll(
    const std::vector<Vec3>& directions, const SearchProgress& progress) const;

  /// Climbs from the best samples, with alternating steps of the camera and of the extinction, and
  /// ranks the views that it reaches.
  SearchResult Find(const std::vector<ScoredView>& samples, const SearchSettings& settings,
    const SearchProgress& progress) const;

private:
  using GoOn = std::function<bool()>;

  ScoredView At(const Vec3& direction, const GoOn& goOn, std::vector<float>* extinction) const;
  ScoredView Optimized(const Vec3& direction, std::vector<float>* extinction) const;
  SearchResult Top(const Vec3& start, const std::vector<float>& extinction,
    const SearchSettings& settings, const GoOn& goOn) const;
  Index Climb(const ScoredView& sample, const SearchSettings& settings, const GoOn& goOn,
    std::vector<ScoredView>& path) const;

  std::shared_ptr<PreparedScene> Scene;
  Orbit From;
  Settings Options;
};
}

#endif
