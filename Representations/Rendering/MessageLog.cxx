// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#include "MessageLog.h"

#include <algorithm>
#include <cctype>
#include <iterator>

namespace limpid
{
void MessageLog::Begin()
{
  this->Now.clear();
}

bool MessageLog::IsNew(const std::string& matter)
{
  const bool first = this->Now.insert(matter).second;
  return first && this->Given.count(matter) == 0;
}

void MessageLog::End(const void* scope)
{
  this->Forget(scope);
  for (const std::string& matter : this->Now)
  {
    this->Given[matter].insert(scope);
  }
  this->Now.clear();
}

void MessageLog::Forget(const void* scope)
{
  for (auto entry = this->Given.begin(); entry != this->Given.end();)
  {
    entry->second.erase(scope);
    entry = entry->second.empty() ? this->Given.erase(entry) : std::next(entry);
  }
}

std::string WithoutNumbers(const std::string& text)
{
  std::string result;
  std::copy_if(text.begin(), text.end(), std::back_inserter(result),
    [](unsigned char letter) { return !std::isdigit(letter) && letter != '.' && letter != '-'; });
  return result;
}
}
