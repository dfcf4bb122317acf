// SPDX-License-Identifier: MIT
#include "data/formats/npy.hpp"

#include "fuzz/target.hpp"
#include "lacuna/core/base/error.hpp"

namespace lacuna::fuzz {

std::vector<std::string> seeds() {
  std::vector<std::string> arrays;
  for (const std::string header :
       {"{'descr': '<f8', 'fortran_order': False, 'shape': (3, 2), }\n",
        "{'descr': '>i2', 'fortran_order': True, 'shape': (6,), }\n",
        "{'descr': [('t', '<f4'), ('x', '|u1')], 'fortran_order': False, 'shape': (4,), }\n"}) {
    std::string bytes("\x93NUMPY\x01\x00", 8);
    bytes += static_cast<char>(header.size());
    bytes += '\0';
    arrays.push_back(bytes + header + std::string(48, '\x3f'));
  }
  return arrays;
}

void take(std::string_view input) {
  try {
    parse_npy(input, "input");
  } catch (const Error&) {
  }
}

}  // namespace lacuna::fuzz
