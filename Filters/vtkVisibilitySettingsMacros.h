// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

// Choices and methods for owners of a vtkVisibilitySettings. VTK's wrappers expand these macros, so
// that Python and ParaView know the methods, too.

#ifndef vtkVisibilitySettingsMacros_h
#define vtkVisibilitySettingsMacros_h

#include "vtkLimpidFiltersModule.h" // for export macro
#include "vtkWrappingHints.h"       // for VTK_SIZEHINT

class vtkObject;

/// The enumerations of vtkVisibilitySettings.
#define LIMPID_VISIBILITY_CHOICES()                                                                \
  enum LightTypes                                                                                  \
  {                                                                                                \
    POINT = 0,                                                                                     \
    DIRECTIONAL = 1                                                                                \
  };                                                                                               \
  enum Methods                                                                                     \
  {                                                                                                \
    OPTIMIZED = 0,                                                                                 \
    ORDINARY = 1,                                                                                  \
    VIOLA_2004 = 2,                                                                                \
    MARCHESIN_2010 = 3,                                                                            \
    AMENT_2017 = 4                                                                                 \
  };                                                                                               \
  enum Modes                                                                                       \
  {                                                                                                \
    JOINT = 0,                                                                                     \
    SEPARATE = 1                                                                                   \
  };                                                                                               \
  enum ViewKinds                                                                                   \
  {                                                                                                \
    SINGLE_VIEW = 0,                                                                               \
    STEREO_PAIR = 1,                                                                               \
    ORBIT = 2                                                                                      \
  };                                                                                               \
  enum Solvers                                                                                     \
  {                                                                                                \
    POLICY = 0,                                                                                    \
    ADAM = 1                                                                                       \
  };                                                                                               \
  enum ImportanceSmoothings                                                                        \
  {                                                                                                \
    AS_GIVEN = 0,                                                                                  \
    MEDIAN = 1                                                                                     \
  };                                                                                               \
  enum Derivatives                                                                                 \
  {                                                                                                \
    VOLUME = 0,                                                                                    \
    RAY = 1                                                                                        \
  };                                                                                               \
  enum Backends                                                                                    \
  {                                                                                                \
    AUTO = 0,                                                                                      \
    CPU = 1,                                                                                       \
    CUDA = 2                                                                                       \
  }

#ifndef __VTK_WRAP__ // wrappers need only the macros
namespace limpid
{
/// Returns the value of a property clamped to [least, most], with a warning if it was outside. NaN
/// is returned unchanged.
VTKLIMPIDFILTERS_EXPORT double Clamped(
  vtkObject* owner, const char* property, double value, double least, double most);
}
#endif

/// Defines SetName, which clamps values to [least, most] with a warning, and the getters of this
/// range. NaN is kept; the computation that uses it reports an error.
#define LIMPID_SET_CLAMPED(name, type, least, most)                                                \
  virtual void Set##name(type value)                                                               \
  {                                                                                                \
    const type nearest = static_cast<type>(limpid::Clamped(this, #name, value, least, most));      \
    if (!(nearest == this->name))                                                                  \
    {                                                                                              \
      this->name = nearest;                                                                        \
      this->Modified();                                                                            \
    }                                                                                              \
  }                                                                                                \
  virtual type Get##name##MinValue()                                                               \
  {                                                                                                \
    return least;                                                                                  \
  }                                                                                                \
  virtual type Get##name##MaxValue()                                                               \
  {                                                                                                \
    return most;                                                                                   \
  }

/// Defines the methods of vtkSetVector2Macro, with values clamped as by LIMPID_SET_CLAMPED.
#define LIMPID_SET_CLAMPED_VECTOR2(name, type, least, most)                                        \
  virtual void Set##name(type first, type second)                                                  \
  {                                                                                                \
    const type nearest[2] = { static_cast<type>(limpid::Clamped(this, #name, first, least, most)), \
      static_cast<type>(limpid::Clamped(this, #name, second, least, most)) };                      \
    if (!(nearest[0] == this->name[0] && nearest[1] == this->name[1]))                             \
    {                                                                                              \
      this->name[0] = nearest[0];                                                                  \
      this->name[1] = nearest[1];                                                                  \
      this->Modified();                                                                            \
    }                                                                                              \
  }                                                                                                \
  virtual void Set##name(const type value[2])                                                      \
  {                                                                                                \
    this->Set##name(value[0], value[1]);                                                           \
  }

/// Defines SetName and GetName of an owner with the method GetVisibilitySettings.
#define LIMPID_FORWARD_SETTING(name, type)                                                         \
  virtual void Set##name(type value)                                                               \
  {                                                                                                \
    this->GetVisibilitySettings()->Set##name(value);                                               \
  }                                                                                                \
  virtual type Get##name()                                                                         \
  {                                                                                                \
    return this->GetVisibilitySettings()->Get##name();                                             \
  }

/// Like LIMPID_FORWARD_SETTING, for switches: also defines NameOn and NameOff.
#define LIMPID_FORWARD_SWITCH(name)                                                                \
  LIMPID_FORWARD_SETTING(name, vtkTypeBool)                                                        \
  virtual void name##On()                                                                          \
  {                                                                                                \
    this->Set##name(1);                                                                            \
  }                                                                                                \
  virtual void name##Off()                                                                         \
  {                                                                                                \
    this->Set##name(0);                                                                            \
  }

/// Defines the methods of vtkSetVector3Macro and vtkGetVector3Macro.
#define LIMPID_FORWARD_VECTOR3(name, type)                                                         \
  virtual void Set##name(type x, type y, type z)                                                   \
  {                                                                                                \
    this->GetVisibilitySettings()->Set##name(x, y, z);                                             \
  }                                                                                                \
  virtual void Set##name(const type value[3])                                                      \
  {                                                                                                \
    this->GetVisibilitySettings()->Set##name(value);                                               \
  }                                                                                                \
  virtual type* Get##name() VTK_SIZEHINT(3)                                                        \
  {                                                                                                \
    return this->GetVisibilitySettings()->Get##name();                                             \
  }                                                                                                \
  virtual void Get##name(type& x, type& y, type& z)                                                \
  {                                                                                                \
    this->GetVisibilitySettings()->Get##name(x, y, z);                                             \
  }                                                                                                \
  virtual void Get##name(type value[3])                                                            \
  {                                                                                                \
    this->GetVisibilitySettings()->Get##name(value);                                               \
  }

/// Defines the methods of vtkVisibilitySettings, which documents them.
#define LIMPID_FORWARD_VISIBILITY_SETTINGS()                                                       \
  LIMPID_FORWARD_SETTING(ScalarComponent, int)                                                     \
  LIMPID_FORWARD_SETTING(ImportanceComponent, int)                                                 \
  LIMPID_FORWARD_SWITCH(UseImportanceFunction)                                                     \
  LIMPID_FORWARD_SETTING(ImportanceFunction, vtkPiecewiseFunction*)                                \
  LIMPID_FORWARD_SETTING(Method, int)                                                              \
  LIMPID_FORWARD_SETTING(AmentExponent, double)                                                    \
  LIMPID_FORWARD_SETTING(AmentRegularization, double)                                              \
  LIMPID_FORWARD_SETTING(AmentOccluders, double)                                                   \
  LIMPID_FORWARD_SETTING(AmentBackground, double)                                                  \
  LIMPID_FORWARD_SETTING(AmentLightOccluders, double)                                              \
  LIMPID_FORWARD_SETTING(AmentLightBackground, double)                                             \
  LIMPID_FORWARD_SETTING(AmentSmoothing, int)                                                      \
  LIMPID_FORWARD_SETTING(ClearingThreshold, double)                                                \
  LIMPID_FORWARD_SETTING(RegularizationWeight, double)                                             \
  LIMPID_FORWARD_SETTING(ViewWeight, double)                                                       \
  LIMPID_FORWARD_SETTING(LightWeight, double)                                                      \
  LIMPID_FORWARD_SETTING(LightType, int)                                                           \
  LIMPID_FORWARD_VECTOR3(LightPosition, double)                                                    \
  LIMPID_FORWARD_SETTING(Mode, int)                                                                \
  LIMPID_FORWARD_SETTING(Solver, int)                                                              \
  LIMPID_FORWARD_SETTING(MaximumIterations, int)                                                   \
  LIMPID_FORWARD_VECTOR3(IterationsPerLevel, int)                                                  \
  LIMPID_FORWARD_SETTING(LearningRate, double)                                                     \
  LIMPID_FORWARD_SETTING(Tolerance, double)                                                        \
  LIMPID_FORWARD_SETTING(MaximumSeconds, double)                                                   \
  LIMPID_FORWARD_SETTING(Derivative, int)                                                          \
  LIMPID_FORWARD_SETTING(RayDensity, double)                                                       \
  LIMPID_FORWARD_SWITCH(SkipUnneeded)                                                              \
  LIMPID_FORWARD_SWITCH(RestrictToView)                                                            \
  LIMPID_FORWARD_SETTING(Views, int)                                                               \
  LIMPID_FORWARD_SETTING(NumberOfViews, int)                                                       \
  LIMPID_FORWARD_SETTING(EyeAngle, double)                                                         \
  LIMPID_FORWARD_SETTING(ProtectImportance, double)                                                \
  LIMPID_FORWARD_SETTING(Emphasis, double)                                                         \
  LIMPID_FORWARD_SETTING(ImportanceSmoothing, int)                                                 \
  LIMPID_FORWARD_SETTING(Smoothness, double)                                                       \
  LIMPID_FORWARD_SETTING(TemporalCoherence, double)                                                \
  LIMPID_FORWARD_SETTING(Backend, int)                                                             \
  static_assert(true, "takes a semicolon")

#endif
