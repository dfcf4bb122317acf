// SPDX-License-Identifier: MIT
#include "lacuna/regression/stages/refiner.hpp"

#include "data/records/known_noise.hpp"

namespace lacuna {

RefinedModel Refiner::refine(const RefinerTask& task, const RunContext& context) const {
  context.check_stop();
  check_dataset(task.data);
  if (task.start.states() != task.data.states)
    throw ArgumentError("refiner", "the model has other states than the data",
                        "give a model of the states of the dataset");
  check_known(task.noise, task.data, "refiner");
  return do_refine(task, context);
}

}  // namespace lacuna
