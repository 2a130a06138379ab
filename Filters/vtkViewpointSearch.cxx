// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#include "vtkViewpointSearch.h"

#include "ControllerRanks.h"
#include "Memory.h"
#include "PropertyPrinter.h"
#include "vtkViewpointSearchInternals.h"

#include "vtkImageData.h"
#include "vtkInformation.h"
#include "vtkInformationVector.h"
#include "vtkObjectFactory.h"
#include "vtkPolyData.h"
#include "vtkStreamingDemandDrivenPipeline.h"

#include "backend/Interruption.h"
#include "distributed/Communicator.h"

#include <algorithm>
#include <exception>

vtkStandardNewMacro(vtkViewpointSearch);

namespace
{
using Pipeline = vtkStreamingDemandDrivenPipeline;

// Returns the output information of the port that the request comes from.
vtkInformation* RequestedOf(vtkInformation* request, vtkInformationVector* outputVector)
{
  const int port =
    request->Has(Pipeline::FROM_OUTPUT_PORT()) ? request->Get(Pipeline::FROM_OUTPUT_PORT()) : 0;
  return outputVector->GetInformationObject(std::max(port, 0));
}
}

vtkViewpointSearch::vtkViewpointSearch()
  : State(new Internals(this))
{
  this->SetNumberOfOutputPorts(3);
  this->SetMaximumIterations(1);
  this->SetSmoothness(0); // takes six sweeps per direction and hardly changes scores
}

vtkViewpointSearch::~vtkViewpointSearch() = default;

bool vtkViewpointSearch::SetPreset(const char* name)
{
  const bool isThere = this->Superclass::SetPreset(name);
  if (isThere)
  {
    this->SetSmoothness(0);
  }
  return isThere;
}

void vtkViewpointSearch::AddAvoidedDirection(double x, double y, double z)
{
  this->State->Avoided.emplace_back(x, y, z);
  this->Modified();
}

void vtkViewpointSearch::RemoveAllAvoidedDirections()
{
  if (!this->State->Avoided.empty())
  {
    this->State->Avoided.clear();
    this->Modified();
  }
}

int vtkViewpointSearch::GetNumberOfAvoidedDirections() const
{
  return static_cast<int>(this->State->Avoided.size());
}

vtkPolyData* vtkViewpointSearch::GetOutput()
{
  return this->GetOutput(0);
}

vtkPolyData* vtkViewpointSearch::GetOutput(int port)
{
  return vtkPolyData::SafeDownCast(this->GetOutputDataObject(port));
}

vtkPolyData* vtkViewpointSearch::GetViewpoints()
{
  return this->GetOutput(1);
}

vtkPolyData* vtkViewpointSearch::GetPaths()
{
  return this->GetOutput(2);
}

int vtkViewpointSearch::FillOutputPortInformation(int, vtkInformation* info)
{
  info->Set(vtkDataObject::DATA_TYPE_NAME(), "vtkPolyData");
  return 1;
}

int vtkViewpointSearch::RequestInformation(
  vtkInformation*, vtkInformationVector**, vtkInformationVector* outputVector)
{
  for (int port = 0; port < this->GetNumberOfOutputPorts(); ++port)
  {
    outputVector->GetInformationObject(port)->Set(vtkAlgorithm::CAN_HANDLE_PIECE_REQUEST(), 1);
  }
  return 1;
}

// Requests the whole image, so that processes can score different directions; if it is too large,
// each process requests a piece.
int vtkViewpointSearch::RequestUpdateExtent(
  vtkInformation* request, vtkInformationVector** inputVector, vtkInformationVector* outputVector)
{
  const int result = this->Superclass::RequestUpdateExtent(request, inputVector, outputVector);
  vtkInformation* requested = RequestedOf(request, outputVector);
  if (limpid::AllRanksUpdate(requested) &&
    (SceneReader::IsMesh(inputVector) || this->State->IsLarge(inputVector)))
  {
    SceneReader::RequestPiece(requested, inputVector);
  }
  return result;
}

int vtkViewpointSearch::RequestData(
  vtkInformation* request, vtkInformationVector** inputVector, vtkInformationVector* outputVector)
{
  vtkPolyData* outputs[3];
  for (int port = 0; port < 3; ++port)
  {
    outputs[port] = vtkPolyData::GetData(outputVector, port);
  }
  const auto clear = [&outputs]()
  {
    for (vtkPolyData* output : outputs)
    {
      output->Initialize(); // no partial sphere
    }
  };
  try
  {
    vtkInformation* requested = RequestedOf(request, outputVector);
    const bool isLaterPiece = requested->Get(Pipeline::UPDATE_PIECE_NUMBER()) > 0;
    this->State->Ranks = limpid::RanksThatUpdate(requested);
    limpid::NotifyingOnFailure(
      *this->State->Ranks, [&] { this->State->SearchAny(inputVector, isLaterPiece, outputs); });
    return 1;
  }
  catch (const limpid::Interrupted&)
  {
    clear(); // the abort came before any result
    return 1;
  }
  catch (const std::exception& error)
  {
    const limpid::MemoryNeed need{
      this->Field == OPTIMIZE_PER_VIEW ? 65.0 : Internals::BytesPerPoint, limpid::fewerPoints
    };
    vtkErrorMacro(<< limpid::MessageOf(error, vtkImageData::GetData(inputVector[0]), need));
    clear();
    return 0;
  }
}

void vtkViewpointSearch::PrintSelf(ostream& os, vtkIndent indent)
{
  const limpid::PropertyPrinter print{ os, indent };

  this->Superclass::PrintSelf(os, indent);
  print("Field", this->Field);
  print("Sampling", this->Sampling);
  print("NumberOfDirections", this->NumberOfDirections);
  print("UseFocalPoint", this->UseFocalPoint);
  print("CameraFocalPoint", this->CameraFocalPoint);
  print("CameraDistance", this->CameraDistance);
  print("CameraViewAngle", this->CameraViewAngle);
  print("CameraParallelProjection", this->CameraParallelProjection);
  print("CameraAspectRatio", this->CameraAspectRatio);
  print("CameraViewUp", this->CameraViewUp);
  print("ElevationRange", this->ElevationRange);
  print("AvoidedDirections", this->GetNumberOfAvoidedDirections());
  print("AvoidanceAngle", this->AvoidanceAngle);
  print("NumberOfViewpoints", this->NumberOfViewpoints);
  print("SeparationAngle", this->SeparationAngle);
  print("Refine", this->Refine);
  print("SphereRadius", this->SphereRadius);
}
