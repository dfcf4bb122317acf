// SPDX-License-Identifier: MIT
#include "fuzz/target.hpp"
#include "lacuna/core/error.hpp"
#include "lacuna/data/read_text.hpp"
#include "lacuna/data/roles.hpp"

namespace lacuna::fuzz {

std::vector<std::string> seeds() {
  return {"t,x,y\n0,1,2\n1,2,3\n2,3,4\n", "t [s];x [V]\n0;1,5\n1;2,5\n2;3,5\n",
          "# scope\nmodel,3\nt x y\n0 1 2\n1 2 nan\n2 3 4\n4 5 6\n",
          "\xef\xbb\xbftime\tu\xc2\xb5\r\n0\t1e-3\r\n1\t\r\n2\t\"3\"\r\n"};
}

void take(std::string_view input) {
  try {
    assign_roles(parse_text_table(input, "input"), {});
  } catch (const Error&) {
  }
}

}  // namespace lacuna::fuzz
