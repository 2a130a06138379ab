// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef limpid_Utf8_h
#define limpid_Utf8_h

#include <string>

namespace limpid
{
/// Returns a text in UTF-8. A text that is none is taken for Latin-1, in which older programs write
/// names.
std::string AsUtf8(const std::string& text);
}

#endif
