// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

// Chooses where the pictures of a volume are computed: on a GPU or on the processor.

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
/// If CUDA is requested but missing or failing, pictures are computed on the processor, with a
/// warning.
class PictureBackend
{
public:
  /// Returns whether the present choice was made for this request.
  bool Suits(BackendKind wish) const { return this->For == wish; }

  /// Returns a new backend for a request. A GPU that has failed is not chosen again for the same
  /// request.
  std::unique_ptr<RenderBackend> Choose(BackendKind wish, const Grid& grid);

  /// Makes the next request choose again.
  void Forget() { this->For.reset(); }

  /// Records that the GPU has failed. Returns false if no GPU is in use.
  bool GiveUpGpu(const std::string& reason);

  /// Returns the warning for the user; may be empty.
  const std::string& Warning() const { return this->Words; }

private:
  std::optional<BackendKind> For; ///< the request it was chosen for
  bool OnGpu = false;
  std::optional<BackendKind> FailedFor; ///< the request for which a GPU has failed
  std::string Words;
};
}

#endif
