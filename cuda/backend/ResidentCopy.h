// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef limpid_backend_ResidentCopy_h
#define limpid_backend_ResidentCopy_h

#include <memory>
#include <mutex>

namespace limpid
{
/// Holds what a device keeps of an object on the host, until that object is destroyed.
class ResidentCopy
{
public:
  /// Returns the copy, a Copy(device, source) with a member `where` that is the device. It is made
  /// on first use, and again for another device. A process has one kind of device that copies, so
  /// that all calls have the same type.
  template <class Copy, class AnyDevice, class Source>
  std::shared_ptr<Copy> On(const std::shared_ptr<AnyDevice>& device, const Source& source)
  {
    const std::lock_guard<std::mutex> lock(this->Access);
    auto copy = std::static_pointer_cast<Copy>(this->Held);
    if (!copy || copy->where != device)
    {
      copy = std::make_shared<Copy>(device, source);
      this->Held = copy;
    }
    return copy;
  }

private:
  std::mutex Access;
  std::shared_ptr<void> Held;
};
}

#endif
