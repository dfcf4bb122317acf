// SPDX-License-Identifier: MIT
#pragma once

#include <functional>
#include <map>
#include <string>
#include <string_view>

namespace lacuna {

/// Attributes of an element, names as they are written ("office:value").
using XmlAttributes = std::map<std::string, std::string>;

/// What is called while a document is read, in its order. Names have no prefix ("table-row").
struct XmlHandler {
  std::function<void(std::string_view name, const XmlAttributes& attributes)> begin;
  std::function<void(std::string_view name)> end;
  std::function<void(std::string_view text)> text;
};

/// Reads an XML document. Entities are none of a sheet: a document with a type declaration is
/// refused.
/// @param source name for messages.
/// @throws DataError where it is damaged, has a type declaration, or without expat.
void read_xml(std::string_view document, const XmlHandler& handler, const std::string& source);

}  // namespace lacuna
