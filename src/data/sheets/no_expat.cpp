// SPDX-License-Identifier: MIT
// Without expat.
#include "lacuna/core/base/error.hpp"
#include "xml.hpp"

namespace lacuna {

void read_xml(std::string_view, const XmlHandler&, const std::string& source) {
  throw DataError(source, "this is a workbook, and the program was built without expat",
                  "build it with expat (libexpat1-dev), or save the sheet as .csv");
}

}  // namespace lacuna
