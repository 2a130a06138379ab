// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#include "SceneLight.h"

#include "SettingsConversion.h"
#include "Vectors.h"
#include "ViewGeometry.h"

#include "vtkCamera.h"
#include "vtkCollection.h"
#include "vtkLight.h"
#include "vtkLightCollection.h"
#include "vtkRenderer.h"

#include "scene/Placement.h"

#include <algorithm>
#include <sstream>

namespace limpid
{
namespace
{
// Returns the luminance of the diffuse colour (Rec. 709) times the intensity.
double StrengthOf(vtkLight* light)
{
  const double* color = light->GetDiffuseColor();
  return light->GetIntensity() * (0.2126 * color[0] + 0.7152 * color[1] + 0.0722 * color[2]);
}

const char* KindOf(vtkLight* light)
{
  if (light->LightTypeIsHeadlight())
  {
    return "headlight";
  }
  return light->LightTypeIsCameraLight() ? "camera light" : "scene light";
}

std::string Describe(vtkLight* light, int number, int count)
{
  const bool cone = light->GetPositional() && light->GetConeAngle() < 90;
  std::ostringstream text;
  text << "light " << number << " of " << count << ": " << KindOf(light) << ", "
       << (light->GetPositional() ? "positional" : "directional") << ", intensity "
       << light->GetIntensity()
       << (cone ? ", shining in all directions (its cone is ignored)" : "");
  return text.str();
}
}

ChosenLight OwnLight(vtkVisibilitySettings* settings, vtkRenderer* renderer)
{
  vtkCamera* source = renderer->GetActiveCamera();
  Camera camera;
  camera.position = ToVec3(source->GetPosition());
  camera.focalPoint = ToVec3(source->GetFocalPoint());
  camera.viewUp = ToVec3(source->GetViewUp());
  ChosenLight chosen;
  chosen.found = true;
  chosen.light = LightOf(settings, camera.focalPoint);
  if (IsUnplaced(chosen.light))
  {
    PlaceLight(camera, chosen.light);
    chosen.movesWithCamera = true;
  }
  std::ostringstream text;
  const Vec3& position = chosen.light.position;
  text << "own light: " << (chosen.light.type == LightType::Point ? "point" : "directional")
       << ", at (" << position.x << ", " << position.y << ", " << position.z << ")";
  chosen.description = text.str();
  return chosen;
}

Light ToData(const Light& light, vtkVolume* volume)
{
  const glm::dmat4 worldToData = glm::inverse(DataToWorld(volume));
  Light result = light;
  result.position = TransformPoint(worldToData, light.position);
  result.focalPoint = TransformPoint(worldToData, light.focalPoint);
  return result;
}

ChosenLight StrongestLight(vtkRenderer* renderer)
{
  vtkLightCollection* lights = renderer->GetLights();
  vtkLight* strongest = nullptr;
  int number = 0;
  vtkCollectionSimpleIterator position;
  lights->InitTraversal(position);
  for (int i = 1; vtkLight* light = lights->GetNextLight(position); ++i)
  {
    const double strength = light->GetSwitch() ? StrengthOf(light) : 0.0;
    if (strength > (strongest ? StrengthOf(strongest) : 0.0))
    {
      strongest = light;
      number = i;
    }
  }

  ChosenLight chosen;
  if (!strongest)
  {
    return chosen;
  }
  double from[3];
  double to[3];
  strongest->GetTransformedPosition(from);
  strongest->GetTransformedFocalPoint(to);
  chosen.found = true;
  chosen.movesWithCamera = !strongest->LightTypeIsSceneLight();
  chosen.light.type = strongest->GetPositional() ? LightType::Point : LightType::Directional;
  chosen.light.position = ToVec3(from);
  chosen.light.focalPoint = ToVec3(to);
  chosen.description = Describe(strongest, number, lights->GetNumberOfItems());
  return chosen;
}
}
