// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

// Keeps track of messages that the user has seen: a message about a matter is not repeated in every
// frame, but shown again if the matter was settled in between.

#ifndef limpid_MessageLog_h
#define limpid_MessageLog_h

#include <map>
#include <set>
#include <string>

namespace limpid
{
class MessageLog
{
public:
  /// Starts a frame.
  void Begin();

  /// Returns whether there was no message about this matter, in any scope, since it was settled.
  bool IsNew(const std::string& matter);

  /// Ends a frame: matters without a message in it count as settled in this scope. `scope`:
  /// identifies what draws frames in turn, for instance one of two renderers.
  void End(const void* scope);

  /// Removes a scope, which draws no more frames.
  void Forget(const void* scope);

private:
  std::map<std::string, std::set<const void*>> Given; ///< matter, and scopes where it persists
  std::set<std::string> Now;                          ///< matters of the present frame
};

/// Returns a text without its numbers, which may change in every frame although the matter is the
/// same.
std::string WithoutNumbers(const std::string& text);
}

#endif
