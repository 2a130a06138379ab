// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef limpid_distributed_PackedExchange_h
#define limpid_distributed_PackedExchange_h

#include "distributed/Communicator.h"

#include <cstddef>
#include <vector>

namespace limpid
{
/// Message buffers, to be reused by consecutive exchanges.
struct ExchangeBuffers
{
  std::vector<std::vector<std::byte>> sent;     ///< [rank]
  std::vector<std::vector<std::byte>> received; ///< [rank]
};

/// Returns a message for each rank with a size above 0, in buffers that are large enough.
/// `bytes`: [rank].
std::vector<Communicator::Message> MessagesIn(
  std::vector<std::vector<std::byte>>& buffers, const std::vector<std::size_t>& bytes);

/**
 * Exchanges one message with each other rank. `sent`, `received`: sizes of the messages [bytes],
 * per rank; 0 for this rank, and where there is none. pack(rank, buffer) writes a message, and
 * unpack(rank, buffer) reads one. Collective.
 */
template <class Pack, class Unpack>
void ExchangePacked(const Communicator& ranks, const std::vector<std::size_t>& sent,
  const std::vector<std::size_t>& received, ExchangeBuffers& room, const Pack& pack,
  const Unpack& unpack)
{
  const std::vector<Communicator::Message> out = MessagesIn(room.sent, sent);
  const std::vector<Communicator::Message> in = MessagesIn(room.received, received);
  for (const Communicator::Message& message : out)
  {
    pack(std::size_t(message.rank), static_cast<std::byte*>(message.data));
  }
  ranks.Exchange(out, in);
  for (const Communicator::Message& message : in)
  {
    unpack(std::size_t(message.rank), static_cast<const std::byte*>(message.data));
  }
}
}

#endif
