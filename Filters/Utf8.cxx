// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#include "Utf8.h"

#include <cstddef>

namespace limpid
{
namespace
{
// Returns the number of bytes of the character that begins at some place; 0: none does.
std::size_t LengthAt(const std::string& text, std::size_t at)
{
  const auto first = static_cast<unsigned char>(text[at]);
  if (first < 0x80)
  {
    return 1;
  }
  if (first < 0xC2 || first > 0xF4)
  {
    return 0;
  }
  const std::size_t length = first < 0xE0 ? 2 : first < 0xF0 ? 3 : 4;
  for (std::size_t i = at + 1; i < at + length; ++i)
  {
    if (i >= text.size() || (static_cast<unsigned char>(text[i]) & 0xC0U) != 0x80)
    {
      return 0;
    }
  }
  return length;
}

bool IsUtf8(const std::string& text)
{
  for (std::size_t at = 0; at < text.size();)
  {
    const std::size_t length = LengthAt(text, at);
    if (length == 0)
    {
      return false;
    }
    at += length;
  }
  return true;
}
}

std::string AsUtf8(const std::string& text)
{
  if (IsUtf8(text))
  {
    return text;
  }
  std::string converted;
  for (const char letter : text)
  {
    const auto code = static_cast<unsigned char>(letter);
    if (code < 0x80)
    {
      converted += letter;
      continue;
    }
    converted += static_cast<char>(0xC0U | code >> 6U);
    converted += static_cast<char>(0x80U | (code & 0x3FU));
  }
  return converted;
}
}
