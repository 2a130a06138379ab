# SPDX-FileCopyrightText: Copyright (c) Limpid developers
# SPDX-License-Identifier: BSD-3-Clause

# trace generated using paraview version 5.11.0
#import paraview
#paraview.compatibility.major = 5
#paraview.compatibility.minor = 11

#### import the simple module from the paraview
from paraview.simple import *
#### disable automatic camera reset on 'Show'
paraview.simple._DisableFirstRenderCameraReset()

# Create a new 'Render View'
renderView1 = CreateView('RenderView')
renderView1.AxesGrid = 'GridAxes3DActor'
renderView1.StereoType = 0
renderView1.CameraFocalDisk = 1.0

# Properties modified on renderView1
renderView1.ViewSize = [160, 160]
renderView1.OrientationAxesVisibility = 0
renderView1.UseFXAA = 0

# create a new 'Occlusion Phantom'
occlusionPhantom1 = OcclusionPhantom(registrationName='OcclusionPhantom1')
occlusionPhantom1.Resolution = 32

# show data in view
occlusionPhantom1Display = Show(occlusionPhantom1, renderView1, 'UniformGridRepresentation')

# trace defaults for the display properties.
occlusionPhantom1Display.Representation = 'Outline'
occlusionPhantom1Display.ColorArrayName = ['POINTS', '']
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
occlusionPhantom1Display.ScalarOpacityUnitDistance = 0.11174521339154046
occlusionPhantom1Display.OpacityArrayName = ['POINTS', 'Scalars']
occlusionPhantom1Display.ColorArray2Name = ['POINTS', 'Scalars']
occlusionPhantom1Display.IsosurfaceValues = [0.5]
occlusionPhantom1Display.SliceFunction = 'Plane'
occlusionPhantom1Display.Slice = 15
occlusionPhantom1Display.SelectInputVectors = [None, '']
occlusionPhantom1Display.WriteLog = ''
occlusionPhantom1Display.ImportanceFunction = 'PiecewiseFunction'

# change representation type
occlusionPhantom1Display.SetRepresentationType('Optimized Volume')

# Properties modified on occlusionPhantom1Display
occlusionPhantom1Display.ImportanceArray = ['POINTS', '(Color Array)']
occlusionPhantom1Display.UseImportanceFunction = 1
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

# get color transfer function/color map for 'Scalars'
scalarsLUT = GetColorTransferFunction('Scalars')

# get opacity transfer function/opacity map for 'Scalars'
scalarsPWF = GetOpacityTransferFunction('Scalars')

# get 2D transfer function for 'Scalars'
scalarsTF2D = GetTransferFunction2D('Scalars')

# Properties modified on occlusionPhantom1Display.ImportanceFunction
occlusionPhantom1Display.ImportanceFunction.Points = [0.0, 0.0, 0.5, 0.0, 0.7, 0.0, 0.5, 0.0, 1.0, 1.0, 0.5, 0.0]

#================================================================
# addendum: following script captures some of the application
# state to faithfully reproduce the visualization during playback
#================================================================

#-----------------------------------
# saving camera placements for views

# current camera placement for renderView1
renderView1.CameraPosition = [-3.0, 3.5, -2.2]
renderView1.CameraViewUp = [0.0, 0.0, 1.0]

#--------------------------------------------
# uncomment the following to render all views
# RenderAllViews()
# alternatively, if you want to write images, you can use SaveScreenshot(...).