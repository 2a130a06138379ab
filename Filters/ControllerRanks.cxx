// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#include "ControllerRanks.h"

#include "vtkInformation.h"
#include "vtkMultiProcessController.h"
#include "vtkStreamingDemandDrivenPipeline.h"

#include "backend/Interruption.h"
#include "distributed/Communicator.h"

#if VTK_MODULE_ENABLE_VTK_ParallelMPI
#include "vtkMPICommunicator.h"
#include "vtkMPIController.h"
#endif

#include <algorithm>
#include <array>
#include <string>
#include <thread>

namespace limpid
{
#if VTK_MODULE_ENABLE_VTK_ParallelMPI
namespace
{
/// The most bytes of one message: VTK's non-blocking messages count bytes in int.
constexpr std::size_t mostBytes = std::size_t(1) << 30;

/// The final message of a rank: whether it was interrupted, and its error message.
using FailureText = std::array<char, 1024>;

class ControllerRanks : public Communicator
{
public:
  explicit ControllerRanks(vtkMPICommunicator* communicator)
    : Mpi(communicator)
  {
    // First of the tags, which differ between computations: messages of a failed computation must
    // not reach the next one.
    constexpr int firstTag = 19400;
    constexpr int computations = 5000;
    static int made = 0;
    this->Tag = firstTag + 2 * (made++ % computations);
  }

  int Rank() const override { return this->Mpi->GetLocalProcessId(); }
  int Size() const override { return this->Mpi->GetNumberOfProcesses(); }

  void Exchange(
    const std::vector<Message>& sent, const std::vector<Message>& received) const override
  {
    std::vector<vtkMPICommunicator::Request> requests;
    requests.reserve(sent.size() + received.size());
    const auto start = [&requests](const std::vector<Message>& messages, const auto& begin)
    {
      for (const Message& message : messages)
      {
        for (std::size_t first = 0; first < message.bytes; first += mostBytes)
        {
          requests.emplace_back();
          begin(static_cast<char*>(message.data) + first,
            static_cast<int>(std::min(mostBytes, message.bytes - first)), message.rank,
            requests.back());
        }
      }
    };
    start(received,
      [this](char* data, int bytes, int rank, vtkMPICommunicator::Request& request)
      { this->Mpi->NoBlockReceive(data, bytes, rank, this->Tag, request); });
    start(sent,
      [this](const char* data, int bytes, int rank, vtkMPICommunicator::Request& request)
      { this->Mpi->NoBlockSend(data, bytes, rank, this->Tag, request); });
    try
    {
      for (vtkMPICommunicator::Request& request : requests)
      {
        this->WaitFor(request);
      }
    }
    catch (...)
    {
      for (vtkMPICommunicator::Request& request : requests)
      {
        if (!request.Test())
        {
          request.Cancel();
        }
      }
      throw;
    }
  }

  void GiveUp(const std::string& why, bool interrupted) const noexcept override
  {
    FailureText words{};
    words[0] = interrupted ? 1 : 0;
    std::copy_n(why.begin(), std::min(why.size(), words.size() - 2), words.begin() + 1);
    for (int rank = 0; rank < this->Size() && !this->HasGivenUp; ++rank)
    {
      if (rank != this->Rank())
      {
        // A message this short is sent without waiting for its receiver.
        this->Mpi->Send(words.data(), vtkIdType(words.size()), rank, this->Tag + 1);
      }
    }
    this->HasGivenUp = true;
  }

private:
  void WaitFor(vtkMPICommunicator::Request& request) const
  {
    constexpr int momentsAwake = 2000;
    constexpr int momentsPerLook = 64;
    for (int moment = 1; !request.Test(); ++moment)
    {
      if (moment % momentsPerLook == 0)
      {
        this->Listen();
      }
      if (moment > momentsAwake)
      {
        std::this_thread::yield();
      }
    }
  }

  /// Throws if another rank has failed or was interrupted.
  void Listen() const
  {
    int there = 0;
    int rank = 0;
    this->Mpi->Iprobe(vtkMultiProcessController::ANY_SOURCE, this->Tag + 1, &there, &rank);
    if (there)
    {
      FailureText words{};
      this->Mpi->Receive(words.data(), vtkIdType(words.size()), rank, this->Tag + 1);
      if (words[0])
      {
        throw Interrupted();
      }
      throw JointError("Rank " + std::to_string(rank) + ": " + (words.data() + 1));
    }
    Interruptible::Check();
  }

  vtkMPICommunicator* Mpi;
  int Tag;
  mutable bool HasGivenUp = false;
};

/// Returns null if there is none.
vtkMPICommunicator* GlobalMpi()
{
  auto* mpi = vtkMPIController::SafeDownCast(vtkMultiProcessController::GetGlobalController());
  return mpi ? vtkMPICommunicator::SafeDownCast(mpi->GetCommunicator()) : nullptr;
}
}

bool AreSeveral()
{
  vtkMPICommunicator* mpi = GlobalMpi();
  return mpi && mpi->GetNumberOfProcesses() > 1;
}

bool AllRanksUpdate(vtkInformation* outInfo)
{
  using Pipeline = vtkStreamingDemandDrivenPipeline;
  vtkMPICommunicator* mpi = GlobalMpi();
  return AreSeveral() &&
    outInfo->Get(Pipeline::UPDATE_NUMBER_OF_PIECES()) == mpi->GetNumberOfProcesses() &&
    outInfo->Get(Pipeline::UPDATE_PIECE_NUMBER()) == mpi->GetLocalProcessId();
}

std::shared_ptr<const Communicator> MakeRanks()
{
  return std::make_shared<const ControllerRanks>(GlobalMpi());
}
#else
bool AreSeveral()
{
  return false;
}

bool AllRanksUpdate(vtkInformation*)
{
  return false;
}

std::shared_ptr<const Communicator> MakeRanks()
{
  return ThisProcess();
}
#endif

std::shared_ptr<const Communicator> RanksThatUpdate(vtkInformation* outInfo)
{
  return AllRanksUpdate(outInfo) ? MakeRanks() : ThisProcess();
}
}
