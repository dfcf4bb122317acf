// SPDX-License-Identifier: MIT
// A basis of one's own in one file, and the whole `lacuna` command with it:
//   example_05_own_basis identify RECORD --set basis=harmonics --set basis.harmonics=2
#include "lacuna/bases/bases.hpp"
#include "lacuna/cli/commands/cli.hpp"

namespace {

struct HarmonicsOptions {
  static constexpr lacuna::StageInfo kInfo{"harmonics", "1, x, sin(k x) and cos(k x)",
                                           "example"};
  int harmonics = 1;
  void describe(lacuna::OptionVisitor& visitor) {
    visitor.field({"harmonics", "", "Largest k.", 1.0, 20.0}, harmonics);
  }
};

class Harmonics final : public lacuna::Configured<lacuna::Basis, HarmonicsOptions> {
 public:
  using Configured::Configured;

 private:
  std::vector<lacuna::Term> do_terms(const lacuna::Variables& variables) const override {
    std::vector<lacuna::Term> terms{lacuna::Term::parse("1", variables)};
    for (const std::string& x : variables.states) {
      terms.push_back(lacuna::Term::parse(x, variables));
      for (int k = 1; k <= options().harmonics; ++k)
        for (const std::string function : {"sin(", "cos("})
          terms.push_back(
              lacuna::Term::parse(function + std::to_string(k) + "*" + x + ")", variables));
    }
    return terms;
  }
};

}  // namespace

int main(int argc, char** argv) {
  lacuna::Registry registry = lacuna::default_registry();
  registry.add<Harmonics>();
  return lacuna::run_cli(argc, argv, registry);
}
