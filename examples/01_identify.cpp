// SPDX-License-Identifier: MIT
// The shortest way: a record in, equations out.
#include <iostream>

#include "lacuna/data/formats/read.hpp"
#include "lacuna/identify/pipeline/presets.hpp"

int main() {
  const lacuna::Dataset record = lacuna::read_dataset({"data/tl072_record.csv.gz"});
  const auto result = lacuna::identify(record, lacuna::algorithm1());
  std::cout << lacuna::to_text(result.model, 5) << '\n';
  return 0;
}
