// SPDX-License-Identifier: MIT
// The shortest way: a record in, equations out, proved by synchronisation and judged on samples
// that they were not fitted to.
#include <iostream>

#include "lacuna/data/formats/read.hpp"
#include "lacuna/identify/journey/identify_records.hpp"

int main() {
  const lacuna::Dataset record = lacuna::read_dataset({"data/tl072_record.csv.gz"});
  const lacuna::Identification found = lacuna::identify_records(record);
  std::cout << lacuna::to_text(found.result.model, 5) << '\n';
  if (found.verification) std::cout << found.verification->verdict.sentence << '\n';
  if (found.result.validation) std::cout << found.result.validation->sentence << '\n';
  return 0;
}
