// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#include "vtkCameraPath.h"

#include "Abort.h"
#include "Choices.h"
#include "ControllerRanks.h"
#include "FieldValues.h"
#include "PropertyPrinter.h"
#include "UpstreamErrors.h"
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

#include "distributed/Communicator.h"
#include "math/Require.h"
#include "viewpoint/CameraPath.h"
#include "viewpoint/FittedCamera.h"
#include "viewpoint/Search.h"

#include <cstddef>
#include <exception>
#include <string>
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
    "The input has no point array \"" << name
                                      << "\" (the path is computed from it). Connect the first "
                                         "output of a viewpoint search, its sphere.");
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
      "The input has faces that are not triangles (it is not the sphere of a search). Connect the "
      "first output of a viewpoint search.");
    mesh.triangles.push_back({ { static_cast<int>(corners->GetId(0)),
      static_cast<int>(corners->GetId(1)), static_cast<int>(corners->GetId(2)) } });
  }
  LIMPID_REQUIRE(!mesh.triangles.empty(),
    "The input has no triangles (there is no sphere to move on). Connect the first output of a "
    "viewpoint search, and check its messages.");
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

double NumberOf(vtkPolyData* sphere, const char* name, double otherwise)
{
  vtkDataArray* array = sphere->GetFieldData()->GetArray(name);
  return array && array->GetNumberOfTuples() > 0 ? array->GetComponent(0, 0) : otherwise;
}

// Returns the cameras that a search scored its views with.
limpid::Orbit OrbitOf(vtkPolyData* sphere)
{
  limpid::Orbit orbit;
  const limpid::Vec3 position = VectorOf(RequireArray(sphere, "CameraPosition", 3), 0);
  orbit.centre = VectorOf(RequireArray(sphere, "CameraFocalPoint", 3), 0);
  orbit.distance = glm::distance(position, orbit.centre);
  vtkDataArray* up = sphere->GetFieldData()->GetArray("CameraUpAxis");
  orbit.up = up ? VectorOf(up, 0) : orbit.up;
  orbit.viewAngle = NumberOf(sphere, "CameraViewAngle", orbit.viewAngle);
  orbit.aspect = NumberOf(sphere, "CameraAspectRatio", orbit.aspect);
  orbit.parallel = NumberOf(sphere, "CameraParallelProjection", 0) != 0;
  orbit.parallelScale = NumberOf(sphere, "CameraParallelScale", orbit.parallelScale);
  return orbit;
}

// Returns the corners of the box of the image that was searched.
std::vector<limpid::Vec3> CornersOf(vtkPolyData* sphere)
{
  vtkDataArray* numbers = sphere->GetFieldData()->GetArray("ImageCorners");
  LIMPID_REQUIRE(numbers && numbers->GetNumberOfTuples() == 1,
    "The input has no field data \"ImageCorners\" (the cameras are fitted to these corners). "
    "Connect the first output of a viewpoint search.");
  std::vector<limpid::Vec3> corners;
  for (int i = 0; i + 2 < numbers->GetNumberOfComponents(); i += 3)
  {
    corners.emplace_back(numbers->GetComponent(0, i), numbers->GetComponent(0, i + 1),
      numbers->GetComponent(0, i + 2));
  }
  return corners;
}

// The results of a search at one or several time steps.
struct Found
{
  limpid::DirectionMesh mesh;
  std::vector<std::vector<double>> scores; // one vector per time step, one score per direction
  std::vector<limpid::Vec3> corners;       // of the images of all time steps
};
}

struct vtkCameraPath::Internals
{
  explicit Internals(vtkCameraPath* self)
    : Self(self)
  {
  }

  vtkCameraPath* Self;
  std::vector<double> Times; // of the input

  bool IsLaterPiece() const
  {
    return this->Self->GetOutputInformation(0)->Get(Pipeline::UPDATE_PIECE_NUMBER()) > 0;
  }
  bool GoesThroughTime() const { return this->Self->Way == THROUGH_TIME; }
  std::size_t StepCount() const { return this->GoesThroughTime() ? this->Times.size() : 1; }

  bool Update(std::size_t step) const;
  bool Read(const limpid::Communicator& ranks, vtkInformation* input, Found& found) const;
  void ReadStep(std::size_t step, vtkInformation* input, Found& found) const;
  void RequireStep(std::size_t step, bool isThere, const std::string& why) const;
  void RequireSettings() const;
  limpid::CameraPath Find(const Found& found, const limpid::Vec3& up) const;
  void Fill(const limpid::CameraPath& path, const limpid::Orbit& orbit, vtkPolyData* output) const;
};

void vtkCameraPath::Internals::RequireSettings() const
{
  limpid::RequireAngle("SeparationAngle", this->Self->SeparationAngle);
  LIMPID_REQUIRE(this->Self->LeastShare >= 0 && this->Self->LeastShare <= 1,
    "LeastShare is " << this->Self->LeastShare
                     << " (it is a fraction of the best score). Set it between 0 and 1.");
  limpid::RequireElevations(this->Self->ElevationRange);
  LIMPID_REQUIRE(!this->GoesThroughTime() || !this->Times.empty(),
    "The input has no time steps (a path through time has one frame per time step). Connect data "
    "of several time steps, or set Way to Round Trip.");
}

// Updates the input to a time step, and returns whether it succeeded. The usual way,
// CONTINUE_EXECUTING, loops forever if the input fails: only RequestData can end it, and that is
// not called then.
bool vtkCameraPath::Internals::Update(std::size_t step) const
{
  vtkAlgorithmOutput* connection = this->Self->GetInputConnection(0, 0);
  auto* producer = Pipeline::SafeDownCast(connection->GetProducer()->GetExecutive());
  producer->GetOutputInformation(connection->GetIndex())
    ->Set(Pipeline::UPDATE_TIME_STEP(), this->Times[step]);
  return producer->Update(connection->GetIndex());
}

// `why`: the message of the input.
void vtkCameraPath::Internals::RequireStep(
  std::size_t step, bool isThere, const std::string& why) const
{
  LIMPID_REQUIRE(isThere,
    "The input cannot be computed at time step "
      << step << " of 0.." << (this->Times.size() - 1) << ", time " << this->Times[step]
      << " (a path through time needs the scores of all of them). Fix the input, or remove this "
         "time step from it. It reports: "
      << (why.empty() ? "nothing" : why));
}

// Adds the input's result at a time step. With several processes, the first one has the sphere; the
// others take part in its computation.
void vtkCameraPath::Internals::ReadStep(std::size_t step, vtkInformation* input, Found& found) const
{
  vtkPolyData* sphere = vtkPolyData::GetData(input);
  LIMPID_REQUIRE(sphere,
    "The input is a " << vtkDataObject::GetData(input)->GetClassName()
                      << " (a camera path goes over the sphere of scores of a viewpoint search). "
                         "Apply this filter to the result of Viewpoint Search.");
  if (this->IsLaterPiece() && sphere->GetNumberOfPoints() == 0)
  {
    return;
  }
  limpid::DirectionMesh present = MeshOf(sphere);
  LIMPID_REQUIRE(found.scores.empty() || present.directions == found.mesh.directions,
    "The directions of time step " << step
                                   << " differ from those before (a path needs one sphere). Do not "
                                      "change Sampling and NumberOfDirections.");
  found.mesh = std::move(present);
  found.scores.push_back(ScoresOf(sphere));
  const std::vector<limpid::Vec3> corners = CornersOf(sphere);
  found.corners.insert(found.corners.end(), corners.begin(), corners.end());
}

// Reads all time steps; the input is at the first one. Returns false if the user wants to stop. All
// ranks go on to the next step or none does, since a search waits for all of them.
bool vtkCameraPath::Internals::Read(
  const limpid::Communicator& ranks, vtkInformation* input, Found& found) const
{
  const std::size_t steps = this->StepCount();
  for (std::size_t step = 0; step < steps; ++step)
  {
    limpid::UpstreamErrors errors(this->Self);
    const bool isThere = step == 0 || this->Update(step);
    if (ranks.AnyOf(limpid::IsAborted(this->Self)))
    {
      return false;
    }
    limpid::RequireOnAllRanks(ranks,
      [&]
      {
        this->RequireStep(step, isThere, errors.First());
        this->ReadStep(step, input, found);
      });
    this->Self->UpdateProgress(double(step + 1) / double(steps));
    if (ranks.AnyOf(limpid::IsAborted(this->Self)))
    {
      return false;
    }
  }
  return true;
}

limpid::CameraPath vtkCameraPath::Internals::Find(const Found& found, const limpid::Vec3& up) const
{
  limpid::CameraPathSettings settings;
  settings.keyViews = this->Self->NumberOfKeyViews;
  settings.separation = vtkMath::RadiansFromDegrees(this->Self->SeparationAngle);
  settings.frames = this->Self->NumberOfFrames;
  settings.leastShare = this->Self->LeastShare;
  settings.allowed.up = up;
  settings.allowed.lowest = vtkMath::RadiansFromDegrees(this->Self->ElevationRange[0]);
  settings.allowed.highest = vtkMath::RadiansFromDegrees(this->Self->ElevationRange[1]);
  limpid::CameraPath path = this->GoesThroughTime()
    ? limpid::PathThroughTime(found.mesh, found.scores, settings)
    : limpid::RoundTrip(found.mesh, found.scores.back(), settings);
  LIMPID_REQUIRE(!path.directions.empty(),
    "No direction of the sphere is within ElevationRange (no camera position is allowed). Widen "
    "it, or raise NumberOfDirections of the search.");
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
  // Data of other types are reported by this filter, as by vtkVisibilityAlgorithm.
  info->Set(vtkAlgorithm::INPUT_REQUIRED_DATA_TYPE(), "vtkCompositeDataSet");
  info->Append(vtkAlgorithm::INPUT_REQUIRED_DATA_TYPE(), "vtkDataObject");
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
  if (this->Way == THROUGH_TIME) // one path for all time steps
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
  const auto ranks = limpid::RanksThatUpdate(outputVector->GetInformationObject(0));
  try
  {
    state.RequireSettings();
    Found found;
    const bool isWhole = state.Read(*ranks, input, found);
    output->Initialize();
    if (isWhole && !found.scores.empty())
    {
      vtkPolyData* sphere = vtkPolyData::GetData(input);
      const limpid::Orbit scoring = OrbitOf(sphere);
      const limpid::CameraPath path = state.Find(found, scoring.up);
      const limpid::Orbit orbit = limpid::FittedOrbit(scoring, found.corners, path.directions);
      state.Fill(path, orbit, output);
      output->GetFieldData()->ShallowCopy(sphere->GetFieldData());
      limpid::AddValue<vtkDoubleArray>(
        "CameraParallelScale", orbit.parallelScale, output->GetFieldData());
    }
    return 1;
  }
  catch (const std::exception& error)
  {
    if (ranks->Rank() == 0)
    {
      vtkErrorMacro(<< error.what());
    }
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
