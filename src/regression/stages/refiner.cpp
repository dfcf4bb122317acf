// SPDX-License-Identifier: MIT
#include "lacuna/regression/stages/refiner.hpp"

namespace lacuna {

RefinedModel Refiner::refine(const RefinerTask& task, const RunContext& context) const {
  context.check_stop();
  check_dataset(task.data);
  if (task.start.states() != task.data.states)
    throw ArgumentError("refiner", "the model has other states than the data",
                        "give a model of the states of the dataset");
  return do_refine(task, context);
}

}  // namespace lacuna
