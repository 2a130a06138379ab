// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

// Converts the properties of vtkTransmittanceVolumeMapper to the scene and the settings of the
// core.

#include "vtkTransmittanceVolumeMapperInternals.h"

#include "Choices.h"
#include "InputArrays.h"
#include "SettingsConversion.h"
#include "SharedArray.h"
#include "SharedView.h"
#include "StructureLabels.h"

#include "vtkDataArray.h"
#include "vtkDataObject.h"
#include "vtkImageData.h"
#include "vtkMultiProcessController.h"
#include "vtkPiecewiseFunction.h"
#include "vtkPlane.h"
#include "vtkPlaneCollection.h"
#include "vtkRenderWindow.h"
#include "vtkRenderer.h"
#include "vtkVolume.h"
#include "vtkVolumeProperty.h"

#include "math/Require.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace
{
constexpr int CellFlag = 1;
constexpr int FieldFlag = 2;

void RequireShare(const char* property, double value)
{
  LIMPID_REQUIRE(value >= 0 && value <= 1,
    property << " is " << value << " (it is a fraction). Set a number from 0 to 1.");
}

void RequireNotNegative(const char* property, double value)
{
  LIMPID_REQUIRE(value >= 0 && std::isfinite(value),
    property << " is " << value
             << " (it must be finite and not negative). Set 0 or a positive number.");
}

void RequirePositive(const char* property, double value)
{
  LIMPID_REQUIRE(value > 0 && std::isfinite(value),
    property << " is " << value << " (it must be finite and positive). Set a number above zero.");
}
}

vtkImageData* vtkTransmittanceVolumeMapper::Internals::RequireImage() const
{
  vtkDataObject* input = this->Self->GetDataObjectInput();
  vtkImageData* image = vtkImageData::SafeDownCast(input);
  LIMPID_REQUIRE(image,
    "The input is a " << (input ? input->GetClassName() : "null pointer")
                      << " (this mapper needs uniformly spaced points). Give it a vtkImageData, "
                         "for instance from Resample To Image (vtkResampleToImage).");
  LIMPID_REQUIRE(image->GetNumberOfPoints() > 0 || !this->Ranks->IsAlone(),
    "The input has 0 points (there is nothing to draw). Give it an image with data.");
  return image;
}

limpid::FieldSource vtkTransmittanceVolumeMapper::Internals::ScalarSource(
  vtkImageData* image, vtkVolume* volume)
{
  limpid::FieldSource source;
  const char* name = this->Self->GetArrayName();
  int flag = 0;
  source.array = vtkAbstractMapper::GetScalars(image, this->Self->GetScalarMode(),
    this->Self->GetArrayAccessMode(), this->Self->GetArrayId(), name, flag);
  LIMPID_REQUIRE(source.array && flag != FieldFlag,
    "The scalar array \"" << (name && *name ? name : "(the active scalars)")
                          << "\" is not among the input's numeric arrays (the volume is coloured "
                             "by it). Choose one of these: "
                          << limpid::ArrayNames(image) << ".");
  source.onCells = flag == CellFlag;

  const int components = source.array->GetNumberOfComponents();
  LIMPID_REQUIRE(components == 1 || volume->GetProperty()->GetIndependentComponents(),
    "The array \"" << limpid::NameOf(source.array) << "\" has " << components
                   << " dependent components, which are colours and opacities themselves (this "
                      "mapper shows one scalar through transfer functions). Turn "
                      "IndependentComponents on (in ParaView: Map Scalars on, separate opacity "
                      "array and multi components mapping off) and choose a component.");
  const int chosen = this->Self->GetScalarComponent();
  if (components > 1 && chosen == UNDECIDED)
  {
    this->Warn("The array \"" + limpid::NameOf(source.array) + "\" has " +
      std::to_string(components) +
      " components (this mapper shows one scalar): the magnitude is shown. Set ScalarComponent to "
      "a component from 0 on, or to -1 for the magnitude.");
  }
  source.component = chosen == UNDECIDED ? limpid::MagnitudeComponent : chosen;
  limpid::RequireComponent("ScalarComponent", source.array, source.component);
  return source;
}

// Returns the extinction array; null if the opacity function defines the extinction.
limpid::FieldSource vtkTransmittanceVolumeMapper::Internals::ExtinctionSource(
  vtkImageData* image) const
{
  if (this->Self->ExtinctionSource != ARRAY)
  {
    return {};
  }
  const std::string& given = this->Self->ExtinctionArray;
  const std::string name = given.empty() ? "Extinction" : given;
  limpid::FieldSource source =
    limpid::FindField(image, name, this->Self->ExtinctionArrayAssociation);
  LIMPID_REQUIRE(source.array,
    "The extinction array \"" << name
                              << "\" is not among the input's numeric arrays (there is nothing to "
                                 "draw). Choose one of these: "
                              << limpid::ArrayNames(image)
                              << "; or set ExtinctionSource to Opacity Function.");
  LIMPID_REQUIRE(source.array->GetNumberOfComponents() == 1,
    "The extinction array \""
      << name << "\" has " << source.array->GetNumberOfComponents()
      << " components (extinction is one number per point). Choose an array with one component.");
  return source;
}

// Returns the importance array; null if there is none of that name.
limpid::FieldSource vtkTransmittanceVolumeMapper::Internals::GivenImportance(
  vtkImageData* image) const
{
  const std::string& given = this->Self->ImportanceArray;
  return limpid::FindField(
    image, given.empty() ? "Importance" : given, this->Self->ImportanceArrayAssociation);
}

limpid::ImportanceChoice vtkTransmittanceVolumeMapper::Internals::ChooseImportance(
  vtkImageData* image, const limpid::FieldSource& scalars) const
{
  const std::string& given = this->Self->ImportanceArray;
  limpid::ImportanceChoice choice;
  choice.name = given.empty() ? "Importance" : given;
  choice.array = this->GivenImportance(image);
  choice.isChosen = !given.empty();
  choice.scalars = scalars;
  choice.labels = limpid::StructureSource(this->Self, this->Self->Settings, image);
  if (this->Self->AssumedImportance && choice.isChosen && choice.array.array == scalars.array)
  {
    choice.array.array = nullptr;
    choice.isChosen = false;
  }
  return choice;
}

// Returns whether importance is not specified. If frames need it, computes the ramp that is assumed
// then, from the scalars of all processes.
bool vtkTransmittanceVolumeMapper::Internals::AssumeImportance(
  vtkImageData* image, limpid::ImportanceChoice& choice)
{
  // If some processes have an importance array, all should have one.
  choice.isChosen = this->AnyRank(choice.isChosen || choice.array.array);
  const bool assumes = !this->Self->AssumedImportance && choice.IsAssumed(this->Self->Settings);
  if (!this->AnyRank(assumes))
  {
    return false;
  }
  if (!this->UsesImportance)
  {
    return true;
  }
  const limpid::FieldSource& scalars = choice.scalars;
  const auto of = std::make_pair(scalars.array ? scalars.array->GetMTime() : 0, scalars.component);
  if (this->AnyRank(of != this->RampOf))
  {
    this->Ramp =
      limpid::StartingImportance(limpid::SharedArray(scalars, image, this->Self->WholeExtent,
        this->Ranks->IsAlone() ? nullptr : vtkMultiProcessController::GetGlobalController()));
    this->RampOf = of;
    this->RampTime.Modified();
  }
  return true;
}

vtkTransmittanceVolumeMapper::Internals::Importance
vtkTransmittanceVolumeMapper::Internals::ImportanceOf(
  vtkImageData* image, const limpid::ImportanceChoice& choice)
{
  vtkVisibilitySettings* settings = this->Self->Settings;
  vtkPiecewiseFunction* given = this->Self->AssumedImportance;
  Importance importance;
  if (choice.labels.array)
  {
    importance.source = choice.labels;
    importance.functionTime = settings->GetStructuresMTime();
    importance.warning = limpid::WarningOf(choice.labels);
  }
  else if (!choice.IsAssumed(settings))
  {
    vtkPiecewiseFunction* function = settings->GetImportanceFunction();
    importance.source = choice.Source(settings, limpid::KeepValue(), image);
    importance.functionTime =
      settings->GetUseImportanceFunction() && function ? function->GetMTime() : 0;
  }
  else if (given)
  {
    importance.source = choice.Source(settings, limpid::Evaluate(given), image);
    importance.functionTime = given->GetMTime();
  }
  else
  {
    importance.source = choice.Source(settings, limpid::MappingOf(this->Ramp), image);
    importance.functionTime = this->RampTime.GetMTime();
    importance.warning = limpid::WarningOf(this->Ramp);
  }
  return importance;
}

// Updates the importance of the data. Without importance, the volume is drawn without optimisation.
// What nobody has specified is not assumed for scores alone, which would take a third of the time
// of a plain picture and four times its memory.
void vtkTransmittanceVolumeMapper::Internals::UpdateImportance(
  vtkImageData* image, limpid::ImportanceChoice choice, limpid::FrameSettings& frame)
{
  this->UsesImportance = this->UsesImportance || frame.optimize || frame.showMissed;
  if (this->AssumeImportance(image, choice) && !this->UsesImportance)
  {
    this->Data.UpdateImportance(image, limpid::FieldSource(), 0, frame.solver, false);
    return;
  }
  Importance importance;
  std::string trouble; // error message about the importance
  try
  {
    importance = image->GetNumberOfPoints() > 0 ? this->ImportanceOf(image, choice) : Importance();
    if (this->Ranks->IsAlone())
    {
      this->Data.UpdateImportance(
        image, importance.source, importance.functionTime, frame.solver, frame.DrawsImportance());
    }
  }
  catch (const std::exception& error)
  {
    trouble = this->MessageOf(error);
  }
  if (this->AnyRank(!trouble.empty()))
  {
    this->LeaveImportance(
      image, choice, trouble.empty() ? "Another process has no importance." : trouble, frame);
  }
  else if (!this->Ranks->IsAlone())
  {
    const bool labelled = this->AnyRank(importance.source.structures != nullptr);
    if (labelled && !importance.source.structures)
    {
      importance.source.structures =
        std::make_shared<const limpid::Structures>(limpid::StructuresOf(this->Self->Settings));
    }
    this->Data.UpdateImportance(
      image, importance.source, importance.functionTime, frame.solver, frame.DrawsImportance());
    const limpid::ControlResolution wanted = frame.solver.controlResolution;
    if (wanted != limpid::ControlResolution::FinestThatFits &&
      wanted != limpid::ControlResolution::Full)
    {
      this->Warn(
        "ControlResolution is not Full, and processes share the image (each draws its part "
        "at the resolution of its own optimisation): it is optimised at full resolution. "
        "Set ControlResolution to Full or Auto.");
    }
  }
  if (!importance.warning.empty() && (frame.optimize || frame.showMissed))
  {
    this->Warn(importance.warning);
  }
}

// Draws without importance, and says why. Without optimisation, importance is used only for the
// score, missed structures and colours of structures.
void vtkTransmittanceVolumeMapper::Internals::LeaveImportance(vtkImageData* image,
  const limpid::ImportanceChoice& choice, const std::string& reason, limpid::FrameSettings& frame)
{
  const bool losesColors = this->AnyRank(frame.structureColors > 0 && choice.labels.array);
  std::string effects = frame.optimize ? " The volume is drawn without optimization."
    : frame.showMissed                 ? " Missed structures are not painted."
                                       : "";
  effects += losesColors ? " The volume is drawn without colors of structures." : "";
  if (!effects.empty())
  {
    this->Error(reason + effects);
  }
  this->Data.UpdateImportance(image, limpid::FieldSource(), 0, frame.solver, false);
  frame.optimize = false;
  frame.showMissed = false;
  frame.structureColors = losesColors ? 0 : frame.structureColors;
}

// Finds the colours of structures. If there are none, the volume is drawn without.
void vtkTransmittanceVolumeMapper::Internals::ChooseColors(limpid::FrameSettings& frame)
{
  this->Legend.clear();
  if (frame.structureColors <= 0)
  {
    return;
  }
  const limpid::Structures* structures = this->Data.Labelled();
  if (!structures)
  {
    this->Warn("StructureColors is " + std::to_string(frame.structureColors) +
      " and no structure array is chosen (it has the labels of the structures): the colors of "
      "the transfer function are shown. Choose StructureArray, or set StructureColors to 0.");
    return;
  }
  try
  {
    frame.colorsOfRows = limpid::ColorsOf(*structures, this->LabelColors);
    this->Legend = limpid::LegendOf(*structures, frame.colorsOfRows);
    const std::string warning = limpid::WarningOf(*structures, this->LabelColors);
    warning.empty() ? void() : this->Warn(warning);
  }
  catch (const std::exception& error)
  {
    frame.structureColors = 0;
    this->Error(this->MessageOf(error) + " The volume is drawn without colors of structures.");
  }
}

limpid::CropRegion vtkTransmittanceVolumeMapper::Internals::CropRegionOf(vtkVolume* volume) const
{
  limpid::CropRegion region;
  if (vtkPlaneCollection* planes = this->Self->GetClippingPlanes())
  {
    // The plane n . (M x - o) in data coordinates.
    const glm::dmat4 toWorld = limpid::DataToWorld(volume);
    for (int i = 0; i < planes->GetNumberOfItems(); ++i)
    {
      double normal[3];
      double origin[3];
      planes->GetItem(i)->GetNormal(normal);
      planes->GetItem(i)->GetOrigin(origin);
      const double offset = normal[0] * origin[0] + normal[1] * origin[1] + normal[2] * origin[2];
      region.planes.push_back(
        glm::transpose(toWorld) * glm::dvec4(normal[0], normal[1], normal[2], -offset));
    }
  }
  if (!this->Self->GetCropping())
  {
    return region;
  }
  std::copy_n(this->Self->GetCroppingRegionPlanes(), 6, region.limits.begin());
  region.regions = this->Self->GetCroppingRegionFlags();
  region.hasRegions = region.regions != VTK_CROP_SUBVOLUME;
  if (!region.hasRegions)
  {
    for (int axis = 0; axis < 3; ++axis)
    {
      glm::dvec4 inward(0.0);
      inward[axis] = 1;
      inward.w = -region.limits[2 * std::size_t(axis)];
      region.planes.push_back(inward);
      inward[axis] = -1;
      inward.w = region.limits[2 * std::size_t(axis) + 1];
      region.planes.push_back(inward);
    }
  }
  return region;
}

void vtkTransmittanceVolumeMapper::Internals::RequirePossibleNumbers() const
{
  const vtkTransmittanceVolumeMapper* self = this->Self;
  RequireShare("ShadowStrength", self->ShadowStrength);
  RequireShare("Ambient", self->Ambient);
  LIMPID_REQUIRE(std::abs(self->Anisotropy) < 1,
    "Anisotropy is "
      << self->Anisotropy
      << " (the phase function is not defined for it). Set a number above -1 and below 1.");
  RequireShare("StructureColors", self->StructureColors);
  RequireNotNegative("Specular", self->Specular);
  RequireNotNegative("SpecularPower", self->SpecularPower);
  RequireNotNegative("LightIntensity", self->LightIntensity);
  RequireNotNegative("EaseTime", self->EaseTime);
  RequirePositive("SampleDistance", self->SampleDistance);
  RequirePositive("InteractiveFrameTime", self->InteractiveFrameTime);
  for (const double channel : self->MissedColor)
  {
    RequireShare("A channel of MissedColor", channel);
  }
}

limpid::Lighting vtkTransmittanceVolumeMapper::Internals::MakeLighting() const
{
  limpid::Lighting lighting;
  lighting.intensity = this->Self->LightIntensity;
  lighting.ambient = this->Self->Ambient;
  lighting.anisotropy = this->Self->Anisotropy;
  lighting.surface = this->Self->Specular;
  lighting.specularPower = this->Self->SpecularPower;
  lighting.shadows = this->Self->Shadows != 0;
  lighting.shadowStrength = this->Self->ShadowStrength;
  return lighting;
}

// Switches off what needs the whole volume if each process draws its piece by itself.
void vtkTransmittanceVolumeMapper::Internals::DropUnsupportedOnRanks(limpid::FrameSettings& frame)
{
  vtkMultiProcessController* controller = vtkMultiProcessController::GetGlobalController();
  if (!controller || controller->GetNumberOfProcesses() < 2 || !this->Ranks->IsAlone())
  {
    return;
  }
  if (frame.optimize || frame.lit || frame.showMissed)
  {
    const std::string text = "There are " + std::to_string(controller->GetNumberOfProcesses()) +
      " processes (each has its own piece of the volume, and occluders may be in the pieces of "
      "others): the volume is drawn without optimization, light and score, and missed structures "
      "are not shown. Set SharesImage on if all of them render the same frames, or run one "
      "process.";
    const bool speaks = controller->GetLocalProcessId() == 0; // one process reports for all
    speaks ? this->Warn(text) : void(this->Messages += text + "\n");
  }
  frame.optimize = false;
  frame.lit = false;
  frame.measure = false;
  frame.showMissed = false;
}

// Switches off what is not supported if processes draw together.
void vtkTransmittanceVolumeMapper::Internals::LeaveWhatIsNotShared(limpid::FrameSettings& frame)
{
  frame.ranks = this->Ranks.get();
  if (!frame.IsOfSeveral())
  {
    return;
  }
  frame.still = !frame.AnyRank(!frame.still);
  limpid::TakeFirstOf(*this->Ranks, frame.light);
  if (frame.optimize && frame.solver.method != limpid::Method::Optimized)
  {
    this->Warn(std::string("Method is ") + limpid::InfoOf(frame.solver.method).name +
      " and several processes share the image (this is not supported in distributed runs): "
      "ordinary rendering is used. Set Method to Optimized or Ordinary.");
    frame.optimize = false;
    frame.solver.method = limpid::Method::Optimized;
  }
  if (frame.showMissed)
  {
    this->Warn("ShowMissed is on and several processes share the image (this is not supported in "
               "distributed runs): missed structures are not shown. Run one process.");
    frame.showMissed = false;
  }
  if (frame.sampleDistance > limpid::farthestShared)
  {
    this->Warn("SampleDistance is " + std::to_string(frame.sampleDistance) +
      " and several processes share the image (each has only a few ghost nodes): 2 is used. Set it "
      "to 2 or less.");
    frame.sampleDistance = limpid::farthestShared;
  }
  if (frame.solver.backend == limpid::BackendKind::Auto)
  {
    frame.solver.backend = limpid::BackendKind::Cpu;
  }
}

limpid::FrameSettings vtkTransmittanceVolumeMapper::Internals::MakeFrameSettings(
  vtkRenderer* renderer, vtkVolume* volume)
{
  const vtkTransmittanceVolumeMapper* self = this->Self;
  limpid::FrameSettings frame;
  const bool atRest = renderer->GetRenderWindow()->GetDesiredUpdateRate() < 1;
  frame.still = !self->AdaptiveQuality || (atRest && !self->DeferStill);
  const bool ordinary = self->Settings->GetMethod() == ORDINARY;
  frame.optimize = !ordinary && self->Optimization != OFF;
  frame.once = self->Optimization == ONCE;
  frame.paused = self->PauseOptimization != 0;
  frame.solver = limpid::SettingsOf(self->Settings);
  // The result of another method is kept for when Ordinary is switched off.
  frame.solver.method = ordinary ? limpid::Method::Optimized : frame.solver.method;
  frame.solver.Require();
  frame.views = limpid::ViewSetOf(self->Settings);
  frame.views.Require();
  frame.lighting = this->MakeLighting();
  frame.lit = self->Shadows || volume->GetProperty()->GetShade(0);
  frame.light = self->LightSource == OWN ? limpid::OwnLight(self->Settings, renderer)
                                         : limpid::StrongestLight(renderer);
  frame.light.light = limpid::ToData(frame.light.light, volume);
  frame.sampleDistance = self->SampleDistance;
  frame.jitter = self->Jitter != 0;
  frame.drawOn = static_cast<limpid::DrawOn>(self->DrawOn);
  frame.showMissed = self->ShowMissed != 0;
  std::transform(self->MissedColor, self->MissedColor + 3, frame.missedColor.begin(),
    [](double channel) { return static_cast<float>(channel); });
  frame.structureColors = self->StructureColors;
  frame.frameTime = self->InteractiveFrameTime;
  frame.easeTime = self->EaseTime;
  frame.stepwise = self->ProgressiveStill != 0;

  this->DropUnsupportedOnRanks(frame);
  this->LeaveWhatIsNotShared(frame);
  return frame;
}
