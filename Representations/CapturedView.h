// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef limpid_CapturedView_h
#define limpid_CapturedView_h

#include "vtkPVView.h"

namespace limpid
{
/// Reads a protected state of views; no object of this type is ever created.
struct CaptureState : public vtkPVView
{
  static bool Of(vtkPVView* view) { return (view->*(&CaptureState::GetInCaptureScreenshot))(); }
};

/// Returns whether the present picture of a view is going to be saved.
inline bool IsCaptured(vtkPVView* view)
{
  return CaptureState::Of(view);
}
}

#endif
