// SPDX-License-Identifier: MIT
// XML by expat.
#include <expat.h>

#include <algorithm>
#include <exception>
#include <memory>
#include <type_traits>

#include "lacuna/core/base/error.hpp"
#include "xml.hpp"

namespace lacuna {
namespace {

/// What the callbacks of expat share.
struct Reading {
  const XmlHandler& handler;
  XML_Parser parser;
  std::exception_ptr failure = nullptr;
  bool has_type = false;

  /// Exceptions do not pass through a library in C.
  template <class Call>
  void guarded(const Call& call) {
    if (failure) return;
    try {
      call();
    } catch (...) {
      failure = std::current_exception();
      XML_StopParser(parser, XML_FALSE);
    }
  }
};

std::string_view without_prefix(std::string_view name) {
  const std::size_t colon = name.rfind(':');
  return colon == std::string_view::npos ? name : name.substr(colon + 1);
}

void on_begin(void* data, const XML_Char* name, const XML_Char** pairs) {
  auto& reading = *static_cast<Reading*>(data);
  reading.guarded([&] {
    XmlAttributes attributes;
    for (; *pairs != nullptr; pairs += 2) attributes.emplace(pairs[0], pairs[1]);
    reading.handler.begin(without_prefix(name), attributes);
  });
}

void on_end(void* data, const XML_Char* name) {
  auto& reading = *static_cast<Reading*>(data);
  reading.guarded([&] { reading.handler.end(without_prefix(name)); });
}

void on_text(void* data, const XML_Char* text, int size) {
  auto& reading = *static_cast<Reading*>(data);
  reading.guarded([&] {
    reading.handler.text({text, static_cast<std::size_t>(size)});
  });
}

void on_type(void* data, const XML_Char*, const XML_Char*, const XML_Char*, int) {
  auto& reading = *static_cast<Reading*>(data);
  reading.has_type = true;
  XML_StopParser(reading.parser, XML_FALSE);
}

}  // namespace

void read_xml(std::string_view document, const XmlHandler& handler, const std::string& source) {
  constexpr std::size_t kPiece = std::size_t{1} << 24U;  // expat counts in int
  const std::unique_ptr<std::remove_pointer_t<XML_Parser>, decltype(&XML_ParserFree)> parser(
      XML_ParserCreate(nullptr), &XML_ParserFree);
  if (!parser) throw std::bad_alloc();
  Reading reading{handler, parser.get()};
  XML_SetUserData(parser.get(), &reading);
  XML_SetElementHandler(parser.get(), on_begin, on_end);
  XML_SetCharacterDataHandler(parser.get(), on_text);
  XML_SetStartDoctypeDeclHandler(parser.get(), on_type);
  XML_Status status = XML_STATUS_OK;
  do {
    const std::string_view piece = document.substr(0, kPiece);
    document.remove_prefix(piece.size());
    status = XML_Parse(parser.get(), piece.data(), static_cast<int>(piece.size()),
                       document.empty() ? XML_TRUE : XML_FALSE);
  } while (status == XML_STATUS_OK && !document.empty());
  if (reading.failure) std::rethrow_exception(reading.failure);
  if (reading.has_type)
    throw DataError(source, "its XML has a type declaration, which no sheet needs",
                    "save the sheet as .csv");
  if (status != XML_STATUS_OK)
    throw DataError(source + ", line " + std::to_string(XML_GetCurrentLineNumber(parser.get())),
                    std::string("its XML is damaged: ") +
                        XML_ErrorString(XML_GetErrorCode(parser.get())),
                    "save it again, or the sheet as .csv");
}

}  // namespace lacuna
