// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#include "PictureBackend.h"

#include "OpenGlCaster.h"
#include "OpenGlFunctions.h"

#include "vtkOpenGLRenderWindow.h"

#include "backend/ComputeBackend.h"

#include <algorithm>
#include <cstddef>
#include <cstdlib>
#include <iterator>
#include <utility>

namespace limpid
{
namespace
{
BackendChoice ChooseCuda(const Grid& grid)
{
  constexpr std::size_t bytesPerNode = 32 + 28; // of pictures and optimisation
  const Index nodes = grid.NodeCount();
  return ChooseBackend(
    BackendKind::Auto, { nodes, bytesPerNode * static_cast<std::size_t>(nodes) });
}

/// Returns whether a renderer of OpenGL is a program, which is slower than the processor's own
/// rays.
bool IsSoftware(const std::string& renderer)
{
  const char* const names[] = { "llvmpipe", "softpipe", "SwiftShader", "Software Rasterizer",
    "swrast" };
  return renderer.empty() ||
    std::any_of(std::begin(names), std::end(names),
      [&](const char* name) { return renderer.find(name) != std::string::npos; });
}

/// Returns what is taken for a request. The environment may say what Auto takes.
DrawOn Taken(DrawOn wish)
{
  const char* preferred = std::getenv("LIMPID_DRAW_ON");
  const std::string name = preferred && wish == DrawOn::Auto ? preferred : "";
  return name == "Processor" ? DrawOn::Processor : name == "OpenGL" ? DrawOn::OpenGl : wish;
}

std::string ByProcessor(const std::string& reason)
{
  return CpuName() + (reason.empty() ? reason : " (" + reason + ")");
}
}

std::unique_ptr<RenderBackend> PictureBackend::Processor(const std::string& reason)
{
  this->Line = ByProcessor(reason);
  return ProcessorBackend().MakeRenderBackend();
}

std::unique_ptr<RenderBackend> PictureBackend::Choose(
  const Wish& wish, const Grid& grid, vtkOpenGLRenderWindow* window)
{
  if (this->FailedFor != wish)
  {
    this->FailedFor.reset();
    this->Words.clear();
  }
  this->For = wish;
  this->OnCuda = false;
  this->OpenGl.reset();
  if (this->FailedFor)
  {
    return this->Processor("the GPU has failed");
  }
  const DrawOn taken = Taken(wish.drawOn);
  const bool mayUseCuda =
    taken == DrawOn::Cuda || (taken == DrawOn::Auto && wish.backend != BackendKind::Cpu);
  if (mayUseCuda)
  {
    const BackendChoice cuda = ChooseCuda(grid);
    if (cuda.cuda)
    {
      this->OnCuda = true;
      this->Line = cuda.name;
      return CudaBackend().MakeRenderBackend();
    }
    if (taken == DrawOn::Cuda)
    {
      this->Words = "DrawOn is CUDA, but the pictures are drawn by: " + cuda.name +
        ". Choose another value of DrawOn.";
      return this->Processor("CUDA is not available");
    }
  }
  if (taken == DrawOn::Processor)
  {
    return this->Processor("");
  }
  window->MakeCurrent();
  const std::string renderer = gl::RendererName();
  this->OnSoftware = IsSoftware(renderer);
  if (taken == DrawOn::Auto && this->OnSoftware)
  {
    return this->Processor("OpenGL is software: " + renderer);
  }
  this->OpenGl = std::make_shared<OpenGlCaster>(window);
  this->Line = "OpenGL, " + renderer;
  return BackendWith(this->OpenGl);
}

void PictureBackend::DrawIn(vtkOpenGLRenderWindow* window)
{
  if (this->OpenGl)
  {
    this->OpenGl->DrawIn(window);
  }
}

bool PictureBackend::IsGraphicsCard() const
{
  return this->OpenGl && !this->OnSoftware && this->OpenGl->Refusal().empty();
}

bool PictureBackend::HasBegun() const
{
  return this->OpenGl && this->OpenGl->HasBegun();
}

void PictureBackend::Forget()
{
  this->For.reset();
  this->OpenGl.reset();
}

bool PictureBackend::GiveUpGpu(const std::string& reason)
{
  if (!this->For || !this->OnCuda)
  {
    return false;
  }
  this->FailedFor = this->For;
  this->Words = reason + " Until Backend is changed, the CPU draws the volume.";
  this->OnCuda = false;
  return true;
}

std::string PictureBackend::Warning() const
{
  if (!this->OpenGl || this->OpenGl->Refusal().empty())
  {
    return this->Words;
  }
  if (this->OpenGl->HasFailed())
  {
    return this->OpenGl->Refusal() + " Until DrawOn is changed, the CPU draws the volume.";
  }
  return this->For->drawOn == DrawOn::OpenGl ? "DrawOn is OpenGL, but " + this->OpenGl->Refusal() +
      " (OpenGL cannot draw this). The CPU draws the volume. Set DrawOn to Auto."
                                             : std::string();
}

std::string PictureBackend::DrawnBy() const
{
  return this->OpenGl && !this->OpenGl->Refusal().empty() ? ByProcessor(this->OpenGl->Refusal())
                                                          : this->Line;
}

Index PictureBackend::TakeUploadedBytes()
{
  return this->OpenGl ? this->OpenGl->TakeUploadedBytes() : 0;
}

void PictureBackend::ReleaseGraphicsResources(vtkWindow* window)
{
  if (this->OpenGl)
  {
    this->OpenGl->ReleaseGraphicsResources(window);
  }
}
}
