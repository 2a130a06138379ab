// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef limpid_backend_CallingThread_h
#define limpid_backend_CallingThread_h

#include <thread>

namespace limpid
{
/// Remembers the thread that created it: the only one that may use the caller's callbacks.
class CallingThread
{
public:
  bool IsThis() const { return std::this_thread::get_id() == this->Id; }

private:
  std::thread::id Id = std::this_thread::get_id();
};
}

#endif
