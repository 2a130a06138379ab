// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

// Which messages the user has been given already: one about the same thing is not given for every
// frame, but again when the matter has been settled in between.

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
  /// A frame begins; `scope` tells apart what draws frames in turn, for instance two renderers.
  void Begin();

  /// Whether nothing has been said about this matter, in any scope, since it was settled.
  bool IsNew(const std::string& matter);

  /// The frame ends: what it was silent about counts as settled in this scope.
  void End(const void* scope);

  /// There will be no more frames in this scope.
  void Forget(const void* scope);

private:
  std::map<std::string, std::set<const void*>> Given; ///< by matter: where it is still unsettled
  std::set<std::string> Now;                          ///< matters of the present frame
};

/// A text without its numbers: they may change with every frame while the matter is the same.
std::string WithoutNumbers(const std::string& text);
}

#endif
