// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#include "vtkCameraPath.h"

#include "Abort.h"
#include "Choices.h"
#include "PropertyPrinter.h"
#include "Vectors.h"

#include "vtkAlgorithmOutput.h"
#include "vtkCellArray.h"
#include "vtkDoubleArray.h"
#include "vtkFieldData.h"
#include "vtkInformation.h"
#include "vtkInformationVector.h"
#include "vtkIntArray.h"
#include "vtkMath.h"
#include "vtkNew.h"
#include "vtkObjectFactory.h"
#include "vtkPointData.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"
#include "vtkStreamingDemandDrivenPipeline.h"

#include "math/Require.h"
#include "viewpoint/CameraPath.h"
#include "viewpoint/Search.h"

#include <cstddef>
#include <exception>
#include <utility>
#include <vector>

vtkStandardNewMacro(vtkCameraPath);

namespace
{
using Pipeline = vtkStreamingDemandDrivenPipeline;

vtkDataArray* RequireArray(vtkPolyData* sphere, const char* name, int components)
{
  vtkDataArray* array = sphere->GetPointData()->GetArray(name);
  LIMPID_REQUIRE(array && array->GetNumberOfComponents() == components,
    "The input has no point array \""
      << name
      << "\" (it is not known what is seen from where). Connect the "
         "first output of a viewpoint search, its sphere.");
  return array;
}

limpid::Vec3 VectorOf(vtkDataArray* array, vtkIdType tuple)
{
  double vector[3];
  array->GetTuple(tuple, vector);
  return limpid::ToVec3(vector);
}

limpid::DirectionMesh MeshOf(vtkPolyData* sphere)
{
  vtkDataArray* directions = RequireArray(sphere, "ViewDirection", 3);
  limpid::DirectionMesh mesh;
  for (vtkIdType i = 0; i < directions->GetNumberOfTuples(); ++i)
  {
    mesh.directions.push_back(VectorOf(directions, i));
  }
  vtkNew<vtkIdList> corners;
  for (vtkIdType i = 0; i < sphere->GetPolys()->GetNumberOfCells(); ++i)
  {
    sphere->GetPolys()->GetCellAtId(i, corners);
    LIMPID_REQUIRE(corners->GetNumberOfIds() == 3,
      "The input has faces that are no triangles (it is no sphere of a search). Connect the first "
      "output of a viewpoint search.");
    mesh.triangles.push_back({ { static_cast<int>(corners->GetId(0)),
      static_cast<int>(corners->GetId(1)), static_cast<int>(corners->GetId(2)) } });
  }
  LIMPID_REQUIRE(!mesh.triangles.empty(),
    "The input has no triangles (there is no sphere to move on). Connect the first output of a "
    "viewpoint search, and see what that says.");
  return mesh;
}

std::vector<double> ScoresOf(vtkPolyData* sphere)
{
  vtkDataArray* values = RequireArray(sphere, "VisibilityScore", 1);
  std::vector<double> scores;
  for (vtkIdType i = 0; i < values->GetNumberOfTuples(); ++i)
  {
    scores.push_back(values->GetTuple1(i));
  }
  return scores;
}

// The cameras of a search.
limpid::Orbit OrbitOf(vtkPolyData* sphere)
{
  limpid::Orbit orbit;
  const limpid::Vec3 position = VectorOf(RequireArray(sphere, "CameraPosition", 3), 0);
  orbit.centre = VectorOf(RequireArray(sphere, "CameraFocalPoint", 3), 0);
  orbit.distance = glm::distance(position, orbit.centre);
  vtkDataArray* up = sphere->GetFieldData()->GetArray("CameraUpAxis");
  orbit.up = up ? VectorOf(up, 0) : orbit.up;
  return orbit;
}
}

struct vtkCameraPath::Internals
{
  explicit Internals(vtkCameraPath* self)
    : Self(self)
  {
  }

  vtkCameraPath* Self;
  std::vector<double> Times; // time steps of the input

  bool IsLaterPiece() const
  {
    return this->Self->GetOutputInformation(0)->Get(Pipeline::UPDATE_PIECE_NUMBER()) > 0;
  }
  bool GoesThroughTime() const { return this->Self->Way == THROUGH_TIME; }
  std::size_t StepCount() const { return this->GoesThroughTime() ? this->Times.size() : 1; }

  void Update(std::size_t step) const;
  bool Read(vtkInformation* input, limpid::DirectionMesh& mesh,
    std::vector<std::vector<double>>& scores) const;
  void RequireSettings() const;
  limpid::CameraPath Find(const limpid::DirectionMesh& mesh,
    const std::vector<std::vector<double>>& scores, const limpid::Orbit& orbit) const;
  void Fill(const limpid::CameraPath& path, const limpid::Orbit& orbit, vtkPolyData* output) const;
};

void vtkCameraPath::Internals::RequireSettings() const
{
  limpid::RequireAngle("SeparationAngle", this->Self->SeparationAngle);
  LIMPID_REQUIRE(this->Self->LeastShare >= 0 && this->Self->LeastShare <= 1,
    "LeastShare is " << this->Self->LeastShare
                     << " (it is a share of a score). Set it between 0 and 1.");
  limpid::RequireElevations(this->Self->ElevationRange);
  LIMPID_REQUIRE(!this->GoesThroughTime() || !this->Times.empty(),
    "The input has no time steps (there is nothing to follow). Connect data of several time steps, "
    "or set Way to Round Trip.");
}

// Brings the input to a time step. The pipeline's own way of doing this, CONTINUE_EXECUTING, never
// ends where the input fails, because it ends in RequestData alone, which is not called then.
void vtkCameraPath::Internals::Update(std::size_t step) const
{
  vtkAlgorithmOutput* connection = this->Self->GetInputConnection(0, 0);
  auto* producer = Pipeline::SafeDownCast(connection->GetProducer()->GetExecutive());
  producer->GetOutputInformation(connection->GetIndex())
    ->Set(Pipeline::UPDATE_TIME_STEP(), this->Times[step]);
  LIMPID_REQUIRE(producer->Update(connection->GetIndex()),
    "The input cannot be computed at time step "
      << step << " of 0.." << (this->Times.size() - 1) << ", time " << this->Times[step]
      << " (a way through time needs the scores of all of them). See what the input says, or take "
         "this time step out of the data.");
}

// The sphere and its scores at all time steps; the input is at the first one. Returns false if the
// user wants to stop.
bool vtkCameraPath::Internals::Read(vtkInformation* input, limpid::DirectionMesh& mesh,
  std::vector<std::vector<double>>& scores) const
{
  const std::size_t steps = this->StepCount();
  for (std::size_t step = 0; step < steps; ++step)
  {
    if (step > 0)
    {
      this->Update(step);
    }
    if (limpid::IsAborted(this->Self))
    {
      return false;
    }
    vtkPolyData* sphere = vtkPolyData::GetData(input);
    // With several processes the first one has the sphere; the others help to compute it.
    if (this->IsLaterPiece() && sphere->GetNumberOfPoints() == 0)
    {
      continue;
    }
    limpid::DirectionMesh present = MeshOf(sphere);
    LIMPID_REQUIRE(scores.empty() || present.directions == mesh.directions,
      "The directions of time step " << step
                                     << " are others than before (a way has one sphere). Leave "
                                        "Sampling and NumberOfDirections as they are.");
    mesh = std::move(present);
    scores.push_back(ScoresOf(sphere));
    this->Self->UpdateProgress(double(step + 1) / double(steps));
    if (limpid::IsAborted(this->Self))
    {
      return false;
    }
  }
  return true;
}

limpid::CameraPath vtkCameraPath::Internals::Find(const limpid::DirectionMesh& mesh,
  const std::vector<std::vector<double>>& scores, const limpid::Orbit& orbit) const
{
  limpid::CameraPathSettings settings;
  settings.keyViews = this->Self->NumberOfKeyViews;
  settings.separation = vtkMath::RadiansFromDegrees(this->Self->SeparationAngle);
  settings.frames = this->Self->NumberOfFrames;
  settings.leastShare = this->Self->LeastShare;
  settings.allowed.up = orbit.up;
  settings.allowed.lowest = vtkMath::RadiansFromDegrees(this->Self->ElevationRange[0]);
  settings.allowed.highest = vtkMath::RadiansFromDegrees(this->Self->ElevationRange[1]);
  limpid::CameraPath path = this->GoesThroughTime()
    ? limpid::PathThroughTime(mesh, scores, settings)
    : limpid::RoundTrip(mesh, scores.back(), settings);
  LIMPID_REQUIRE(!path.directions.empty(),
    "No direction of the sphere is within ElevationRange (there is nowhere to go). Widen it, or "
    "raise NumberOfDirections of the search.");
  return path;
}

void vtkCameraPath::Internals::Fill(
  const limpid::CameraPath& path, const limpid::Orbit& orbit, vtkPolyData* output) const
{
  const auto count = static_cast<vtkIdType>(path.directions.size());
  vtkNew<vtkPoints> points;
  points->SetDataTypeToDouble();
  vtkNew<vtkCellArray> line;
  line->InsertNextCell(static_cast<int>(count + (path.closed ? 1 : 0)));
  const auto add = [output](const char* name, int components)
  {
    vtkNew<vtkDoubleArray> array;
    array->SetName(name);
    array->SetNumberOfComponents(components);
    output->GetPointData()->AddArray(array);
    return array.GetPointer();
  };
  vtkDoubleArray* positions = add("CameraPosition", 3);
  vtkDoubleArray* focalPoints = add("CameraFocalPoint", 3);
  vtkDoubleArray* viewUps = add("CameraViewUp", 3);
  vtkDoubleArray* directions = add("ViewDirection", 3);
  vtkDoubleArray* scores = add("VisibilityScore", 1);
  vtkDoubleArray* times = add("Time", 1);
  for (vtkIdType i = 0; i < count; ++i)
  {
    const auto frame = static_cast<std::size_t>(i);
    const limpid::Vec3& direction = path.directions[frame];
    const limpid::Camera camera = orbit.At(direction);
    line->InsertCellPoint(points->InsertNextPoint(&camera.position.x));
    positions->InsertNextTuple(&camera.position.x);
    focalPoints->InsertNextTuple(&camera.focalPoint.x);
    viewUps->InsertNextTuple(&camera.viewUp.x);
    directions->InsertNextTuple(&direction.x);
    scores->InsertNextValue(path.scores[frame]);
    times->InsertNextValue(path.closed ? double(i) / double(count) : this->Times[frame]);
  }
  if (path.closed)
  {
    line->InsertCellPoint(0);
  }
  vtkNew<vtkIntArray> keys;
  keys->SetName("KeyView");
  keys->SetNumberOfTuples(count);
  keys->FillValue(0);
  for (const int key : path.keyViews)
  {
    keys->SetValue(key, 1);
  }
  output->GetPointData()->AddArray(keys);
  output->GetPointData()->SetActiveScalars("VisibilityScore");
  output->SetPoints(points);
  output->SetLines(line);
}

vtkCameraPath::vtkCameraPath()
  : State(new Internals(this))
{
}

vtkCameraPath::~vtkCameraPath() = default;

int vtkCameraPath::FillInputPortInformation(int, vtkInformation* info)
{
  info->Set(vtkAlgorithm::INPUT_REQUIRED_DATA_TYPE(), "vtkPolyData");
  return 1;
}

int vtkCameraPath::RequestInformation(
  vtkInformation*, vtkInformationVector** inputVector, vtkInformationVector* outputVector)
{
  vtkInformation* input = inputVector[0]->GetInformationObject(0);
  this->State->Times.clear();
  if (input->Has(Pipeline::TIME_STEPS()))
  {
    const double* times = input->Get(Pipeline::TIME_STEPS());
    this->State->Times.assign(times, times + input->Length(Pipeline::TIME_STEPS()));
  }
  if (this->Way == THROUGH_TIME) // one way for all times
  {
    vtkInformation* output = outputVector->GetInformationObject(0);
    output->Remove(Pipeline::TIME_STEPS());
    output->Remove(Pipeline::TIME_RANGE());
  }
  return 1;
}

int vtkCameraPath::RequestUpdateExtent(
  vtkInformation*, vtkInformationVector** inputVector, vtkInformationVector*)
{
  if (this->State->GoesThroughTime() && !this->State->Times.empty())
  {
    inputVector[0]->GetInformationObject(0)->Set(
      Pipeline::UPDATE_TIME_STEP(), this->State->Times.front());
  }
  return 1;
}

int vtkCameraPath::RequestData(
  vtkInformation*, vtkInformationVector** inputVector, vtkInformationVector* outputVector)
{
  vtkInformation* input = inputVector[0]->GetInformationObject(0);
  vtkPolyData* output = vtkPolyData::GetData(outputVector);
  const Internals& state = *this->State;
  try
  {
    state.RequireSettings();
    limpid::DirectionMesh mesh;
    std::vector<std::vector<double>> scores;
    const bool isWhole = state.Read(input, mesh, scores);
    output->Initialize();
    if (isWhole && !scores.empty())
    {
      vtkPolyData* sphere = vtkPolyData::GetData(input);
      const limpid::Orbit orbit = OrbitOf(sphere);
      state.Fill(state.Find(mesh, scores, orbit), orbit, output);
      output->GetFieldData()->ShallowCopy(sphere->GetFieldData());
    }
    return 1;
  }
  catch (const std::exception& error)
  {
    vtkErrorMacro(<< error.what());
    output->Initialize();
    return 0;
  }
}

void vtkCameraPath::PrintSelf(ostream& os, vtkIndent indent)
{
  const limpid::PropertyPrinter print{ os, indent };

  this->Superclass::PrintSelf(os, indent);
  print("Way", this->Way);
  print("NumberOfKeyViews", this->NumberOfKeyViews);
  print("SeparationAngle", this->SeparationAngle);
  print("NumberOfFrames", this->NumberOfFrames);
  print("LeastShare", this->LeastShare);
  print("ElevationRange", this->ElevationRange);
}
