// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#include "SceneLight.h"

#include "vtkCollection.h"
#include "vtkLight.h"
#include "vtkLightCollection.h"
#include "vtkRenderer.h"

#include <algorithm>
#include <sstream>

namespace limpid
{
namespace
{
// Luminance of the diffuse colour (Rec. 709) times the intensity.
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
       << light->GetIntensity() << (cone ? ", shining to all sides (its cone is not drawn)" : "");
  return text.str();
}
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
  chosen.light.type = strongest->GetPositional() ? LightType::Point : LightType::Directional;
  chosen.light.position = Vec3(from[0], from[1], from[2]);
  chosen.light.focalPoint = Vec3(to[0], to[1], to[2]);
  const double* color = strongest->GetDiffuseColor();
  const double largest = std::max({ color[0], color[1], color[2] });
  for (std::size_t channel = 0; channel < 3; ++channel)
  {
    chosen.color[channel] = static_cast<float>(std::max(color[channel] / largest, 0.0));
  }
  chosen.description = Describe(strongest, number, lights->GetNumberOfItems());
  return chosen;
}
}
