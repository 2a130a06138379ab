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

/// Two coarse pictures whose rays end at the nearest and at the farthest opaque geometry within
/// each pixel, which is `ranges`.
struct PicturesBetween
{
  const Picture& nearest;
  const Picture& farthest;
  const std::vector<DepthRange>& ranges;
  const OpaqueDepth& opaque;
};

/**
 * Draws a rectangle with a texture, pixel by pixel if picture and viewport have equal pixels,
 * otherwise interpolated. (vtkRayCastImageDisplayHelper, which VTK's own mapper uses, draws every
 * picture one pixel too narrow.)
 */
class PictureQuad
{
public:
  PictureQuad();
  ~PictureQuad();
  PictureQuad(const PictureQuad&) = delete;
  PictureQuad& operator=(const PictureQuad&) = delete;

  /// Blends a picture over what has been drawn before, except where that is nearer than `depth` in
  /// the depth buffer. Throws if the window has no OpenGL.
  void Draw(vtkRenderer* renderer, const Picture& picture, const PictureFrame& frame, double depth);

  /// Like Draw, but blends two pictures by the depth of each pixel of the view. Thin lines and
  /// edges are as fine as the view, without artefacts beside them.
  void DrawBetween(vtkRenderer* renderer, const PicturesBetween& pictures,
    const PictureFrame& frame, const ViewGeometry& geometry);

  /// Like Draw, but in this colour where the picture's alpha exceeds `threshold`, and nothing
  /// elsewhere.
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
  vtkNew<vtkTextureObject> NearTexture; // this and the following are used for two pictures only
  vtkNew<vtkTextureObject> Ranges;
  vtkNew<vtkTextureObject> Depths;
};
}

#endif
