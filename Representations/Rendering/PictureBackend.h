// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

// Chooses where the pictures of a volume are computed.

#ifndef limpid_PictureBackend_h
#define limpid_PictureBackend_h

#include "optimize/Settings.h"
#include "render/RenderBackend.h"
#include "scene/Grid.h"

#include <memory>
#include <optional>
#include <string>

class vtkOpenGLRenderWindow;
class vtkWindow;

namespace limpid
{
class OpenGlCaster;

/// What draws the pictures.
enum class DrawOn
{
  Auto, ///< what LIMPID_DRAW_ON says in the environment, Processor or OpenGL; else CUDA unless
        ///< the optimisation must not use it; else OpenGL if it is hardware
  Processor,
  Cuda,
  OpenGl
};

/// If what was requested is missing or fails, the processor draws, with a warning.
class PictureBackend
{
public:
  struct Wish
  {
    DrawOn drawOn = DrawOn::Auto;
    BackendKind backend = BackendKind::Auto; ///< of the optimisation

    friend bool operator==(const Wish& one, const Wish& other)
    {
      return one.drawOn == other.drawOn && one.backend == other.backend;
    }
    friend bool operator!=(const Wish& one, const Wish& other) { return !(one == other); }
  };

  /// Returns whether the present choice was made for this request.
  bool Suits(const Wish& wish) const { return this->For == wish; }

  /// Returns a new backend for a request. A GPU that has failed is not chosen again for the same
  /// request.
  std::unique_ptr<RenderBackend> Choose(
    const Wish& wish, const Grid& grid, vtkOpenGLRenderWindow* window);

  /// Follows the renderer into another window.
  void DrawIn(vtkOpenGLRenderWindow* window);

  /// Returns whether a graphics card draws by OpenGL, in little time.
  bool IsGraphicsCard() const;

  /// Returns whether the last picture took longer because it was the first of its kind.
  bool HasBegun() const;

  /// Makes the next request choose again.
  void Forget();

  /// Records that the GPU has failed. Returns false if no GPU is in use.
  bool GiveUpGpu(const std::string& reason);

  /// Returns the warning for the user about the last picture; may be empty.
  std::string Warning() const;

  /// Returns one line for the user: what drew the last picture and, if it is the processor, why.
  std::string DrawnBy() const;

  /// Returns the bytes that pictures have uploaded to OpenGL since the last call.
  Index TakeUploadedBytes();

  void ReleaseGraphicsResources(vtkWindow* window);

private:
  std::unique_ptr<RenderBackend> Processor(const std::string& reason);

  std::optional<Wish> For;              ///< the request it was chosen for
  std::optional<Wish> FailedFor;        ///< the request for which a GPU has failed
  std::shared_ptr<OpenGlCaster> OpenGl; ///< null: not in use
  bool OnSoftware = false;              ///< whether its renderer is a program
  bool OnCuda = false;
  std::string Line;
  std::string Words; ///< warning
};
}

#endif
