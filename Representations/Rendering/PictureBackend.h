// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

// What makes the pictures of a volume: a GPU or the processor.

#ifndef limpid_PictureBackend_h
#define limpid_PictureBackend_h

#include "optimize/Settings.h"
#include "render/RenderBackend.h"
#include "scene/Grid.h"

#include <memory>
#include <optional>
#include <string>

namespace limpid
{
/// Who asks for CUDA where there is none, or where it fails, is told and sees a picture.
class PictureBackend
{
public:
  /// Whether nothing is to be chosen.
  bool Suits(BackendKind wish) const { return this->For == wish; }

  /// A GPU that has failed is not chosen again for the same wish.
  std::unique_ptr<RenderBackend> Choose(BackendKind wish, const Grid& grid);

  /// Next time, something is to be chosen.
  void Forget() { this->For.reset(); }

  /// The GPU has failed. Returns false where none makes pictures.
  bool GiveUpGpu(const std::string& reason);

  /// What the user is to be told; empty: nothing.
  const std::string& Warning() const { return this->Words; }

private:
  std::optional<BackendKind> For; ///< the wish for which it was chosen
  bool OnGpu = false;
  std::optional<BackendKind> FailedFor; ///< the wish for which a GPU has failed
  std::string Words;
};
}

#endif
