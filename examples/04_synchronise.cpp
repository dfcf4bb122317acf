// SPDX-License-Identifier: MIT
// Proving a model: it is driven by the record, and the distance it keeps is the measure.
#include <iostream>

#include "lacuna/data/formats/read.hpp"
#include "lacuna/dynamics/integration/integrators.hpp"
#include "lacuna/dynamics/integration/synchroniser.hpp"
#include "lacuna/dynamics/test_systems/test_systems.hpp"

int main() {
  using namespace lacuna;
  const Dataset record = read_dataset({"data/tl072_record.csv.gz"});
  for (const char* name : {"tl072", "rossler-adjusted"}) {
    const SyncResult sync = synchronise(test_system(name).model, record, rk4());
    std::cout << name << ": relative mean synchronisation error " << 100.0 * sync.relative
              << " %\n";
  }
}
