// SPDX-License-Identifier: MIT
// Makes the record data/tl072_record.csv.gz anew: make_tl072_record [FILE]
#include <iostream>

#include "dynamics/test_systems/shipped_record.hpp"
#include "lacuna/core/base/error.hpp"
#include "lacuna/data/formats/write.hpp"

int main(int argc, char** argv) {
  try {
    lacuna::write_csv(argc > 1 ? argv[1] : "tl072_record.csv.gz", lacuna::tl072_record(),
                      lacuna::tl072_record_comment());
  } catch (const lacuna::Error& error) {
    std::cerr << "make_tl072_record: " << error.what() << "\n";
    return 2;
  }
}
