// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

// Draws a picture into a viewport.

#ifndef limpid_PictureQuad_h
#define limpid_PictureQuad_h

#include "ViewGeometry.h"

#include "vtkNew.h"

#include <array>
#include <memory>
#include <vector>

class vtkOpenGLQuadHelper;
class vtkTextureObject;
class vtkWindow;

namespace limpid
{
class OpaqueDepth;
struct DepthRange;
struct Picture;

/// Two coarse pictures, of rays that end at the nearest and at the farthest opaque geometry within
/// what their pixels cover, which is `ranges`.
struct PicturesBetween
{
  const Picture& nearest;
  const Picture& farthest;
  const std::vector<DepthRange>& ranges;
  const OpaqueDepth& opaque;
};

/**
 * A rectangle with a texture, pixel by pixel where picture and viewport have equal pixels and
 * interpolated where they have not. vtkRayCastImageDisplayHelper, which VTK's own mapper uses,
 * draws every picture one pixel too narrow.
 */
class PictureQuad
{
public:
  PictureQuad();
  ~PictureQuad();
  PictureQuad(const PictureQuad&) = delete;
  PictureQuad& operator=(const PictureQuad&) = delete;

  /// Over what has been drawn before, where that is not nearer than `depth` in the depth buffer.
  /// Throws when the window has no OpenGL.
  void Draw(vtkRenderer* renderer, const Picture& picture, const PictureFrame& frame, double depth);

  /// Likewise, the one of two pictures that each pixel's own depth asks for, or what is between
  /// them: a line or an edge is as fine as the view then, and leaves nothing beside it.
  void DrawBetween(vtkRenderer* renderer, const PicturesBetween& pictures,
    const PictureFrame& frame, const ViewGeometry& geometry);

  /// Like Draw, but where the picture's alpha is above `threshold` in this colour, and nowhere
  /// else.
  void DrawMask(vtkRenderer* renderer, const Picture& picture, const PictureFrame& frame,
    double depth, const float color[3], double threshold);

  void ReleaseGraphicsResources(vtkWindow* window);

private:
  void Draw(vtkRenderer* renderer, const Picture& picture, const PictureFrame& frame, double depth,
    const std::array<float, 4>& mask, bool interpolates);
  void Ready(vtkRenderer* renderer);
  void Blend(vtkRenderer* renderer, const PictureFrame& frame, double depth,
    const std::array<float, 4>& mask);
  std::array<vtkTextureObject*, 4> Textures();

  std::unique_ptr<vtkOpenGLQuadHelper> Quad;
  vtkNew<vtkTextureObject> Texture;
  vtkNew<vtkTextureObject> NearTexture; // this and the following: of two pictures only
  vtkNew<vtkTextureObject> Ranges;
  vtkNew<vtkTextureObject> Depths;
};
}

#endif
