# SPDX-FileCopyrightText: Copyright (c) Limpid developers
# SPDX-License-Identifier: BSD-3-Clause

# state file generated using paraview version 5.11.0
import paraview
paraview.compatibility.major = 5
paraview.compatibility.minor = 11

#### import the simple module from the paraview
from paraview.simple import *
#### disable automatic camera reset on 'Show'
paraview.simple._DisableFirstRenderCameraReset()

# ----------------------------------------------------------------
# setup views used in the visualization
# ----------------------------------------------------------------

# Create a new 'Render View'
renderView1 = CreateView('RenderView')
renderView1.ViewSize = [160, 160]
renderView1.AxesGrid = 'GridAxes3DActor'
renderView1.OrientationAxesVisibility = 0
renderView1.StereoType = 0
renderView1.CameraPosition = [1.9, -4.7, 1.5]
renderView1.CameraViewUp = [0.0, 0.0, 1.0]
renderView1.CameraFocalDisk = 1.0
renderView1.UseColorPaletteForBackground = 0
renderView1.Background = [0.1, 0.2, 0.3]

# Create a new 'Render View'
renderView2 = CreateView('RenderView')
renderView2.ViewSize = [160, 160]
renderView2.AxesGrid = 'GridAxes3DActor'
renderView2.OrientationAxesVisibility = 0
renderView2.StereoType = 0
renderView2.CameraPosition = [0.5, -2.0, 4.8]
renderView2.CameraViewUp = [0.0, 0.0, 1.0]
renderView2.CameraFocalDisk = 1.0
renderView2.UseColorPaletteForBackground = 0
renderView2.Background = [0.1, 0.2, 0.3]

SetActiveView(None)

# ----------------------------------------------------------------
# restore active view
SetActiveView(renderView2)
# ----------------------------------------------------------------

# ----------------------------------------------------------------
# setup the data processing pipelines
# ----------------------------------------------------------------

# create a new 'Occlusion Phantom'
occlusionPhantom1 = OcclusionPhantom(registrationName='OcclusionPhantom1')
occlusionPhantom1.Resolution = 32

# create a new 'Occlusion Phantom'
occlusionPhantom2 = OcclusionPhantom(registrationName='OcclusionPhantom2')
occlusionPhantom2.Scene = 'Shells'
occlusionPhantom2.Resolution = 24

# ----------------------------------------------------------------
# setup the visualization in view 'renderView1'
# ----------------------------------------------------------------

# show data from occlusionPhantom1
occlusionPhantom1Display = Show(occlusionPhantom1, renderView1, 'UniformGridRepresentation')

# get 2D transfer function for 'Scalars'
scalarsTF2D = GetTransferFunction2D('Scalars')
scalarsTF2D.ScalarRangeInitialized = 1

# get color transfer function/color map for 'Scalars'
scalarsLUT = GetColorTransferFunction('Scalars')
scalarsLUT.TransferFunction2D = scalarsTF2D
scalarsLUT.RGBPoints = [0.0, 0.2, 0.15, 0.2, 0.15, 0.75, 0.5, 0.55, 0.4, 0.87, 0.66, 0.53, 0.65, 0.95, 0.92, 0.8, 0.75, 0.8, 0.2, 0.15, 0.85, 0.75, 0.05, 0.1, 0.93, 0.3, 0.7, 0.3, 1.0, 0.1, 0.8, 0.35]
scalarsLUT.ColorSpace = 'RGB'
scalarsLUT.ScalarRangeInitialized = 1.0

# get opacity transfer function/opacity map for 'Scalars'
scalarsPWF = GetOpacityTransferFunction('Scalars')
scalarsPWF.Points = [0.0, 0.0, 0.5, 0.0, 0.05, 0.0, 0.5, 0.0, 0.15, 0.25, 0.5, 0.0, 1.0, 0.6, 0.5, 0.0]
scalarsPWF.ScalarRangeInitialized = 1

# trace defaults for the display properties.
occlusionPhantom1Display.Representation = 'Optimized Volume'
occlusionPhantom1Display.ColorArrayName = ['POINTS', 'Scalars']
occlusionPhantom1Display.LookupTable = scalarsLUT
occlusionPhantom1Display.SelectTCoordArray = 'None'
occlusionPhantom1Display.SelectNormalArray = 'None'
occlusionPhantom1Display.SelectTangentArray = 'None'
occlusionPhantom1Display.OSPRayScaleArray = 'Scalars'
occlusionPhantom1Display.OSPRayScaleFunction = 'PiecewiseFunction'
occlusionPhantom1Display.SelectOrientationVectors = 'None'
occlusionPhantom1Display.ScaleFactor = 0.2
occlusionPhantom1Display.SelectScaleArray = 'Scalars'
occlusionPhantom1Display.GlyphType = 'Arrow'
occlusionPhantom1Display.GlyphTableIndexArray = 'Scalars'
occlusionPhantom1Display.GaussianRadius = 0.01
occlusionPhantom1Display.SetScaleArray = ['POINTS', 'Scalars']
occlusionPhantom1Display.ScaleTransferFunction = 'PiecewiseFunction'
occlusionPhantom1Display.OpacityArray = ['POINTS', 'Scalars']
occlusionPhantom1Display.OpacityTransferFunction = 'PiecewiseFunction'
occlusionPhantom1Display.DataAxesGrid = 'GridAxesRepresentation'
occlusionPhantom1Display.PolarAxes = 'PolarAxesRepresentation'
occlusionPhantom1Display.ScalarOpacityUnitDistance = 0.1
occlusionPhantom1Display.ScalarOpacityFunction = scalarsPWF
occlusionPhantom1Display.TransferFunction2D = scalarsTF2D
occlusionPhantom1Display.OpacityArrayName = ['POINTS', 'Scalars']
occlusionPhantom1Display.ColorArray2Name = ['POINTS', 'Scalars']
occlusionPhantom1Display.IsosurfaceValues = [0.5]
occlusionPhantom1Display.SliceFunction = 'Plane'
occlusionPhantom1Display.Slice = 15
occlusionPhantom1Display.SelectInputVectors = [None, '']
occlusionPhantom1Display.WriteLog = ''
occlusionPhantom1Display.ImportanceArray = ['POINTS', '(Color Array)']
occlusionPhantom1Display.UseImportanceFunction = 1
occlusionPhantom1Display.ImportanceFunction = 'PiecewiseFunction'
occlusionPhantom1Display.ViewWeight = 6.0
occlusionPhantom1Display.LightWeight = 2.0
occlusionPhantom1Display.RegularizationWeight = 0.002
occlusionPhantom1Display.Mode = 'Separate'
occlusionPhantom1Display.RestrictToView = 0
occlusionPhantom1Display.ShowScore = 0
occlusionPhantom1Display.LightSource = 'Own'
occlusionPhantom1Display.LightType = 'Directional'
occlusionPhantom1Display.LightPosition = [-3.0, -2.0, 4.0]
occlusionPhantom1Display.LightIntensity = 1.2
occlusionPhantom1Display.ShadowStrength = 0.9
occlusionPhantom1Display.VolumeAmbient = 0.2
occlusionPhantom1Display.VolumeSpecular = 3.0
occlusionPhantom1Display.VolumeSpecularPower = 30.0
occlusionPhantom1Display.ScatteringAnisotropy = 0.3
occlusionPhantom1Display.MaximumIterations = 5
occlusionPhantom1Display.Tolerance = 0.002
occlusionPhantom1Display.RayDensity = 1.2
occlusionPhantom1Display.SampleDistance = 0.7
occlusionPhantom1Display.Jitter = 1
occlusionPhantom1Display.AdaptiveQuality = 0
occlusionPhantom1Display.InteractiveFrameTime = 0.2
occlusionPhantom1Display.EaseTime = 0.1

# init the 'PiecewiseFunction' selected for 'ImportanceFunction'
occlusionPhantom1Display.ImportanceFunction.Points = [0.0, 0.0, 0.5, 0.0, 0.7, 0.0, 0.5, 0.0, 1.0, 1.0, 0.5, 0.0]

# show data from occlusionPhantom2
occlusionPhantom2Display = Show(occlusionPhantom2, renderView1, 'UniformGridRepresentation')

# trace defaults for the display properties.
occlusionPhantom2Display.Representation = 'Optimized Volume'
occlusionPhantom2Display.ColorArrayName = ['POINTS', 'Scalars']
occlusionPhantom2Display.LookupTable = scalarsLUT
occlusionPhantom2Display.SelectTCoordArray = 'None'
occlusionPhantom2Display.SelectNormalArray = 'None'
occlusionPhantom2Display.SelectTangentArray = 'None'
occlusionPhantom2Display.Position = [0.5, 2.5, 0.3]
occlusionPhantom2Display.OSPRayScaleArray = 'Scalars'
occlusionPhantom2Display.OSPRayScaleFunction = 'PiecewiseFunction'
occlusionPhantom2Display.SelectOrientationVectors = 'None'
occlusionPhantom2Display.ScaleFactor = 0.2
occlusionPhantom2Display.SelectScaleArray = 'Scalars'
occlusionPhantom2Display.GlyphType = 'Arrow'
occlusionPhantom2Display.GlyphTableIndexArray = 'Scalars'
occlusionPhantom2Display.GaussianRadius = 0.01
occlusionPhantom2Display.SetScaleArray = ['POINTS', 'Scalars']
occlusionPhantom2Display.ScaleTransferFunction = 'PiecewiseFunction'
occlusionPhantom2Display.OpacityArray = ['POINTS', 'Scalars']
occlusionPhantom2Display.OpacityTransferFunction = 'PiecewiseFunction'
occlusionPhantom2Display.DataAxesGrid = 'GridAxesRepresentation'
occlusionPhantom2Display.PolarAxes = 'PolarAxesRepresentation'
occlusionPhantom2Display.ScalarOpacityUnitDistance = 0.1
occlusionPhantom2Display.ScalarOpacityFunction = scalarsPWF
occlusionPhantom2Display.TransferFunction2D = scalarsTF2D
occlusionPhantom2Display.OpacityArrayName = ['POINTS', 'Scalars']
occlusionPhantom2Display.ColorArray2Name = ['POINTS', 'Scalars']
occlusionPhantom2Display.IsosurfaceValues = [0.5]
occlusionPhantom2Display.SliceFunction = 'Plane'
occlusionPhantom2Display.Slice = 11
occlusionPhantom2Display.SelectInputVectors = [None, '']
occlusionPhantom2Display.WriteLog = ''
occlusionPhantom2Display.ImportanceFunction = 'PiecewiseFunction'
occlusionPhantom2Display.Shadows = 0
occlusionPhantom2Display.ShowScore = 0

# init the 'PolarAxesRepresentation' selected for 'PolarAxes'
occlusionPhantom2Display.PolarAxes.Translation = [0.5, 2.5, 0.3]

# ----------------------------------------------------------------
# setup the visualization in view 'renderView2'
# ----------------------------------------------------------------

# show data from occlusionPhantom1
occlusionPhantom1Display_1 = Show(occlusionPhantom1, renderView2, 'UniformGridRepresentation')

# trace defaults for the display properties.
occlusionPhantom1Display_1.Representation = 'Optimized Volume'
occlusionPhantom1Display_1.ColorArrayName = ['POINTS', 'Scalars']
occlusionPhantom1Display_1.LookupTable = scalarsLUT
occlusionPhantom1Display_1.SelectTCoordArray = 'None'
occlusionPhantom1Display_1.SelectNormalArray = 'None'
occlusionPhantom1Display_1.SelectTangentArray = 'None'
occlusionPhantom1Display_1.OSPRayScaleArray = 'Scalars'
occlusionPhantom1Display_1.OSPRayScaleFunction = 'PiecewiseFunction'
occlusionPhantom1Display_1.SelectOrientationVectors = 'None'
occlusionPhantom1Display_1.ScaleFactor = 0.2
occlusionPhantom1Display_1.SelectScaleArray = 'Scalars'
occlusionPhantom1Display_1.GlyphType = 'Arrow'
occlusionPhantom1Display_1.GlyphTableIndexArray = 'Scalars'
occlusionPhantom1Display_1.GaussianRadius = 0.01
occlusionPhantom1Display_1.SetScaleArray = ['POINTS', 'Scalars']
occlusionPhantom1Display_1.ScaleTransferFunction = 'PiecewiseFunction'
occlusionPhantom1Display_1.OpacityArray = ['POINTS', 'Scalars']
occlusionPhantom1Display_1.OpacityTransferFunction = 'PiecewiseFunction'
occlusionPhantom1Display_1.DataAxesGrid = 'GridAxesRepresentation'
occlusionPhantom1Display_1.PolarAxes = 'PolarAxesRepresentation'
occlusionPhantom1Display_1.ScalarOpacityUnitDistance = 0.1
occlusionPhantom1Display_1.ScalarOpacityFunction = scalarsPWF
occlusionPhantom1Display_1.TransferFunction2D = scalarsTF2D
occlusionPhantom1Display_1.OpacityArrayName = ['POINTS', 'Scalars']
occlusionPhantom1Display_1.ColorArray2Name = ['POINTS', 'Scalars']
occlusionPhantom1Display_1.IsosurfaceValues = [0.5]
occlusionPhantom1Display_1.SliceFunction = 'Plane'
occlusionPhantom1Display_1.Slice = 15
occlusionPhantom1Display_1.SelectInputVectors = [None, '']
occlusionPhantom1Display_1.WriteLog = ''
occlusionPhantom1Display_1.ImportanceFunction = 'PiecewiseFunction'
occlusionPhantom1Display_1.Method = 'Ordinary'
occlusionPhantom1Display_1.ShowScore = 0

# ----------------------------------------------------------------
# setup color maps and opacity mapes used in the visualization
# note: the Get..() functions create a new object, if needed
# ----------------------------------------------------------------

# ----------------------------------------------------------------
# restore active source
SetActiveSource(occlusionPhantom2)
# ----------------------------------------------------------------