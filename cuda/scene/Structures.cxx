// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

#include "scene/Structures.h"

#include "math/Require.h"

#include <algorithm>
#include <limits>
#include <locale>
#include <set>
#include <sstream>
#include <utility>

namespace limpid
{
namespace
{
/// Reads all of a text as a number; none: it is something else. Independent of the locale.
template <class Number>
std::optional<Number> NumberIn(const std::string& text)
{
  std::istringstream stream(text);
  stream.imbue(std::locale::classic());
  Number number{};
  const bool isNumber = static_cast<bool>(stream >> number);
  return isNumber && (stream >> std::ws).eof() ? std::optional<Number>(number) : std::nullopt;
}

void RequireShare(const Structure& structure, const char* what, double share)
{
  LIMPID_REQUIRE(share >= 0 && share <= 1,
    "The " << what << " of the structure \"" << structure.NameOrLabel() << "\" is " << share
           << " (it is a share). Set it between 0 and 1.");
}
}

Structure ParseStructure(const std::string& label, const std::string& name,
  const std::string& importance, const std::string& target)
{
  const auto found = NumberIn<std::int64_t>(label);
  LIMPID_REQUIRE(found,
    "A structure has the label \"" << label
                                   << "\" (labels are the whole numbers of the structure array). "
                                      "Give the number of its points, and \""
                                   << label << "\" as its name.");
  Structure structure{ *found, name, 1, {} };
  std::replace_if(
    structure.name.begin(), structure.name.end(),
    [](char letter) { return letter == '\n' || letter == '\r' || letter == '\t'; }, ' ');
  const auto share = [&structure](const char* what, const std::string& text)
  {
    const auto number = NumberIn<double>(text);
    LIMPID_REQUIRE(number,
      "The " << what << " of the structure \"" << structure.NameOrLabel() << "\" is \"" << text
             << "\" (it is a share). Give a number between 0 and 1.");
    return *number;
  };
  structure.importance = share("importance", importance);
  if (target.find_first_not_of(' ') != std::string::npos)
  {
    structure.target = share("target", target);
  }
  return structure;
}

Structures::Structures(std::vector<Structure> all)
  : All(std::move(all))
{
  constexpr std::size_t most = std::numeric_limits<StructureRow>::max();
  LIMPID_REQUIRE(this->All.size() <= most,
    "There are " << this->All.size() << " structures (results have at most " << most
                 << "). Keep those that matter; other labels need none.");
  std::set<std::string> names;
  for (const Structure& structure : this->All)
  {
    RequireShare(structure, "importance", structure.importance);
    RequireShare(structure, "target", structure.target.value_or(0));
    const auto row = static_cast<StructureRow>(this->Rows.size() + 1);
    LIMPID_REQUIRE(this->Rows.emplace(structure.label, row).second,
      "Two structures have the label " << structure.label
                                       << " (its importance is ambiguous). Remove one of them.");
    LIMPID_REQUIRE(names.insert(structure.NameOrLabel()).second,
      "Two structures have the name \"" << structure.NameOrLabel()
                                        << "\" (results could not tell them apart). Rename one of "
                                           "them.");
  }
}

Structures Structures::AnyLabel()
{
  Structures structures({ { 1, "all labels", 1, {} } });
  structures.IsAny = true;
  return structures;
}

bool Structures::HasTargets() const
{
  return std::any_of(this->All.begin(), this->All.end(),
    [](const Structure& structure) { return structure.target.has_value(); });
}

StructureRow Structures::RowOf(std::int64_t label) const
{
  if (this->IsAny)
  {
    return label == 0 ? 0 : 1;
  }
  const auto found = this->Rows.find(label);
  return found == this->Rows.end() ? StructureRow(0) : found->second;
}
}
