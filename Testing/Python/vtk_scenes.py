# SPDX-FileCopyrightText: Copyright (c) Limpid developers
# SPDX-License-Identifier: BSD-3-Clause

"""The scenes of VTK's tests of its volume mappers, set for any mapper: those of
Rendering/Volume/Testing, and of depth peeling in Rendering/VolumeOpenGL2/Testing.

A scene is named after VTK's test and yields its pictures. Everything is interpolated linearly and
not shaded, whatever the test has. The scenes of tests that read a file of VTK's have the wavelet
instead; volumes of 256 points per axis have 64 in the same box.
"""

import numpy as np
from vtkmodules.vtkCommonCore import vtkDoubleArray
from vtkmodules.vtkCommonDataModel import (vtkDataSetAttributes, vtkImageData, vtkPlane,
                                           vtkRectilinearGrid, vtkUniformGrid)
from vtkmodules.vtkCommonTransforms import vtkTransform
from vtkmodules.vtkFiltersCore import vtkPointDataToCellData
from vtkmodules.vtkFiltersModeling import vtkOutlineFilter
from vtkmodules.vtkFiltersSources import vtkPlaneSource, vtkSphereSource
from vtkmodules.vtkImagingCore import vtkRTAnalyticSource
from vtkmodules.vtkRenderingCore import (vtkActor, vtkPolyDataMapper, vtkRenderer,
                                         vtkRenderWindow, vtkVolume)
from vtkmodules.vtkRenderingVolume import vtkGPUVolumeRayCastMapper
from vtkmodules.util.numpy_support import vtk_to_numpy

from limpid.vtkLimpidRendering import vtkTransmittanceVolumeMapper

from volume_views import (View, colors_of, gpu_mapper, image_of, opacity_of, plain_mapper,
                          property_of)

GREEN = (0.1, 0.4, 0.2)  # the background of many of VTK's tests

SCENES = {}  # name: scene, how many samples to take for each one of the test, why it differs


def scene(finer=1, differs=""):
    def register(function):
        SCENES["Test" + function.__name__] = (function, finer, differs)
        return function
    return register


BETWEEN_POINTS = "Limpid cuts a cropping region that is not a box between points, VTK within a cell."


class Stage:
    """A view, and mappers of one kind in it: VTK's, or ours without light and optimization."""

    def __init__(self, ours, finer=1):
        """`finer`: so many samples for each one that the test has."""
        self.ours = ours
        self.finer = finer
        self.mappers = []
        self.volumes = []

    def view(self, size=(300, 300), background=(0, 0, 0)):
        self.stage = View(size)
        self.stage.renderer.SetBackground(*background)
        return self.stage

    def make(self, image, step):
        """`step`: between samples, as long as VTK has it."""
        step /= self.finer
        return plain_mapper(step / min(image.GetSpacing())) if self.ours else gpu_mapper(step)

    def add(self, image, volume_property, step=None, renderer=None, **settings):
        """A volume; `settings`: methods of VTK's mapper without Set, and their argument."""
        spacing = min(image.GetSpacing()) if image.IsA("vtkImageData") else 1
        mapper = (self.make(image, step or 0.5 * spacing) if image.IsA("vtkImageData")
                  else (vtkTransmittanceVolumeMapper if self.ours else vtkGPUVolumeRayCastMapper)())
        self.mappers.append(mapper)
        for name, value in settings.items():
            getattr(mapper, "Set" + name)(value)
        for component in range(4):
            volume_property.ShadeOff(component)
        volume_property.SetInterpolationTypeToLinear()
        mapper.SetInputDataObject(image)
        volume = vtkVolume()
        volume.SetMapper(mapper)
        volume.SetProperty(volume_property)
        (renderer or self.stage.renderer).AddVolume(volume)
        self.volumes.append(volume)
        return volume

    def picture(self):
        return self.stage.picture()


# What VTK's tests show.

def wavelet(low, high, rate=1):
    source = vtkRTAnalyticSource()
    source.SetWholeExtent(*3 * (low, high))
    source.SetCenter(0, 0, 0)
    source.SetSubsampleRate(rate)
    source.Update()
    return source.GetOutput()


def large_wavelet():
    return wavelet(-127, 128, 4)


def wavelet_property(opacity, unit_distance=1):
    return property_of(
        colors_of((37.3531, 0.2, 0.29, 1), (157.091, 0.87, 0.87, 0.87),
                  (276.829, 0.7, 0.015, 0.15)),
        opacity_of((37.3531, 0), (276.829, opacity)), unit_distance)


def ramp_property(image):
    low, high = image.GetScalarRange()
    return property_of(colors_of((low, 0.1, 0.5, 1), (high, 1, 0.5, 0.1)),
                       opacity_of((low, 0), (high, 1)), 1)


def squared_radius(top=1, kind=np.uint8):
    """Of 127 points per axis in a box from -top to top; 85 at the middles of its faces."""
    axis = np.linspace(-1, 1, 127) ** 2
    values = 85 * (axis[:, None, None] + axis[:, None] + axis)
    return image_of((127, 127, 127), 3 * (top / 63,), 3 * (-top,),
                    values=values.ravel().astype(kind))


def shell_property():
    return property_of(colors_of((0, 0, 0, 1), (40, 1, 0, 0), (255, 1, 1, 1)), shell(), 1)


def shell():
    return opacity_of((0, 0), (80, 1), (80.1, 0), (255, 0))


def step():
    return opacity_of((0, 0), (200, 0.5), (200.1, 1), (255, 1))


def points_of(count):
    """Indices z, y, x of a cube of so many points per axis."""
    return np.indices(3 * (count,))


def halves(*components):
    """100 points per axis; each component: its values below and above the middle of x."""
    right = points_of(100)[2].ravel() >= 50
    return image_of((100, 100, 100), s=np.stack([np.where(right, high, low)
                                                 for low, high in components], axis=1))


def three_spheres():
    z, y, x = points_of(100)
    inside = [(x - a) ** 2 + (y - b) ** 2 + (z - 50) ** 2 <= 33 ** 2
              for a, b in ((33, 50), (66, 50), (50, 33))]
    return image_of((100, 100, 100),
                    s=np.stack([0.33 * each.ravel() for each in inside], axis=1))


def independent(*components):
    """Colours and opacities of components: colour and opacity at one."""
    result = property_of(colors_of((0, 0, 0, 0)), opacity_of((0, 0)), 1)
    result.IndependentComponentsOn()
    for i, (color, opacity) in enumerate(components):
        result.SetColor(i, colors_of((0, 0, 0, 0), (1, *color)))
        result.SetScalarOpacity(i, opacity_of((0, 0), (1, opacity)))
    return result


def add_actor(view, source):
    mapper = vtkPolyDataMapper()
    mapper.SetInputConnection(source.GetOutputPort())
    actor = vtkActor()
    actor.SetMapper(mapper)
    actor.GetProperty().SetAmbient(1)
    actor.GetProperty().SetDiffuse(0)
    view.renderer.AddActor(actor)


def add_plane(mapper, origin, normal):
    plane = vtkPlane()
    plane.SetOrigin(*origin)
    plane.SetNormal(*normal)
    mapper.AddClippingPlane(plane)


def from_many_sides(stage):
    """Instead of what VTK's tests have recorded of a mouse."""
    stage.stage.renderer.ResetCamera()
    yield stage.picture()
    for azimuth, elevation, zoom in ((40, 20, 1.2), (70, -50, 1.3), (80, 10, 2)):
        camera = stage.stage.camera
        camera.Azimuth(azimuth)
        camera.Elevation(elevation)
        camera.OrthogonalizeViewUp()
        camera.Zoom(zoom)
        stage.stage.renderer.ResetCameraClippingRange()
        yield stage.picture()


# What is drawn as VTK draws it. VTK's mapper leaves out the first step of a ray: where its picture
# is another with shorter steps, these are compared.

@scene()
def FixedPointRayCastLightComponents(stage):
    view = stage.view((301, 300), GREEN)
    volume_property = property_of(colors_of((0, 1, 1, 1), (255, 1, 1, 1)),
                                  opacity_of((0, 1), (80, 1), (80.1, 0), (255, 0)), 1)
    stage.add(squared_radius(100), volume_property, 1)
    view.renderer.ResetCamera()
    yield stage.picture()


def squared_radius_scene(stage, image=None, **settings):
    view = stage.view((301, 300), GREEN)
    stage.add(image or squared_radius(), shell_property(), 0.2 / 63, **settings)
    view.renderer.ResetCamera()
    return view


@scene()
def GPURayCastMIPToComposite(stage):
    squared_radius_scene(stage, BlendMode=1)
    stage.volumes[0].GetProperty().SetScalarOpacity(step())
    stage.picture()
    stage.mappers[0].SetBlendModeToComposite()
    stage.volumes[0].GetProperty().SetScalarOpacity(shell())
    yield stage.picture()


@scene()
def GPURayCastPerspectiveParallel(stage):
    view = squared_radius_scene(stage)
    stage.picture()
    view.camera.ParallelProjectionOn()
    yield stage.picture()


@scene()
def SmartVolumeMapper(stage):
    squared_radius_scene(stage)
    yield stage.picture()


@scene()
def GPURayCastComputeNormalFromOpacity(stage):
    view = stage.view((401, 399), (0.4, 0.4, 0.4))
    z, y, x = points_of(100)
    outside = (x - 50) ** 2 + (y - 50) ** 2 + (z - 50) ** 2 > 0.2 * 100 ** 2
    image = image_of((100, 100, 100), 3 * (0.01,), s=outside.ravel().astype(np.float32))
    green = (0.196, 0.659, 0.337)
    stage.add(image, property_of(colors_of((0, *green), (1, *green)), opacity_of((0, 1), (1, 0)),
                                 0.01), 0.001, ComputeNormalFromOpacity=True)
    view.camera.SetPosition(0, 0, 3)
    view.camera.SetFocalPoint(0.5, 0.5, 0.5)
    view.camera.SetViewUp(0, 0, 1)
    view.renderer.ResetCameraClippingRange()
    yield stage.picture()


@scene(finer=10)
def GPUVolumeRayCastMapper(stage):
    stage.view((401, 399), (0.3, 0.3, 0.4))
    stage.add(wavelet(-10, 10), wavelet_property(1, 1.732), 0.5)
    yield from from_many_sides(stage)


@scene()
def GPURayCastMapperBenchmark(stage):
    view = stage.view()
    stage.add(large_wavelet(), wavelet_property(1), 0.5)
    view.renderer.ResetCamera()
    for _ in range(5):
        view.camera.Azimuth(1)
        view.camera.Elevation(1)
        stage.picture()
    view.camera.SetPosition(0, 0, 1)
    view.camera.SetFocalPoint(0, 0, 0)
    view.camera.SetViewUp(0, 1, 0)
    view.renderer.ResetCamera()
    yield stage.picture()


@scene(finer=10)
def GPURayCastMapperSampleDistance(stage):
    view = stage.view()
    stage.add(large_wavelet(), wavelet_property(1), 20)
    view.renderer.ResetCamera()
    yield stage.picture()


@scene(finer=10)
def GPURayCastVolumePlane(stage):
    view = stage.view((300, 301), (0.3, 0.35, 0.45))
    source = vtkRTAnalyticSource()
    source.SetWholeExtent(-49, 50, -49, 50, 0, 1)
    source.SetCenter(0, 0, 0)
    source.Update()
    slab = source.GetOutput()
    slab.SetSpacing(1, 1, 10)
    volume_property = wavelet_property(1)
    volume_property.SetColor(colors_of((37.3531, 0.8, 0.29, 1), (157.091, 0.87, 0.87, 0.87),
                                       (276.829, 0.7, 0.015, 0.15)))
    volume_property.SetScalarOpacity(opacity_of((37.3531, 1), (276.829, 1)))
    plane = vtkPlaneSource()
    plane.SetOrigin(-70, -70, 5)
    plane.SetPoint1(70, -70, 5)
    plane.SetPoint2(-70, 70, 5)
    add_actor(view, plane)
    stage.add(slab, volume_property, 1)
    yield from from_many_sides(stage)


@scene()
def GPURayCastMapperShadows(stage):
    view = stage.view(background=(0.2, 0.2, 0.2))
    z, y, x = 0.01 * points_of(100)
    boxes = np.zeros((100, 100, 100), np.float32)
    for value, low, high in ((1, (0.05, 0.05, 0.05), (0.1, 0.95, 0.95)),
                             (2, (0.6, 0.35, 0.35), (0.9, 0.65, 0.65))):
        boxes[(x >= low[0]) & (x < high[0]) & (y >= low[1]) & (y < high[1]) &
              (z >= low[2]) & (z < high[2])] = value
    volume_property = property_of(
        colors_of((0, 1, 1, 1), (1, 1, 1, 1), (1.8, 1, 0, 0), (2, 1, 0, 0)),
        opacity_of((0, 0), (2, 0.8)), 0.0005)
    stage.add(image_of((100, 100, 100), 3 * (0.01,), s=boxes.ravel()), volume_property, 0.001)
    view.camera.SetPosition(1.85, -1.27, 0.97)
    view.camera.SetFocalPoint(0.498, 0.498, 0.498)
    view.camera.SetViewUp(0, 0, 1)
    view.renderer.ResetCameraClippingRange()
    yield stage.picture()


def gaussian(top, deviation):
    """31 points per axis, none of a value from 150 to 200."""
    axis = (np.arange(31) - 15) ** 2
    squares = axis[:, None, None] + axis[:, None] + axis
    values = top * np.exp(-squares / (2 * deviation ** 2))
    return np.where((values >= 150) & (values <= 200), 0, values).ravel()


def fixed_point(stage, crop=lambda mapper: None):
    """The volumes of this test that are composite, without gradient opacity, of one component."""
    view = stage.view((300, 300))
    rainbow = colors_of()
    rainbow.SetColorSpaceToHSV()
    rainbow.HSVWrapOff()
    rainbow.AddHSVPoint(0, 0.1, 1, 1)
    rainbow.AddHSVPoint(255, 0.9, 1, 1)
    ramp = opacity_of((0, 0), (255, 0.2))
    surface = opacity_of((0, 0), (10, 0), (50, 1), (255, 1))
    for i, kind in enumerate((np.float64, np.uint8)):
        for j, opacity in enumerate((ramp, surface)):
            image = image_of((31, 31, 31), s=gaussian(255, 5).astype(kind))
            volume = stage.add(image, property_of(rainbow, opacity, 1), 0.25)
            crop(volume.GetMapper())
            volume.SetPosition(30 * i, 30 * j, 0)
    view.renderer.ResetCamera()
    view.camera.Dolly(1.3)
    view.camera.Azimuth(15)
    view.camera.Elevation(5)
    view.renderer.ResetCameraClippingRange()


@scene()
def FixedPointRayCasterLinear(stage):
    fixed_point(stage)
    yield stage.picture()


@scene(differs=BETWEEN_POINTS)
def FixedPointRayCasterLinearCropped(stage):
    def crop(mapper):
        mapper.CroppingOn()
        mapper.SetCroppingRegionPlanes(10, 20, 10, 20, 10, 20)
        mapper.SetCroppingRegionFlags(253440)
    fixed_point(stage, crop)
    yield stage.picture()


@scene()
def GPURayCastIndependentVectorMode(stage):
    """VTK's mapper gets the component or the magnitude alone."""
    z, y, x = points_of(20)
    vectors = np.stack([x - 10, 10 * (y - 10), z - 10], axis=-1).reshape(-1, 3).astype(float)
    for component in (0, 1, 2, -1):
        view = stage.view(background=(0.3176, 0.3412, 0.4314))
        field = np.linalg.norm(vectors, axis=1) if component < 0 else vectors[:, component]
        volume_property = property_of(
            colors_of((-100, 0, 0, 1), (0, 0.86, 0.86, 0.86), (100, 1, 0, 0)),
            opacity_of((-100, 0), (0, 0.5), (100, 1)), 1)
        image = image_of((20, 20, 20), s=vectors if stage.ours else field)
        stage.add(image, volume_property, 0.5)
        if stage.ours:
            stage.mappers[-1].SetScalarComponent(component)
        view.camera.Azimuth(30)
        view.renderer.ResetCamera()
        yield stage.picture()


# Parts that are left out.

def clipped(stage):
    view = stage.view((400, 400))
    image = wavelet(-10, 10)
    volume = stage.add(image, ramp_property(image), 0.5)
    add_plane(volume.GetMapper(), (0, 0, 0), (0.8, 0, 0))
    add_plane(volume.GetMapper(), (0, 0, 0), (0.2, -0.2, 0))
    view.camera.Azimuth(-40)
    return volume


@scene(finer=10)
def GPURayCastClipping(stage):
    clipped(stage)
    stage.stage.renderer.ResetCamera()
    yield stage.picture()


@scene()
def GPURayCastClippingUserTransform(stage):
    volume = clipped(stage)
    transform = vtkTransform()
    transform.RotateY(30)
    transform.RotateZ(-25)
    transform.Translate(1.5, 0, 0)
    volume.SetUserTransform(transform)
    stage.stage.renderer.ResetCamera()
    yield stage.picture()


@scene()
def GPURayCastCropping(stage):
    view = stage.view((400, 200), (0.1, 0.2, 0.4))
    axis = np.linspace(-1, 1, 50) ** 2
    radius = np.sqrt(axis[:, None, None] + axis[:, None] + axis)
    ball = image_of((50, 50, 50), s=np.maximum(0, 255 - 200 * radius).astype(np.uint8).ravel())
    volume_property = property_of(
        colors_of((0, 0, 0, 0), (64, 1, 0, 0), (128, 0, 0, 1), (192, 0, 1, 0), (255, 0, 0.2, 0)),
        opacity_of((0, 0), (30, 0), (80, 0.5), (255, 0.5)), 1)
    flags = ("SubVolume", "Cross", "InvertedCross", "Fence", "InvertedFence")
    for i, name in enumerate(flags):
        volume = stage.add(ball, volume_property, 0.25)
        mapper = volume.GetMapper()
        mapper.CroppingOn()
        mapper.SetCroppingRegionPlanes(17, 33, 17, 33, 17, 33)
        getattr(mapper, "SetCroppingRegionFlagsTo" + name)()
        transform = vtkTransform()
        transform.PostMultiply()
        transform.Translate(-25, -25, -25)
        transform.RotateX(90 * i + 20)
        transform.RotateY(20)
        transform.Translate(95 * i, 0, 0)
        volume.SetUserTransform(transform)
    view.renderer.ResetCamera()
    view.camera.Zoom(2.5)
    yield stage.picture()


@scene()
def GPURayCastVolumeGhostArrays(stage):
    yield from blanked(stage, large_wavelet())


@scene()
def GPURayCastVolumeGhostArraysCellData(stage):
    average = vtkPointDataToCellData()
    average.SetInputData(large_wavelet())
    average.Update()
    yield from blanked(stage, average.GetOutput())


def blanked(stage, image):
    """A column of cells with one flag per third, and part of a face of points."""
    flags = vtkDataSetAttributes
    count = image.GetDimensions()[0]
    image.AllocatePointGhostArray()
    image.AllocateCellGhostArray()
    cells = vtk_to_numpy(image.GetCellGhostArray()).reshape(3 * (count - 1,))
    points = vtk_to_numpy(image.GetPointGhostArray()).reshape(3 * (count,))
    half, middle = (count - 1) // 2, np.s_[(count - 1) // 4:3 * (count - 1) // 4]
    third, right = np.s_[(count - 1) // 3:2 * (count - 1) // 3], 3 * count // 4
    cells[:half + 1, middle, third] = flags.HIDDENCELL
    cells[:half, middle, half + 1:third.stop] = flags.DUPLICATECELL
    cells[half + 1:, middle, third] = flags.REFINEDCELL
    points[:half, middle, right:] = flags.HIDDENPOINT
    points[:half, half + 1:middle.stop, right:] = flags.DUPLICATEPOINT

    view = stage.view()
    stage.add(image, wavelet_property(0.03), 1)
    view.camera.SetPosition(0, 0, 0)
    view.camera.SetFocalPoint(-0.1, 0.2, 1)
    view.renderer.ResetCamera()
    yield stage.picture()


@scene()
def GPURayCastVolumeUniformGridBlanking(stage):
    view = stage.view()
    grid = vtkUniformGrid()
    grid.ShallowCopy(large_wavelet())
    count = grid.GetDimensions()[0]
    for k in range((count - 1) // 4):
        for j in range((count - 1) // 4, 3 * (count - 1) // 4):
            for i in range((count - 1) // 3, 2 * (count - 1) // 3):
                grid.BlankCell((k * (count - 1) + j) * (count - 1) + i)
            for i in range(3 * count // 4, count):
                grid.BlankPoint((k * count + j) * count + i)
    stage.add(grid, wavelet_property(0.05), 1)
    view.camera.SetPosition(0, 0, 0)
    view.camera.SetFocalPoint(0, 0.3, 1)
    view.renderer.ResetCamera()
    yield stage.picture()


# Cameras and places.

def inside(stage, image, volume_property, place=lambda volume: None):
    view = stage.view()
    volume = stage.add(image, volume_property)
    place(volume)
    bounds = np.array(volume.GetBounds()).reshape(3, 2)
    middle, size = bounds.mean(1), np.ptp(bounds, axis=1)
    view.camera.SetPosition(*(middle + size * (0.1, 0.2, 0.4)))
    view.camera.SetFocalPoint(*middle)
    view.camera.SetViewAngle(60)
    # VTK's mapper begins 0.2 % of the box's diagonal behind the near plane.
    view.camera.SetClippingRange(0.05 * size.max(), 3 * size.max())
    return volume


@scene(finer=10)
def GPURayCastCameraInside(stage):
    inside(stage, wavelet(-10, 10), wavelet_property(0.3))
    yield stage.picture()


@scene(finer=10)
def GPURayCastCameraInsideClipping(stage):
    volume = inside(stage, wavelet(-10, 10), wavelet_property(0.3))
    add_plane(volume.GetMapper(), (0, 0, 1), (0, 0, -1))
    yield stage.picture()


@scene(finer=10)
def GPURayCastCameraInsideSmallSpacing(stage):
    """VTK's mapper begins 1e-4 behind the near plane at least: its picture is of the same at 1."""
    spacing = 1e-5 if stage.ours else 1
    image = wavelet(-10, 10)
    image.SetSpacing(spacing, spacing, spacing)
    inside(stage, image, wavelet_property(0.3, spacing))
    yield stage.picture()


@scene(finer=10)
def GPURayCastCameraInsideTransformation(stage):
    def place(volume):
        volume.SetPosition(3, 4, 5)
        volume.RotateY(45)
        volume.RotateZ(-30)
        volume.SetScale(2)
    inside(stage, wavelet(-10, 10), wavelet_property(0.3), place)
    yield stage.picture()


@scene(finer=10)
def GPURayCastCameraInsideNonUniformScaleTransform(stage):
    inside(stage, wavelet(-10, 10), wavelet_property(0.3), lambda volume: volume.SetScale(1, 2, 3))
    yield stage.picture()


def placed(stage, image, place=lambda volume: None, volume_property=None):
    view = stage.view(background=(0.2, 0.2, 0.5))
    volume = stage.add(image, volume_property or wavelet_property(0.3))
    place(volume)
    outline = vtkOutlineFilter()
    outline.SetInputData(image)
    add_actor(view, outline)
    view.camera.Azimuth(30)
    view.camera.Elevation(20)
    view.renderer.ResetCamera()


@scene()
def GPURayCastVolumeScale(stage):
    image = wavelet(-10, 10)
    image.SetSpacing(1, 2, 3)
    image.SetOrigin(10, 20, 30)
    placed(stage, image)
    yield stage.picture()


@scene()
def GPURayCastVolumeRotation(stage):
    def turn(volume):
        volume.RotateY(45)
        volume.RotateZ(-90)
        volume.RotateX(90)
    placed(stage, wavelet(-10, 10), turn)
    yield stage.picture()


@scene()
def GPURayCastVolumeOrientation(stage):
    image = wavelet(-10, 10)
    image.SetDirectionMatrix(0.8, 0.6, 0, -0.6, 0.8, 0, 0, 0, 1)
    placed(stage, image)
    yield stage.picture()


@scene()
def GPURayCastVolumePolyData(stage):
    placed(stage, wavelet(-10, 10))
    sphere = vtkSphereSource()
    sphere.SetCenter(2, 1, 3)
    sphere.SetRadius(5)
    sphere.SetThetaResolution(40)
    sphere.SetPhiResolution(40)
    add_actor(stage.stage, sphere)
    yield stage.picture()


@scene()
def GPURayCastVolumeUpdate(stage):
    image = wavelet(-10, 10)
    placed(stage, image)
    stage.picture()
    image.GetPointData().GetScalars().SetName("another")
    stage.mappers[0].SetInputData(wavelet(-8, 8))
    yield stage.picture()


@scene()
def GPURayCastReleaseResources(stage):
    view = stage.view((250, 200))
    image = wavelet(-10, 10)
    stage.add(image, ramp_property(image))
    view.camera.Azimuth(-40)
    view.renderer.ResetCamera()
    stage.picture()
    view.window.Finalize()
    view.window.RemoveRenderer(view.renderer)
    view.window = vtkRenderWindow()
    view.window.SetOffScreenRendering(1)
    view.window.SetMultiSamples(0)
    view.window.SetSize(150, 200)
    view.window.AddRenderer(view.renderer)
    yield stage.picture()


@scene()
def GPURayCastLargeColorTransferFunction(stage):
    image = wavelet(-10, 10)
    low, high = image.GetScalarRange()
    places = np.linspace(low, high, 1500)
    shades = 0.5 + 0.5 * np.sin(np.linspace(0, 30, 1500))
    volume_property = wavelet_property(0.3)
    volume_property.SetColor(colors_of(*np.stack([places, shades, 1 - shades, 0.5 * shades], 1)))
    placed(stage, image, volume_property=volume_property)
    yield stage.picture()


def apart(stage, make_property):
    view = stage.view()
    image = wavelet(-10, 10)
    for i in range(2):
        stage.add(image, make_property(i)).SetPosition(0, 0, 30 * i)
    view.camera.Azimuth(70)
    view.renderer.ResetCamera()
    view.camera.Zoom(1.5)
    if not stage.ours:
        vtkTransmittanceVolumeMapper.SortBackToFront(view.renderer)


@scene()
def GPURayCastMultiVolumeAddRemove(stage):
    """Two volumes that do not overlap; then one of them alone."""
    apart(stage, lambda i: wavelet_property(0.3 - 0.2 * i))
    yield stage.picture()
    stage.stage.renderer.RemoveVolume(stage.volumes[0])
    yield stage.picture()


# Among translucent surfaces.

def add_ball(renderer, center, radius, color, opacity):
    source = vtkSphereSource()
    source.SetCenter(*center)
    source.SetRadius(radius)
    mapper = vtkPolyDataMapper()
    mapper.SetInputConnection(source.GetOutputPort())
    actor = vtkActor()
    actor.SetMapper(mapper)
    actor.GetProperty().SetColor(*color)
    actor.GetProperty().SetOpacity(opacity)
    renderer.AddActor(actor)


def peel(renderer, peels=17):
    renderer.UseDepthPeelingOn()
    renderer.UseDepthPeelingForVolumesOn()
    renderer.SetMaximumNumberOfPeels(peels)
    renderer.SetOcclusionRatio(0)


def vase(stage, renderer, top, balls, color=3 * (0.6,)):
    """What VTK's tests of depth peeling have in place of a vase: a volume, and two balls in it of
    these opacities."""
    image = wavelet(-32, 32)
    volume = stage.add(image, property_of(colors_of((0, *color)), opacity_of((120, 0), (180, top)),
                                          1), 0.1, renderer)
    for shift, color, opacity in zip((0, 10), ((0.5, 0.9, 0.7), (0.9, 0.4, 0.1)), balls):
        add_ball(renderer, 3 * (shift,), 65 / 3, color, opacity)
    peel(renderer)
    renderer.ResetCamera()
    return volume


def vase_from_the_side(stage, top, *balls):
    renderer = stage.view((400, 400)).renderer
    volume = vase(stage, renderer, top, balls)
    outline = vtkOutlineFilter()
    outline.SetInputData(volume.GetMapper().GetInput())
    add_actor(stage.stage, outline)
    look_from_the_side(renderer)
    return volume


def look_from_the_side(renderer):
    renderer.GetActiveCamera().Azimuth(-55)
    renderer.GetActiveCamera().Elevation(35)
    renderer.GetActiveCamera().OrthogonalizeViewUp()
    renderer.ResetCameraClippingRange()


@scene()
def GPURayCastDepthPeeling(stage):
    vase_from_the_side(stage, 1, 0.3, 0.3)
    yield stage.picture()


@scene()
def GPURayCastDepthPeelingOpaque(stage):
    vase_from_the_side(stage, 1, 0.3, 1)
    yield stage.picture()


@scene()
def GPURayCastDepthPeelingTransparentPolyData(stage):
    vase_from_the_side(stage, 0.05, 0, 0)
    stage.stage.camera.Zoom(2)
    yield stage.picture()


@scene()
def GPURayCastDepthPeelingClip(stage):
    mapper = vase_from_the_side(stage, 1, 0.3, 0.3).GetMapper()
    add_plane(mapper, (-3, 0, 0), (0.8, 0, 0))
    add_plane(mapper, (-3, -10, 0), (0.2, -0.2, 0))
    yield stage.picture()


@scene()
def GPURayCastDepthPeelingTransVol(stage):
    """The same camera for translucent balls, and for one that is wholly transparent."""
    view = stage.view((800, 400), (1, 1, 1))
    right = vtkRenderer()
    right.SetBackground(1, 1, 1)
    right.SetViewport(0.5, 0, 1, 1)
    right.SetActiveCamera(view.camera)
    view.renderer.SetViewport(0, 0, 0.5, 1)
    view.window.AddRenderer(right)
    vase(stage, view.renderer, 0.06, (0.3, 0.3), (0.9, 0.4, 0.9))
    vase(stage, right, 0.06, (0,), (0.9, 0.4, 0.9))
    look_from_the_side(view.renderer)
    yield stage.picture()


def quarter(stage, renderer, image, i):
    renderer.SetBackground(*np.roll((0.2, 0, 0), i))
    if i != 2:
        stage.add(image, property_of(colors_of((0, 0, 0, 0), (128, 0.8, 0.4, 0.2), (255, 1, 1, 1)),
                                     opacity_of((0, 0), (50, 0.05), (255, 0.3)), 1), 0.5, renderer)
    add_ball(renderer, (48 - 15 * (-1) ** (i % 2), 48 + 15 * (-1) ** (i // 2), 48),
             50 if i == 2 else 20 + 5 * i, ((1, 0, 0), (0, 1, 0), (0, 0, 1), (1, 1, 0))[i],
             1 if i in (1, 2) else 0.1)
    peel(renderer, 4)
    renderer.ResetCamera()
    renderer.GetActiveCamera().Azimuth(45 * (i or 1))
    renderer.ResetCameraClippingRange()


@scene()
def GPURayCastDepthPeelingMultiViewport(stage):
    """In the quarters of a window; VTK 9.2's mapper is right in a window of its own only."""
    z, y, x = points_of(96) - 47.5
    distance = np.sqrt(x * x + y * y + z * z) / (47.5 * np.sqrt(3))
    image = image_of((96, 96, 96), values=np.round(255 * (1 - distance)).astype(np.uint8).ravel())
    if not stage.ours:
        for i in range(4):
            quarter(stage, stage.view((300, 300)).renderer, image, i)
            yield stage.picture()
        return
    window = stage.view((600, 600)).window
    window.RemoveRenderer(stage.stage.renderer)
    places = ((0, 0.5), (0.5, 0.5), (0, 0), (0.5, 0))
    for i, (left, bottom) in enumerate(places):
        renderer = vtkRenderer()
        renderer.SetViewport(left, bottom, left + 0.5, bottom + 0.5)
        window.AddRenderer(renderer)
        quarter(stage, renderer, image, i)
    picture = stage.picture()
    for left, bottom in places:
        row, column = int(600 * bottom), int(600 * left)
        yield picture[row:row + 300, column:column + 300]


# What is not drawn as VTK draws it. `sayings`: of what there is to be a message.

REFUSED = {}


def refused(*sayings):
    def register(function):
        REFUSED["Test" + function.__name__] = (function, sayings)
        return function
    return register


def refuse_blending(mode):
    def set_scene(stage):
        squared_radius_scene(stage, BlendMode=mode)
        stage.volumes[0].GetProperty().SetScalarOpacity(step())
        yield stage.picture()
    return set_scene


for name, mode in (("CompositeToMIP", 1), ("DataTypesMIP", 1), ("DataTypesMinIP", 2),
                   ("AverageIP", 3), ("Additive", 4)):
    REFUSED["TestGPURayCast" + name] = (refuse_blending(mode), (f"The blend mode is {mode} ",))


@refused("The blend mode is 1 ", "The blend mode is 2 ", "The blend mode is 3 ",
         "The blend mode is 4 ")
def GPURayCastDepthPeelingBlendModes(stage):
    for mode in range(1, 5):
        renderer = stage.view((400, 400)).renderer
        vase(stage, renderer, 0.8, (0.3, 0.3)).GetMapper().SetBlendMode(mode)
        yield stage.picture()


@refused("The blend mode is 1 ", "The blend mode is 2 ", "The blend mode is 3 ",
         "The blend mode is 4 ")
def GPURayCastBlendModes(stage):
    view = stage.view((301, 300))
    z, y, x = points_of(100)
    inner = (np.minimum.reduce([x, y, z]) >= 10) & (np.maximum.reduce([x, y, z]) < 90)
    image = image_of((100, 100, 100), s=np.where(inner, 0, 255).ravel().astype(np.uint8))
    for mode in range(4):
        renderer = vtkRenderer()
        renderer.SetViewport(0.5 * (mode % 2), 0.5 * (mode // 2),
                             0.5 + 0.5 * (mode % 2), 0.5 + 0.5 * (mode // 2))
        view.window.AddRenderer(renderer)
        stage.add(image, property_of(colors_of((0, 0.2, 0.3, 0.6), (255, 0.2, 0.6, 0.3)),
                                     opacity_of((0, 0), (255, 0.8)), 1),
                  renderer=renderer, BlendMode=mode + 1)
        renderer.ResetCamera()
    yield stage.picture()


def two_components(stage, **settings):
    view = stage.view((301, 300))
    stage.add(halves((0, 1), (1, 0)), independent(((1, 0, 0), 0.5), ((0, 0, 1), 0.5)), 0.9,
              **settings)
    view.renderer.ResetCamera()


COMPONENTS = '" has {} components (this mapper shows one scalar)'


@refused(COMPONENTS.format(2))
def GPURayCastTwoComponentsIndependent(stage):
    two_components(stage)
    yield stage.picture()


@refused(COMPONENTS.format(2), "gradient opacity")
def GPURayCastTwoComponentsGradient(stage):
    two_components(stage)
    for component in range(2):
        stage.volumes[0].GetProperty().SetGradientOpacity(component, opacity_of((0, 0), (1, 1)))
    yield stage.picture()


@refused("2 dependent components")
def GPURayCastTwoComponentsDependent(stage):
    two_components(stage)
    stage.volumes[0].GetProperty().IndependentComponentsOff()
    yield stage.picture()


@refused("2 dependent components")
def GPURayCastTwoComponentsDependentGradient(stage):
    two_components(stage)
    stage.volumes[0].GetProperty().IndependentComponentsOff()
    stage.volumes[0].GetProperty().SetGradientOpacity(opacity_of((0, 0.2), (30, 1)))
    yield stage.picture()


def three_components(stage, opacity, **settings):
    view = stage.view((301, 300))
    colors = ((1, 0, 0), (0, 1, 0), (0, 0, 1))
    stage.add(three_spheres(), independent(*((color, opacity) for color in colors)), 0.9,
              **settings)
    view.renderer.ResetCamera()


@refused(COMPONENTS.format(3))
def GPURayCastThreeComponentsIndependent(stage):
    three_components(stage, 0.2)
    yield stage.picture()


@refused(COMPONENTS.format(3))
def GPURayCastIndependentComponentsLightParameters(stage):
    three_components(stage, 0.2)
    yield stage.picture()


@refused(COMPONENTS.format(3), "The blend mode is 4 ")
def GPURayCastThreeComponentsAdditive(stage):
    three_components(stage, 0.01, BlendMode=4)
    yield stage.picture()


@refused(COMPONENTS.format(4))
def GPURayCastIndependentComponent(stage):
    view = stage.view()
    stage.add(halves((0, 1), (1, 0), (0, 1), (1, 0)),
              independent(*4 * (((1, 0, 0), 0.1),)))
    view.renderer.ResetCamera()
    yield stage.picture()


@refused("SetMaskInput")
def GPURayCastCompositeBinaryMask1(stage):
    stage.view()
    stage.add(wavelet(-10, 10), wavelet_property(0.6), MaskInput=vtkImageData())
    yield stage.picture()


@refused("SetMaskInput")
def GPURayCastLabelMap1Label(stage):
    squared_radius_scene(stage, MaskInput=squared_radius())
    yield stage.picture()


@refused("SetRenderToImage")
def GPURayCastRenderDepthToImage2(stage):
    stage.view((401, 399))
    stage.add(wavelet(-10, 10), wavelet_property(0.4), RenderToImage=1)
    yield stage.picture()


@refused("SetFinalColorWindow")
def FinalColorWindowLevel(stage):
    stage.view()
    stage.add(wavelet(-10, 10), wavelet_property(0.3), FinalColorWindow=0.5)
    yield stage.picture()


@refused("SetImageSampleDistance")
def GPURayCastImageSampleXY(stage):
    stage.view()
    stage.add(wavelet(-10, 10), wavelet_property(0.3), ImageSampleDistance=4)
    yield stage.picture()


@refused("gradient opacity")
def GPURayCastGradientOpacity(stage):
    volume_property = wavelet_property(0.3)
    volume_property.SetGradientOpacity(opacity_of((0, 0), (90, 0.5), (100, 1)))
    placed(stage, wavelet(-10, 10), volume_property=volume_property)
    yield stage.picture()


@refused("two-dimensional")
def GPURayCastTransfer2D(stage):
    volume_property = wavelet_property(0.3)
    volume_property.SetTransferFunctionModeTo2D()
    volume_property.SetTransferFunction2D(
        image_of((4, 4, 1), rgba=np.full((16, 4), 0.5, np.float32)))
    placed(stage, wavelet(-10, 10), volume_property=volume_property)
    yield stage.picture()


@refused("nearest")
def FixedPointRayCasterNearest(stage):
    fixed_point(stage)
    for volume in stage.volumes:
        volume.GetProperty().SetInterpolationTypeToNearest()
    yield stage.picture()


@refused("shaders")
def GPURayCastUserShader(stage):
    placed(stage, wavelet(-10, 10))
    stage.volumes[0].GetShaderProperty().AddFragmentShaderReplacement(
        "//VTK::Base::Impl", True, "//VTK::Base::Impl", False)
    yield stage.picture()


@refused("vtkRectilinearGrid", "vtkResampleToImage")
def GPURayCastMapperRectilinearGrid(stage):
    view = stage.view()
    grid = vtkRectilinearGrid()
    grid.SetDimensions(4, 4, 4)
    for axis in "XYZ":
        coordinates = vtkDoubleArray()
        for place in (0, 1, 3, 7):
            coordinates.InsertNextValue(place)
        getattr(grid, f"Set{axis}Coordinates")(coordinates)
    stage.add(grid, wavelet_property(0.3))
    view.renderer.ResetCamera()
    yield stage.picture()


@refused("overlap")
def GPURayCastMultiVolumeOverlapping(stage):
    apart(stage, lambda i: wavelet_property(0.3 - 0.2 * i))
    stage.volumes[1].SetPosition(0, 0, 10)
    yield stage.picture()
