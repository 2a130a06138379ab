// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#include "distributed/PackedExchange.h"

#include <algorithm>

namespace limpid
{
std::vector<Communicator::Message> MessagesIn(
  std::vector<std::vector<std::byte>>& buffers, const std::vector<std::size_t>& bytes)
{
  buffers.resize(std::max(buffers.size(), bytes.size()));
  std::vector<Communicator::Message> messages;
  for (std::size_t rank = 0; rank < bytes.size(); ++rank)
  {
    if (bytes[rank] > 0)
    {
      std::vector<std::byte>& buffer = buffers[rank];
      buffer.resize(std::max(buffer.size(), bytes[rank]));
      messages.push_back({ static_cast<int>(rank), buffer.data(), bytes[rank] });
    }
  }
  return messages;
}
}
